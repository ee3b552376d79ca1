// Tests peels that compare another depth than they store, on scenes with a known number of layers. selection_test.cpp
// tests that they keep the contract of their selections, and differential fuzzing that they execute alike.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;

// `layers` at every pixel, 1/2048 of the range apart, in a submission order unrelated to depth.
FragmentScene shuffled_layers(std::uint32_t layers) {
    FragmentScene scene{16, 16};
    Random random{6};
    std::vector<std::uint32_t> order(layers);
    for (std::uint32_t k = 0; k < layers; ++k) order[k] = k + 1;
    for (auto& pixel : scene.pixels) {
        std::shuffle(order.begin(), order.end(), random);
        for (const std::uint32_t k : order)
            pixel.fragments.push_back({static_cast<float>(k) / 2048.0f, {random_channel(random), 0.5f, 0.25f, 0.5f}});
    }
    return scene;
}

struct Comparison {
    const char* name;
    void (*set)(RenderOptions&);
};

constexpr Comparison comparisons[]{
    {"an epsilon", [](RenderOptions& o) { o.compare_epsilon.absolute = 0x1p-13; }},
    {"two codes", [](RenderOptions& o) { o.compare_epsilon.ulps = 2; }},
    {"another path", [](RenderOptions& o) { o.reference_path = strata::rasterizer::DepthPath::exact; }},
    {"another path, not rounded",
     [](RenderOptions& o) {
         o.reference_path = strata::rasterizer::DepthPath::exact;
         o.quantize_reference = false;
     }},
    {"other vertices", [](RenderOptions& o) { o.vertex_paths.second = VertexPath::fused; }}};

}  // namespace

TEST_CASE(
    "the number of fragments that a peel visits grows with its layers and not with their square for any compared depth",
    "[slow]") {
    const std::vector<std::pair<Machine, std::uint32_t>> most_a_layer{{{"geforce3", "depth_units"}, 3},
                                                                      {{"geforce3", "shadow_map"}, 3},
                                                                      {{"geforce8", "front_to_back"}, 3},
                                                                      {{"geforce8", "dual"}, 5},
                                                                      {{"geforce8_dx101", "dual_independent"}, 5}};
    for (const auto& [machine, most] : most_a_layer)
        for (const Comparison& comparison : comparisons)
            for (const std::uint32_t layers : {16u, 200u}) {
                const FragmentScene scene = shuffled_layers(layers);
                RenderOptions options = options_for(scene);
                options.tile_size = 8;
                options.audit = false;
                comparison.set(options);
                const auto frame = render(scene, machine, options).frame;
                INFO(machine.algorithm << " by " << comparison.name << ", " << layers << " layers");
                CHECK(frame.work.visited >= std::uint64_t{layers} * scene.pixels.size());
                CHECK(frame.work.visited <= std::uint64_t{most} * layers * scene.pixels.size());
            }
}
