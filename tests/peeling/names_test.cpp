// Model: the names, typed a second time.
#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "tests/peeling/rendering.h"

TEST_CASE("an algorithm tells what people call its targets, and how many it renders to at once") {
    using namespace strata::testing;
    using Names = std::set<std::string>;
    struct NamesOf {
        const char* algorithm;
        Names names;
        int render_targets = 1;  // of its widest pass
    };
    const NamesOf expected[]{{"front_to_back", {"accumulated", "layer", "nearest", "result"}},
                             {"depth_units", {"layer", "nearest", "result"}},
                             {"unsorted", {"color"}},
                             {"object_sorted", {"accumulated", "nearest", "result"}},
                             {"weighted_average", {"sums", "count", "result"}, 2},
                             {"weighted_sum", {"sums", "result"}},
                             {"batched", {"layer", "nearest", "accumulated", "result"}},
                             {"dual", {"min_max", "front", "back_layer", "back", "result"}, 3},
                             {"dual_independent", {"min_max", "front", "back", "result"}, 3},
                             {"k_buffer", {"accumulated", "depths", "entry", "result"}, 6},
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
        CHECK(strata::peeling::find_algorithm(each.algorithm)->render_targets == each.render_targets);
    }
}
