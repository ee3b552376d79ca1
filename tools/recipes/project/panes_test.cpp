#include <strata/catch2.h>

#include "wanted.h"

TEST_CASE("the rendered panes equal the reference image to the bit") {
    const auto pixels = draw_panes();
    const auto mine = strata::from_memory(pixels.data(), pixels.size(), "64x48:rgba8");
    const strata::Reference wanted{strata::picture_of(reference_panes().color()), "panes"};
    REQUIRE_THAT(mine, strata::MatchesReference(wanted));
}
