// tests/golden/scene_digests.cpp - prints the digests of every procedural scene by every algorithm on every profile.
#include <exception>
#include <iostream>

#include "scenes/camera.h"
#include "tests/golden/golden.h"

namespace {

using strata::golden::GoldenScene;

GoldenScene make(const std::string& spec, std::optional<float> alpha) {
    constexpr int width = 96, height = 64;
    const auto scene = strata::scenes::load_scene(spec, {});
    return {.name = spec + (alpha ? "@0.4" : ""),
            .list = scene.list,
            .view = strata::scenes::orbit_view(scene.bounds, 30, 20, double{width} / height),
            .width = width,
            .height = height,
            .alpha = alpha};
}

std::string all_lines(const strata::golden::Settings& settings) {
    std::string text =
        "# scene profile algorithm colour depth outcome; 96x64, --orbit 30,20; @0.4 stands for --alpha 0.4.\n"
        "# Made by tools/golden.sh (scene_digests).\n"
        "# Right because tests/peeling compares the same fragments and their order with the exact A-buffer.\n";
    for (const char* spec :
         {"teapot", "volume-beam:slices=16", "volume-beam:slices=16,order=near", "random:seed=1,triangles=200"}) {
        text += strata::golden::lines(make(spec, std::nullopt), settings);
    }
    text += strata::golden::lines(make("teapot", 0.4f), settings);
    return text;
}

}  // namespace

int main(int count, char** words) {
    try {
        const auto settings = strata::golden::parse(count, words);
        return strata::golden::finish(all_lines(settings), settings);
    } catch (const std::exception& error) {
        std::cerr << "scene_digests: " << error.what() << '\n';
        return 2;
    }
}
