// Model: the names, typed a second time.
#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "tests/peeling/rendering.h"

TEST_CASE("an algorithm tells what people call its targets") {
    using namespace strata::testing;
    using Names = std::set<std::string>;
    struct NamesOf {
        const char* algorithm;
        Names names;
    };
    const NamesOf expected[]{{"front_to_back", {"accumulated", "layer", "nearest"}},
                             {"depth_units", {"layer", "nearest", "result"}},
                             {"unsorted", {"color"}},
                             {"object_sorted", {"accumulated", "nearest"}},
                             {"weighted_average", {"sums", "count", "result"}},
                             {"weighted_sum", {"sums", "result"}},
                             {"batched", {"layer", "nearest", "accumulated"}},
                             {"dual", {"min_max", "front", "back_layer", "back"}},
                             {"dual_independent", {"min_max", "front", "back"}},
                             {"k_buffer", {"accumulated", "depths", "entry"}},
                             {"a_buffer", {"result"}}};
    FragmentScene scene{2, 2};
    for (GivenPixel& pixel : scene.pixels) pixel.fragments = {{0.25f, {1, 0, 0, 0.5f}}, {0.5f, {0, 1, 0, 0.5f}}};
    for (const NamesOf& each : expected) {
        Names heard;
        const strata::pipeline::Observer observer{
            .named = [&](strata::pipeline::Target, std::string_view name) { heard.emplace(name); }};
        const auto result =
            render(draw_list(scene), {}, {"ideal", each.algorithm}, options_for(scene), {.observer = &observer});
        INFO(each.algorithm);
        CHECK(result.outcome == strata::peeling::Outcome::done);
        CHECK(heard == each.names);
    }
}
