// Tests the hard cases against exact rational arithmetic over each case's own corners
// (tests/support/exact_fragments.h), without snapping, clipping or formats.
#include <catch2/catch.hpp>
#include <set>

#include "rasterizer/base/input_error.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tests/support/exact_fragments.h"

namespace {

using strata::scenes::hard_cases;
using strata::scenes::HardCase;

std::string in_words(const strata::scenes::HardAnswer& counts) {
    return std::to_string(counts.fragments) + " fragments, " + std::to_string(counts.deepest) + " at a pixel, " +
           std::to_string(counts.layers) + " layers, " + std::to_string(counts.tied_pixels) + " pixels with ties";
}

strata::testing::ExactPixels exact_pixels(const char* name) {
    const HardCase& hard = *strata::scenes::find_hard_case(name);
    return strata::testing::ExactScene{make_hard_case({}, hard), hard}.visible();
}

}  // namespace

TEST_CASE("every hard case has the fragments and layers and ties that it states in exact arithmetic") {
    for (const HardCase& hard : hard_cases()) {
        INFO(hard.name);
        const auto scene = make_hard_case({}, hard);
        CHECK(in_words(counts_of(strata::testing::ExactScene{scene, hard}.visible())) == in_words(hard.counts));
    }
}

TEST_CASE("hard cases have unique names and sentences and a scene of that name") {
    std::set<std::string_view> names;
    CHECK(hard_cases().size() >= 50);
    for (const HardCase& hard : hard_cases()) {
        INFO(hard.name);
        CHECK(names.insert(hard.name).second);
        CHECK(hard.hard.ends_with('.'));
        CHECK(hard.answer.ends_with('.'));
        const auto named = strata::scenes::load_scene("hard:case=" + std::string{hard.name}, {});
        REQUIRE(named.own_view);
        CHECK(named.list.meshes[0].indices == make_hard_case({}, hard).list.meshes[0].indices);
    }
    CHECK_THROWS_WITH(strata::scenes::load_scene("hard:case=planes-1-unt", {}),
                      Catch::Contains("did you mean 'planes-1-unit'?"));
}

TEST_CASE("planes through one line are in reversed order on its two sides in exact arithmetic") {
    const auto pixels = exact_pixels("eight-through-a-line");
    int wrong = 0;
    for (const auto& [p, fragments] : pixels)
        for (std::size_t k = 0; k + 1 < fragments.size(); ++k) {
            const auto& a = fragments[k].depth;
            const auto& b = fragments[k + 1].depth;
            const std::size_t column = p % 32;
            if (column < 16 ? !(a > b) : column == 16 ? a != b : !(a < b)) ++wrong;
        }
    CHECK(wrong == 0);
}

TEST_CASE(
    "in each corner of a cyclic overlap a different one of two neighbouring bars is in front in exact arithmetic") {
    const auto pixels = exact_pixels("cyclic-overlap");
    // The pixels at the corners, row by row, with the bar that is in front there: bar i has triangles 2 i and 2 i + 1.
    struct {
        std::size_t pixel;
        std::uint32_t front, behind;
    } const corners[]{{0, 3, 0}, {31, 0, 1}, {31 * 32 + 31, 1, 2}, {31 * 32, 2, 3}};
    for (const auto& corner : corners) {
        const auto& at = pixels.at(corner.pixel);
        REQUIRE(at.size() == 2);
        const auto& near = at[0].depth < at[1].depth ? at[0] : at[1];
        const auto& far = at[0].depth < at[1].depth ? at[1] : at[0];
        CHECK(near.triangle / 2 == corner.front);
        CHECK(far.triangle / 2 == corner.behind);
    }
}
