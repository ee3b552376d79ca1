// Tests the changes between two pixels. The pixels are written by hand and the expected changes are counted by hand.
#include "tools/lab/hard_cases/moves/hard_result.h"

#include <catch2/catch.hpp>

using strata::tools::FragmentOrderMatch;
using strata::tools::ResultPixel;

namespace {

// Triangle 0 is in front of 1; 2 and 3 are behind in one layer; 5 is lost.
ResultPixel five_fragments() {
    return {.fragments = {{0, 0, 0.25}, {1, 1, 0.5}, {2, 2, 0.75}, {3, 2, 0.75}, {5, -1, 0.75}},
            .layers = 3,
            .color = {0.5, 0.5, 0.5}};
}

}  // namespace

TEST_CASE("an unchanged pixel has no changes and a colour difference is counted in 255ths") {
    ResultPixel after = five_fragments();
    CHECK(changes(five_fragments(), after) == strata::tools::Changes{});
    after.color = {0.5, 0.25, 0.5};
    CHECK(changes(five_fragments(), after).color == 0.25 * 255);
    CHECK_FALSE(changes(five_fragments(), after).is_any());
}

TEST_CASE("a fragment is gained or lost if it becomes composited or is no longer composited") {
    ResultPixel after = five_fragments();
    after.fragments = {{0, 0, 0.25}, {1, -1, 0.5}, {2, 1, 0.5}, {3, 1, 0.75}, {4, 0, 0.25}, {5, 1, 0.75}};
    after.color = {1, 1, 1};
    const auto found = changes(five_fragments(), after);
    CHECK(found.gained == 2);  // 4 and 5
    CHECK(found.lost == 1);    // 1
    CHECK(found.reordered == 0);
    CHECK(found.color == 0);  // not counted where fragments were gained or lost
    CHECK(found.depth == 0.25);
}

TEST_CASE("pairs are reordered when they swap or fall into one layer or are separated") {
    ResultPixel after = five_fragments();
    after.fragments[0].layer = 1;  // now in one layer with 1
    after.fragments[3].layer = 3;  // now behind 2
    CHECK(changes(five_fragments(), after).reordered == 2);
    after.fragments[1].layer = 0;  // now before 0
    CHECK(changes(five_fragments(), after).reordered == 2);
}

TEST_CASE(
    "a pixel shows another one if it composites its fragments once each and in its order where the order counts") {
    ResultPixel other = five_fragments();
    CHECK(matches(other, five_fragments(), FragmentOrderMatch::in_order));
    std::swap(other.fragments[0].layer, other.fragments[1].layer);
    CHECK_FALSE(matches(other, five_fragments(), FragmentOrderMatch::in_order));
    CHECK(matches(other, five_fragments(), FragmentOrderMatch::in_any_order));
    other.layers = 4;  // one of them twice
    CHECK_FALSE(matches(other, five_fragments(), FragmentOrderMatch::in_any_order));
    other = five_fragments();
    other.fragments[2].layer = -1;
    CHECK_FALSE(matches(other, five_fragments(), FragmentOrderMatch::in_any_order));
}
