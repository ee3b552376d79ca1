// Tests the list of hypotheses. depth_paths_test.cpp and window_z_test.cpp test the effect of each on depths.
#include "rasterizer/rules/hypotheses.h"

#include <catch2/catch.hpp>

using namespace strata::rasterizer;

TEST_CASE("every hypothesis has a unique name and differs from the given rules in one constant") {
    const RasterRules given{
        .subpixel_bits = 4, .window_z = WindowZ::buffer_units, .depth_rounding = DepthRounding::floor};
    CHECK(depth_hypotheses(given).size() == 1 + 9 + 2 + 2 + 1 + 4 + 6 + 5 + 1 + 1 + 1 + 1 + 1);
    CHECK(interpolation_hypotheses(given).size() == 1 + 5 + 2 + 1 + 1);
    for (const auto& all : {depth_hypotheses(given), interpolation_hypotheses(given)}) {
        CHECK(all[0].rules == given);
        for (std::size_t i = 1; i < all.size(); ++i) {
            CHECK(all[i].rules != given);
            for (std::size_t k = 0; k < i; ++k) CHECK((all[k].name != all[i].name && all[k].rules != all[i].rules));
        }
    }
}
