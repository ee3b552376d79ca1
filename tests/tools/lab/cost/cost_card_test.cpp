// Tests the modelled times of graphics cards. The expected times are worked out by hand from the rates.
#include "tools/lab/cost/cost_card.h"

#include <catch2/catch.hpp>

using namespace strata::tools;

TEST_CASE("a card's time is that of its slowest part") {
    const Card card{"made up", 100, 1000, 10000};
    CHECK(modelled_seconds(card, {.vertices = 50, .fragments = 10, .bytes = 10}) == 0.5);
    CHECK(modelled_seconds(card, {.vertices = 50, .fragments = 3000, .bytes = 10}) == 3);
    CHECK(modelled_seconds(card, {.vertices = 50, .fragments = 3000, .bytes = 70000}) == 7);
}

TEST_CASE("a profile with programs is modelled by the later card which is faster in every rate") {
    const Card &late = card_of(true), &early = card_of(false);
    CHECK(early.name == "GeForce3");
    CHECK(late.vertices_a_second > early.vertices_a_second);
    CHECK(late.fragments_a_second > early.fragments_a_second);
    CHECK(late.bytes_a_second > early.bytes_a_second);
}

TEST_CASE("the paper's own time is given for models and algorithms that the paper timed and for no others") {
    CHECK(printed_seconds("dragon.glb", "coherent_blend").value() == Approx(1.0 / 53));
    CHECK(printed_seconds("sponza.glb", "layer_peel").value() == Approx(1.0 / 35));
    CHECK_FALSE(printed_seconds("dragon.glb", "dual"));
    CHECK_FALSE(printed_seconds("teapot", "layer_peel"));
}
