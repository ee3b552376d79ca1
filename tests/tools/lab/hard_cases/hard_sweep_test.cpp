// Tests the sweep over hard cases: a shard against the lines of the whole, and the number of combinations, counted by
// hand.
#include "tools/lab/hard_cases/hard_sweep.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "peeling/registry.h"
#include "tests/scenes/scenes_support.h"

namespace {

using namespace strata;
using strata::test::bytes_of;

// reversed-range is rejected in every combination, and geforce3 rejects dual.
tools::HardSweep small_sweep() {
    return {.cases = {scenes::find_hard_case("frame-1x1"), scenes::find_hard_case("reversed-range")},
            .profiles = {*pipeline::find_profile("geforce3"), *pipeline::find_profile("geforce8")},
            .formats = {pipeline::DepthFormat::d16, pipeline::DepthFormat::d24},
            .algorithms = {peeling::find_algorithm("dual"), peeling::find_algorithm("depth_units")}};
}

}  // namespace

TEST_CASE("a sweep of hard cases has a row for each combination and the same ones in shards") {
    const test::TemporaryFolder whole, parts;
    const tools::HardSweep cases = small_sweep();
    const tools::Sweep sweep = sweep_of(cases);
    CHECK(sweep.rows == 2 * 2 * 2 * 2);
    CHECK(run_sweep(sweep, whole.path, {}) == 0);
    const std::string bytes = bytes_of(whole / "results.jsonl"), table = bytes_of(whole / "results.csv");
    CHECK(std::count(bytes.begin(), bytes.end(), '\n') == 16);
    CHECK(std::count(table.begin(), table.end(), '\n') == 17);
    // A shard prepares other groups of rows in another order, and its lines are those of the whole.
    CHECK(run_sweep(sweep_of(cases), parts.path, {2, 3}) == 0);
    std::istringstream all(bytes), own(bytes_of(parts / "results.2of3.jsonl"));
    std::string expected, line;
    for (int row = 0; std::getline(all, expected); ++row)
        if (row % 3 == 1) {
            REQUIRE(std::getline(own, line));
            CHECK(line == expected);
        }
    CHECK_FALSE(std::getline(own, line));
}

TEST_CASE("a sweep of hard cases in which every combination is rejected has exit status 2") {
    const test::TemporaryFolder folder;
    tools::HardSweep sweep = small_sweep();
    sweep.cases = {scenes::find_hard_case("reversed-range")};
    CHECK(run_sweep(sweep_of(sweep), folder.path, {}) == 2);
}

TEST_CASE("a combination that a movement shows to be unstable is reported and fails the sweep") {
    tools::HardSweep sweep = small_sweep();
    tools::MovedRow moved;
    const auto line = [&] { return to_line(sweep, 0, {}, moved); };
    CHECK_FALSE(tools::has_failed({line()}));
    moved.stability.verdict = tools::StabilityVerdict::breaks;
    CHECK_FALSE(tools::has_failed({line()}));
    moved.stability.verdict = tools::StabilityVerdict::unstable;
    moved.stability.reasons = {"everything moves", "at once"};
    CHECK(tools::has_failed({line()}));
    CHECK_THAT(summary(sweep, {line()}),
               Catch::Contains("unstable: frame-1x1 by dual on geforce3 at d16: everything moves; at once\n"));
}
