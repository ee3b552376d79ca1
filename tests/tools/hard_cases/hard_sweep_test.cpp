// The model: the sweep in one go, byte by byte.
#include "tools/strata/hard_cases/hard_sweep.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "tests/scenes/scenes_support.h"

namespace {

using namespace strata;
using strata::test::bytes_of;

tools::HardSweep small_sweep(const std::string& folder) {
    return {.cases = {scenes::find_hard_case("frame-1x1"), scenes::find_hard_case("nothing")},
            .profiles = {*pipeline::find_profile("geforce3"), *pipeline::find_profile("geforce8")},
            .formats = {pipeline::DepthFormat::d16, pipeline::DepthFormat::d24},
            .algorithms = {peeling::find_algorithm("dual"), peeling::find_algorithm("depth_units")},
            .folder = folder,
            .shard = {}};
}

}  // namespace

TEST_CASE("a sweep of hard cases has the same bytes in shards, and after it was torn at any line") {
    const test::TemporaryFolder whole, parts, torn;
    const tools::Lines lines = run_sweep(small_sweep(whole.path));
    CHECK(lines.size() == 2 * 2 * 2 * 2);
    CHECK_FALSE(tools::has_failed(lines));
    const std::string bytes = bytes_of(whole / "results.jsonl");

    tools::HardSweep part = small_sweep(parts.path);
    for (std::size_t index = 1; index <= 3; ++index) {
        part.shard = {index, 3};
        static_cast<void>(run_sweep(part));
    }
    part.shard = {};
    CHECK(merge_shards(part, 3) == lines);
    CHECK(bytes_of(parts / "results.jsonl") == bytes);

    int unlike = 0;
    for (std::size_t kept = 0; kept < bytes.size(); kept += 97) {
        std::ofstream(torn / "results.jsonl", std::ios::binary) << bytes.substr(0, kept);
        static_cast<void>(run_sweep(small_sweep(torn.path)));
        if (bytes_of(torn / "results.jsonl") != bytes) ++unlike;
    }
    CHECK(unlike == 0);
}

TEST_CASE("lines of another sweep are refused, and so is a shard that is not whole") {
    const test::TemporaryFolder folder;
    static_cast<void>(run_sweep(small_sweep(folder.path)));
    tools::HardSweep other = small_sweep(folder.path);
    other.algorithms = {peeling::find_algorithm("painter")};
    CHECK_THROWS_AS(run_sweep(other), InputError);
    CHECK_THROWS_WITH(merge_shards(small_sweep(folder.path), 2), Catch::Contains("one a combination of the shard"));
}
