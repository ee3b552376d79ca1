// The model: lines made up by hand, and the numbers that the page ought to show.
#include "tools/strata/hard_cases/hard_page.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"

using namespace strata;

TEST_CASE("the page counts each verdict a device, and tells the first trouble of each kind") {
    const tools::HardSweep sweep{.cases = {scenes::find_hard_case("coincident")},
                                 .profiles = {*pipeline::find_profile("geforce8"), *pipeline::find_profile("ideal")},
                                 .formats = {pipeline::DepthFormat::d24},
                                 .algorithms = {peeling::find_algorithm("dual"), peeling::find_algorithm("k_buffer")}};
    tools::HardRow breaks, refused;
    breaks.verdict = tools::HardVerdict::breaks;
    breaks.reasons = {"2048 fragments lost by ties at 1024 pixels"};
    refused.verdict = tools::HardVerdict::refused;
    refused.refusal = "no";
    const tools::Lines lines{to_line(sweep, 0, breaks), to_line(sweep, 1, refused), to_line(sweep, 2, breaks),
                             to_line(sweep, 3, {})};
    const std::string page = page_of(sweep, lines);
    CHECK_THAT(page, Catch::Contains("| all | 1 | 0 | 2 | 0 | 1 |\n"));
    CHECK_THAT(page, Catch::Contains("| geforce8 | 0 | 0 | 1 | 0 | 1 |\n"));
    CHECK_THAT(page, Catch::Contains("| ideal | 1 | 0 | 1 | 0 | 0 |\n"));
    CHECK_THAT(page, Catch::Contains("- breaks as the hardware did, for instance dual on geforce8 at d24: 2048 "
                                     "fragments lost by ties at 1024 pixels.\n"));
    CHECK_THAT(page, Catch::Contains("![coincident](pictures/coincident.png)"));
    CHECK_THAT(page, Catch::Contains("Exact geometry has 3072 visible fragments, 3 at the deepest pixel, 1 layers"));
}
