// Tests the exact answer of hard cases against rational arithmetic over the corners (tests/support/exact_fragments.h),
// which shares no function with the code.
#include "tools/lab/hard_cases/hard_exact.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes/procedural/hard_cases/build_case.h"
#include "tests/support/exact_fragments.h"
#include "tools/lab/hard_cases/moves/hard_moves.h"

namespace {

using namespace strata;
using tools::ExactCase;
using tools::ResultPixel;
using tools::ResultPixels;
using RationalPixels = std::vector<std::vector<testing::ExactFragment>>;

RationalPixels by_rationals(const scenes::HardCase& hard, const scenes::Scene& scene) {
    RationalPixels pixels(static_cast<std::size_t>(hard.width) * static_cast<std::size_t>(hard.height));
    for (const auto& [pixel, fragments] : testing::ExactScene{scene, hard}.visible()) pixels[pixel] = fragments;
    return pixels;
}

// Every fragment is listed and no other; a nearer one is before a farther one, and equal depths share an index.
bool is_answer(const ResultPixel& pixel, std::vector<testing::ExactFragment> exact) {
    std::ranges::sort(exact, {}, &testing::ExactFragment::triangle);
    if (pixel.fragments.size() != exact.size()) return false;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (pixel.fragments[i].primitive != exact[i].triangle) return false;
        for (std::size_t k = 0; k < i; ++k) {
            const int order = pixel.fragments[i].layer - pixel.fragments[k].layer;
            if (exact[i].depth < exact[k].depth   ? order >= 0
                : exact[i].depth > exact[k].depth ? order <= 0
                                                  : order != 0)
                return false;
        }
    }
    return true;
}

// True if both have the same triangles in the same order.
bool is_same_answer(std::vector<testing::ExactFragment> a, std::vector<testing::ExactFragment> b) {
    const auto near_to_far = [](const testing::ExactFragment& x, const testing::ExactFragment& y) {
        return x.depth != y.depth ? x.depth < y.depth : x.triangle < y.triangle;
    };
    std::ranges::sort(a, near_to_far);
    std::ranges::sort(b, near_to_far);
    return std::ranges::equal(a, b, {}, &testing::ExactFragment::triangle, &testing::ExactFragment::triangle);
}

}  // namespace

TEST_CASE("the exact answer from which movements are measured equals rational arithmetic including ties", "[slow]") {
    int cases = 0;
    for (const scenes::HardCase& hard : scenes::hard_cases()) {
        if (!hard.is_moved) continue;
        INFO(hard.name);
        ++cases;
        const scenes::Scene scene = make_hard_case({}, hard);
        const ResultPixels visible_pixels = ExactCase{hard, scene, *scene.own_view}.visible_pixels();
        const RationalPixels exact = by_rationals(hard, scene);
        REQUIRE(visible_pixels.size() == exact.size());
        int wrong = 0;
        for (std::size_t p = 0; p < visible_pixels.size(); ++p)
            if (!is_answer(visible_pixels[p], exact[p])) ++wrong;
        CHECK(wrong == 0);
    }
    CHECK(cases >= 20);
}

TEST_CASE("no movement changes the rational answer at a pixel that is not marked as open and few pixels are",
          "[slow]") {
    int changed_open = 0;
    for (const char* name : {"crossing-along-a-row", "rotated-quad", "through-near-and-far", "planes-1-unit",
                             "opaque-crossing", "cyclic-overlap"}) {
        INFO(name);
        const scenes::HardCase& hard = *scenes::find_hard_case(name);
        const scenes::Scene scene = make_hard_case({}, hard);
        const RationalPixels before = by_rationals(hard, scene);
        for (const tools::MoveSize size : tools::move_sizes) {
            const auto open = ExactCase{hard, scene, *scene.own_view}.open_pixels({.relative = share_of(size)});
            CHECK(std::ranges::count(open, true) < static_cast<std::ptrdiff_t>(open.size()) / 8);
            for (const std::uint64_t seed : {3U, 4U}) {
                const RationalPixels after = by_rationals(hard, tools::moved(scene, {size, seed}));
                int wrong = 0;
                for (std::size_t p = 0; p < open.size(); ++p)
                    if (!is_same_answer(before[p], after[p])) ++(open[p] ? changed_open : wrong);
                CHECK(wrong == 0);
            }
        }
    }
    // The movements do change open pixels, so the count above could have been other than 0.
    CHECK(changed_open > 100);
}

// Two planes near depth 9/10, whose distance grows by 2^-23 per pixel column on both sides of the middle: a movement of
// a depth by 2^-20 reorders some columns there.
TEST_CASE("a movement reorders planes only at pixels that are marked as open and reorders some") {
    const scenes::HardCase close{.name = "close",
                                 .hard = "",
                                 .answer = "",
                                 .build =
                                     [](scenes::CaseScene& scene) {
                                         using namespace scenes::hard;
                                         add_quad(scene, whole(scene), {0.9, 0, 0}, color_of(1));
                                         add_quad(scene, whole(scene), {0.9 - 0x1p-19, 0x1p-23, 0}, color_of(2));
                                     },
                                 .counts = {2048, 2, 2, 0}};
    const scenes::Scene scene = make_hard_case({}, close);
    const auto open =
        ExactCase{close, scene, *scene.own_view}.open_pixels({.relative = share_of(tools::MoveSize::relative)});
    // More pixels than the square's diagonal, but not all.
    CHECK(std::ranges::count(open, true) > 200);
    CHECK(std::ranges::count(open, false) > 200);
    const RationalPixels before = by_rationals(close, scene);
    int wrong = 0, reordered = 0;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const RationalPixels after = by_rationals(close, tools::moved(scene, {tools::MoveSize::relative, seed}));
        for (std::size_t p = 0; p < open.size(); ++p)
            if (!is_same_answer(before[p], after[p])) ++(open[p] ? reordered : wrong);
    }
    CHECK(wrong == 0);
    CHECK(reordered > 500);
}

TEST_CASE("triangles of cases that are moved have one colour each and the exact picture blends these") {
    for (const scenes::HardCase& hard : scenes::hard_cases()) {
        if (!hard.is_moved) continue;
        const scenes::Scene scene = make_hard_case({}, hard);
        for (const pipeline::Mesh& mesh : scene.list.meshes)
            for (std::size_t i = 0; i < mesh.indices.size(); ++i)
                REQUIRE(mesh.colors[mesh.indices[i]] == mesh.colors[mesh.indices[i - i % 3]]);
    }
    // Colours of build_case.h: two layers of alpha 1/2 over black, the second plane in front.
    const scenes::HardCase& hard = *scenes::find_hard_case("planes-1-unit");
    const scenes::Scene scene = make_hard_case({}, hard);
    const double front = 0.875, back = 0.5;  // red channel of colours 2 and 1
    CHECK(ExactCase{hard, scene, *scene.own_view}.visible_pixels()[33].color[0] == 0.5 * front + 0.25 * back);
}
