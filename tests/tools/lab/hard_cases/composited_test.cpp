// Tests the statistics of composited fragments on fragments and traces written by hand. The expected counts are worked
// out by hand.
#include "tools/lab/hard_cases/composited.h"

#include <catch2/catch.hpp>

#include "peeling/audit/region_trace.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "tools/lab/hard_cases/composed_pixels.h"

namespace {

using namespace strata;
using tools::Composited;

// Pixel 0 has fragments of depth 5, 3 and 5, pixel 1 one of depth 7 and, behind the opaque surface, one of depth 20.
peeling::FrameFragments two_pixels() {
    peeling::FrameFragments fragments;
    const auto add = [&](std::uint32_t pixel, std::uint32_t primitive, std::uint32_t code, float alpha) {
        fragments.all.push_back(
            {.pixel = pixel, .primitive = primitive, .code = code, .exact_code = code, .color = {1, 1, 1, alpha}});
    };
    add(0, 0, 5, 0.5f);
    add(0, 1, 3, 0.5f);
    add(1, 2, 7, 0.001f);
    add(0, 3, 5, 0.5f);
    add(1, 4, 20, 0.5f);
    fragments.opaque = {10, 10};
    return fragments;
}

using Entries = std::vector<pipeline::TraceEntry>;
constexpr auto front = pipeline::Side::front, back = pipeline::Side::back;

Composited found_by(peeling::TiePolicy ties, const Entries& entries, bool kills_alpha_zero = false) {
    peeling::Algorithm algorithm = *peeling::find_algorithm("front_to_back");
    algorithm.ties = ties;
    algorithm.kills_alpha_zero = kills_alpha_zero;
    const peeling::FrameFragments fragments = two_pixels();
    const std::vector<peeling::RegionTrace> traces{{{0, 0, 2, 1}, entries}};
    return tools::composited({algorithm, 2, true, fragments, traces});
}

}  // namespace

TEST_CASE("a peel that composites every fragment once in order from the nearest has no fault") {
    const Composited found =
        found_by(peeling::TiePolicy::first,
                 {{0, 3, 1, front, true}, {1, 7, 2, front, true}, {0, 5, 3, back, true}, {0, 5, 0, back, true}});
    CHECK(found == Composited{.visible = 4, .deepest = 3, .layers = 2, .tied_pixels = 1, .lost_by_ties = 1});
}

TEST_CASE("a peel that keeps one fragment per depth shows every depth once") {
    const Entries entries{{0, 3, 1, front, true}, {0, 5, 0, front, true}, {1, 7, 2, front, true}};
    CHECK(found_by(peeling::TiePolicy::unique, entries).wrong_pixels == 0);
    const Composited keeps_ties = found_by(peeling::TiePolicy::first, entries);
    CHECK(keeps_ties.lost == 1);
    CHECK(keeps_ties.wrong_pixels == 1);
}

TEST_CASE("lost and repeated and misplaced fragments are counted with their pixels") {
    const Composited lost = found_by(peeling::TiePolicy::unique, {{0, 3, 1, front, true}});
    CHECK(lost.lost == 2);
    CHECK(lost.wrong_pixels == 2);
    const Composited repeated =
        found_by(peeling::TiePolicy::unique,
                 {{0, 3, 1, front, true}, {0, 3, 1, front, true}, {0, 5, 0, front, true}, {1, 7, 2, front, true}});
    CHECK(repeated.repeated == 1);
    CHECK(repeated.wrong_pixels == 1);
    const Composited misplaced =
        found_by(peeling::TiePolicy::unique, {{0, 5, 0, front, true}, {0, 3, 1, front, true}, {1, 7, 2, front, true}});
    CHECK(misplaced.misplaced == 1);
    CHECK(misplaced.wrong_pixels == 1);
    // A layer at the opaque surface's depth belongs to no fragment.
    const Composited invented =
        found_by(peeling::TiePolicy::unique,
                 {{0, 3, 1, front, true}, {0, 5, 0, front, true}, {1, 7, 2, front, true}, {1, 20, 4, front, true}});
    CHECK(invented.repeated == 1);
}

TEST_CASE("a fragment with alpha 0 is not a layer where an alpha test detects layers") {
    const Entries entries{{0, 3, 1, front, true}, {0, 5, 0, front, true}};
    CHECK(found_by(peeling::TiePolicy::unique, entries, true).wrong_pixels == 0);
    CHECK(found_by(peeling::TiePolicy::unique, entries, false).lost == 1);
}

TEST_CASE("pixels are visited in frame order with their fragments and empty pixels between them cost nothing") {
    const peeling::Algorithm& algorithm = *peeling::find_algorithm("dual");
    peeling::FrameFragments fragments;
    // A frame of 2^10 x 2^10 pixels of which three are listed: one with a visible fragment, one with both, one with a
    // composited layer.
    constexpr int side = 1 << 10;
    fragments.opaque.resize(std::size_t{side} * side, 100);
    fragments.all.push_back({.pixel = 2 * side, .primitive = 1, .code = 9, .exact_code = 9, .color = {1, 1, 1, 1}});
    fragments.all.push_back({.pixel = side + 5, .primitive = 0, .code = 8, .exact_code = 8, .color = {1, 1, 1, 1}});
    const std::vector<peeling::RegionTrace> traces{{{4, 1, 8, 2}, {{1, 8, 0, front, true}, {3, 1, 7, back, true}}},
                                                   {{4, 1, 8, 2}, {{3, 2, 6, front, true}, {3, 0, 5, back, true}}}};
    const auto pixels = tools::composed_pixels({algorithm, side, true, fragments, traces});
    REQUIRE(pixels.size() == 3);
    CHECK((pixels[0].pixel == side + 5 && pixels[1].pixel == side + 7 && pixels[2].pixel == 2 * side));
    CHECK((pixels[0].visible.size() == 1 && pixels[0].sequence.size() == 1));
    CHECK(pixels[1].visible.empty());
    // From the near end in the order of the passes; from the far end, in reverse.
    REQUIRE(pixels[1].sequence.size() == 3);
    CHECK(pixels[1].sequence[0].primitive == 6);
    CHECK(pixels[1].sequence[1].primitive == 5);
    CHECK(pixels[1].sequence[2].primitive == 7);
    CHECK((pixels[2].visible.size() == 1 && pixels[2].sequence.empty()));
}
