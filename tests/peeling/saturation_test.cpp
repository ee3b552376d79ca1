// Tests the diagnostic of weighted_average when half precision is exceeded: from 2,048 on a half represents only even
// numbers, so a count that increases by one stops.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::pipeline::DeviceProfile;
using strata::pipeline::Diagnostic;
using strata::pipeline::DrawList;
using strata::pipeline::Fault;
using strata::pipeline::find_profile;
using strata::pipeline::Format;
using strata::pipeline::HalfRounding;

// 2,047 fragments on pixel 3, 2,049 on pixels 6 and 7.
FragmentScene deep_pixels() {
    FragmentScene scene{4, 2};
    scene.pixels[3].fragments.assign(2047, {0.5f, {1, 0, 0, 0.25f}});
    for (const std::size_t p : {std::size_t{6}, std::size_t{7}})
        scene.pixels[p].fragments.assign(2049, {0.5f, {1, 0, 0, 0.25f}});
    return scene;
}

}  // namespace

TEST_CASE("a count of fragments that a half cannot represent is reported with its pixels in every execution",
          "[slow]") {
    const FragmentScene scene = deep_pixels();
    for (const Running& running : all_ways_of_running)
        for (const char* profile : {"geforce8", "geforce8_dx101"}) {
            INFO(profile);
            RenderOptions options = options_for(scene);
            running.apply(options);
            const auto result = render(scene, {profile, "weighted_average"}, options);
            REQUIRE(diagnosed(result, Fault::half_saturated) == 2);
            for (const Diagnostic& d : result.frame.diagnostics)
                if (d.fault == Fault::half_saturated) {
                    CHECK(d.first_x == 2);
                    CHECK(d.first_y == 1);
                }
            CHECK_FALSE(has_diagnostic(result, Fault::early_end));
            options.average_count = Format::r32f;
            CHECK_FALSE(has_diagnostic(render(scene, {profile, "weighted_average"}, options), Fault::half_saturated));
        }
}

TEST_CASE("sums that stop at the greatest half are reported where halves are rounded toward zero or have no infinity") {
    FragmentScene scene{4, 2};  // sums of colours of 60000 and 180000
    scene.pixels[1].fragments.assign(20, {0.5f, {6000, 0, 0, 0.5f}});
    scene.pixels[6].fragments.assign(60, {0.5f, {6000, 0, 0, 0.5f}});
    for (const char* algorithm : {"weighted_average", "weighted_sum", "weighted_blended"})
        for (const HalfRounding rounding :
             {HalfRounding::nearest_even, HalfRounding::toward_zero, HalfRounding::no_infinity}) {
            DeviceProfile profile = *find_profile("direct3d11");
            profile.half_rounding = rounding;
            RenderOptions options = options_for(scene);
            options.algorithm.weight = strata::peeling::Weight::constant;
            const DrawList list = draw_list(scene);
            strata::peeling::Renderer renderer{list, {}, profile, options};
            const auto result = renderer.render(*strata::peeling::find_algorithm(algorithm));
            INFO(algorithm << ", rounding " << static_cast<int>(rounding));
            CHECK(diagnosed(result, Fault::half_saturated) == 1);
            for (const Diagnostic& d : result.frame.diagnostics)
                if (d.fault == Fault::half_saturated) CHECK((d.first_x == 2 && d.first_y == 1));
        }
}
