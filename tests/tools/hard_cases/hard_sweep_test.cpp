// Tests the sweep over hard cases: shards and resumed runs against the bytes of an uninterrupted one, and the number of
// combinations, counted by hand.
#include "tools/lab/hard_cases/hard_sweep.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
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

TEST_CASE("a sweep of hard cases has the same bytes in shards and when resumed after being truncated at any line") {
    const test::TemporaryFolder whole, parts, torn;
    const tools::HardSweep sweep = small_sweep();
    const tools::Work work = hard_work(sweep);
    CHECK(work.cells == 2 * 2 * 2 * 2);
    CHECK(run_sweep(work, whole.path, {}) == 0);
    const std::string bytes = bytes_of(whole / "results.jsonl"), table = bytes_of(whole / "results.csv");
    CHECK(std::count(bytes.begin(), bytes.end(), '\n') == 16);
    CHECK(std::count(table.begin(), table.end(), '\n') == 17);

    for (std::size_t index = 1; index <= 3; ++index) CHECK(run_sweep(hard_work(sweep), parts.path, {index, 3}) == 0);
    CHECK(merge_shards(work, parts.path, 3) == 0);
    CHECK(bytes_of(parts / "results.jsonl") == bytes);
    CHECK(bytes_of(parts / "results.csv") == table);

    int unlike = 0;
    for (std::size_t kept = 0; kept < bytes.size(); kept += 397) {
        std::ofstream(torn / "results.jsonl", std::ios::binary) << bytes.substr(0, kept);
        static_cast<void>(run_sweep(hard_work(sweep), torn.path, {}));
        if (bytes_of(torn / "results.jsonl") != bytes) ++unlike;
    }
    CHECK(unlike == 0);
}

TEST_CASE("lines of another sweep are rejected and so is an incomplete shard") {
    const test::TemporaryFolder folder;
    const tools::HardSweep sweep = small_sweep();
    static_cast<void>(run_sweep(hard_work(sweep), folder.path, {}));
    tools::HardSweep other = small_sweep();
    other.algorithms = {peeling::find_algorithm("painter")};
    CHECK_THROWS_AS(run_sweep(hard_work(other), folder.path, {}), InputError);
    CHECK_THROWS_WITH(merge_shards(hard_work(sweep), folder.path, 2), Catch::Contains("one a cell of the shard"));
    const std::string nowhere = folder / "nowhere";
    CHECK_THROWS_WITH(merge_shards(hard_work(sweep), nowhere, 2),
                      nowhere + ": no such folder; it is to hold the results of 2 shards");
    CHECK_FALSE(std::filesystem::exists(nowhere));
}

TEST_CASE("a sweep of hard cases in which every combination is rejected has exit status 2") {
    const test::TemporaryFolder folder;
    tools::HardSweep sweep = small_sweep();
    sweep.cases = {scenes::find_hard_case("reversed-range")};
    CHECK(run_sweep(hard_work(sweep), folder.path, {}) == 2);
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
