// Tests that pixels at edges are excused if another rasterizer drew them, and not if an approximation is off there.
#include "tools/oracle/verdict/opposite_edges.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

OpenedScene translucent(const char* scene, int width, int height) {
    OpenedScene opened{scene, width, height};
    opened.options.alpha = 0.5f;
    return opened;
}

int codes_apart(const oracle::TargetImage& a, const oracle::TargetImage& b, std::size_t i) {
    return std::abs(static_cast<int>(a.codes[i]) - static_cast<int>(b.codes[i]));
}

constexpr int rounding = 2;  // codes

// Empty unless the picture of an approximate algorithm is called right although a pixel is off by more than rounding.
// Pixels at which exact algorithms differ do not count: some merge or lose fragments of one depth.
std::string false_pass(const OpenedScene& opened, const char* algorithm) {
    const auto picture = opened.picture(algorithm, pipeline::Format::rgba8);
    if (!picture) return "";  // refused
    const auto exact = *opened.picture("a_buffer", pipeline::Format::rgba8);
    const auto unique = *opened.picture("front_to_back", pipeline::Format::rgba8);
    const auto merged = *opened.picture("dual", pipeline::Format::rgba8);
    int apart = 0;
    for (std::size_t i = 0; i < exact.codes.size(); ++i)
        if (codes_apart(exact, unique, i) <= rounding && codes_apart(exact, merged, i) <= rounding)
            apart = std::max(apart, codes_apart(exact, *picture, i));
    if (apart <= rounding) return "";
    const PictureVerdict found = judge_picture(opened.input(), {.colors = *picture});
    if (!found.is_right()) return "";
    return std::string(algorithm) + " is off by " + std::to_string(apart) +
           " codes: " + first_line(found.found, opened.scene.list) + '\n';
}

}  // namespace

TEST_CASE("moments, which err at edges with many layers, are not excused as another rasterizer") {
    const OpenedScene opened = translucent("teapot", 200, 150);
    CHECK(false_pass(opened, "moments") == "");
    const PictureVerdict found =
        judge_picture(opened.input(), {.colors = *opened.picture("moments", pipeline::Format::rgba8)});
    INFO(first_line(found.found, opened.scene.list));
    CHECK(found.found.right.at_edges >= 10);  // so that the excuse decides
}

TEST_CASE("no approximate algorithm is called right where it is off by more than rounding", "[exhaustive]") {
    std::string wrong;
    for (const char* scene : {"teapot", "showroom", "random:seed=3,triangles=80", "random:seed=8,triangles=40"}) {
        const OpenedScene opened = translucent(scene, 96, 72);
        for (const peeling::Algorithm& algorithm : peeling::algorithms())
            if (algorithm.ties == peeling::TiePolicy::none) wrong += false_pass(opened, algorithm.name.c_str());
    }
    CHECK(wrong == "");
}

TEST_CASE("a picture with few pixels of another rasterizer is called right but for them, with their number") {
    const OpenedScene opened = translucent("teapot", 200, 150);
    OpenedScene coarse = translucent("teapot", 200, 150);
    coarse.profile.raster.subpixel_bits = 4;
    const auto others = *coarse.picture("front_to_back", pipeline::Format::rgba8);
    for (const int few : {1, 3, 6}) {
        auto picture = *opened.picture("front_to_back", pipeline::Format::rgba8);
        int changed = 0;
        for (std::size_t i = 0; i + 4 <= picture.codes.size() && changed < few; i += 4) {
            bool is_far = false;
            for (std::size_t c = i; c < i + 3; ++c) is_far |= codes_apart(picture, others, c) > 12;
            if (!is_far) continue;
            std::copy_n(others.codes.begin() + static_cast<std::ptrdiff_t>(i), 4,
                        picture.codes.begin() + static_cast<std::ptrdiff_t>(i));
            ++changed;
        }
        REQUIRE(changed == few);
        const PictureVerdict found = judge_picture(opened.input(), {.colors = picture});
        const std::string line = first_line(found.found, opened.scene.list);
        CHECK(line.starts_with("right, but for " + std::to_string(few) + " of 30000 pixels: " + std::to_string(few) +
                               " at edges that another rasterizer may cover so, too few to show it; "));
    }
}

TEST_CASE("edges of a rasterizer with other snapping are excused in the direction of their coverage alone") {
    const OpenedScene opened = translucent("teapot", 200, 150);
    OpenedScene coarse = translucent("teapot", 200, 150);
    coarse.profile.raster.subpixel_bits = 4;
    const auto picture = coarse.picture("front_to_back", pipeline::Format::rgba8);
    const PictureVerdict found = judge_picture(opened.input(), {.colors = *picture});
    const ExcusedEdges excused = excused_edges(*found.fragments, Colors{*picture, found.formed.use}, found.found.right);
    INFO(first_line(found.found, opened.scene.list) << ": " << excused.either_way << " of " << excused.all);
    CHECK(excused.all >= 10);
    CHECK_FALSE(excused.show_no_coverage());
}
