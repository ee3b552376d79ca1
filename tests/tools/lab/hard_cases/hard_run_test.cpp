// Tests the runs of hard cases on cases whose outcome follows from the algorithms' own rules, and on an algorithm with
// a deliberate mistake.
#include "tools/lab/hard_cases/hard_run.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "rasterizer/base/simd.h"
#include "tests/tools/lab/hard_cases/broken_peel.h"

namespace {

using namespace strata;
using namespace strata::pipeline;
using strata::test::peel_by_less;
using tools::HardCaseRenderer;
using tools::HardRow;
using tools::HardVerdict;

HardRow run(const char* hard, const char* profile, DepthFormat format, const peeling::Algorithm& algorithm) {
    return HardCaseRenderer{*scenes::find_hard_case(hard), *find_profile(profile), format}.run(algorithm);
}
HardRow run(const char* hard, const char* profile, DepthFormat format, const char* algorithm) {
    return run(hard, profile, format, *peeling::find_algorithm(algorithm));
}

}  // namespace

TEST_CASE("crossing planes are stable where the format distinguishes them and break where two depths are equal") {
    const HardRow stable = run("crossing-between-rows", "geforce8", DepthFormat::d24, "front_to_back");
    CHECK(stable.verdict == HardVerdict::stable);
    CHECK(stable.reasons.empty());
    CHECK(stable.found.visible == 2048);
    const HardRow breaks = run("crossing-along-a-row", "geforce8", DepthFormat::d24, "front_to_back");
    CHECK(breaks.verdict == HardVerdict::breaks);
    CHECK(breaks.found.tied_pixels == 32);
    CHECK(breaks.found.lost_by_ties == 32);
    CHECK(run("crossing-along-a-row", "geforce8", DepthFormat::d24, "layer_peel").found.lost == 0);
}

TEST_CASE("sorted triangles break on a cyclic overlap and their diagnostic names the pixels") {
    const HardRow row = run("cyclic-overlap", "geforce3", DepthFormat::d24, "painter");
    CHECK(row.verdict == HardVerdict::breaks);
    CHECK(row.found.wrong_pixels > 0);
    const auto named = std::find_if(row.diagnostics.begin(), row.diagnostics.end(),
                                    [](const Diagnostic& d) { return d.fault == Fault::out_of_order; });
    REQUIRE(named != row.diagnostics.end());
    CHECK(named->pixels == row.found.wrong_pixels);
}

TEST_CASE("a strip of 1/256 pixel vanishes on a grid of 1/16 which is a loss of geometry and not of layers") {
    const HardRow coarse = run("sliver-1-256", "geforce3", DepthFormat::d24, "depth_units");
    CHECK(coarse.verdict == HardVerdict::degrades);
    CHECK(coarse.found.visible == 0);
    CHECK(run("sliver-1-256", "geforce8", DepthFormat::d24, "depth_units").verdict == HardVerdict::stable);
}

// Dual peeling keeps depths in a float target by MAX blending, where G80 flushes denormals.
TEST_CASE("denormal depths are lost to dual peeling where blending flushes them and a diagnostic names the pixels") {
    const HardRow flushed = run("depth-denormal", "geforce8", DepthFormat::d32f, "dual");
    CHECK(flushed.verdict == HardVerdict::breaks);
    CHECK(flushed.found.wrong_pixels == 1024);
    // The colour that keeps the previous depth is flushed, too, so this peel would never end.
    CHECK(run("depth-denormal", "geforce8", DepthFormat::d32f, "coherent_blend").verdict == HardVerdict::breaks);
    CHECK(run("depth-denormal", "ideal", DepthFormat::d32f, "dual").verdict == HardVerdict::stable);
    CHECK(run("depth-denormal", "geforce8", DepthFormat::d32f, "front_to_back").verdict == HardVerdict::stable);
}

TEST_CASE("a reversed depth range is rejected by name") {
    const HardRow row = run("reversed-range", "geforce8", DepthFormat::d24, "dual");
    CHECK(row.verdict == HardVerdict::refused);
    CHECK_THAT(row.refusal, Catch::Contains("reversed depth range"));
}

TEST_CASE("a peel that compares with < in place of <= fails with the fragments that it repeats and loses") {
    peeling::Algorithm broken = *peeling::find_algorithm("front_to_back");
    peel_by_less(broken);
    const HardRow row = run("crossing-between-rows", "geforce8", DepthFormat::d24, broken);
    CHECK(row.verdict == HardVerdict::failed);
    // Each of 1024 pixels shows its nearer layer four times and never the farther one.
    CHECK(row.found.repeated == 3 * 1024);
    CHECK(row.found.lost == 1024);
    CHECK(row.found.wrong_pixels == 1024);
}

TEST_CASE("no algorithm fails on a selection of hard cases on any of four devices") {
    int rows = 0;
    std::string first;
    for (const char* hard : {"planes-8-close", "cyclic-overlap", "three-through-a-point", "through-near-and-far",
                             "alpha-half-a-code", "infinite-vertices", "frame-1x1"})
        for (const char* profile : {"geforce3", "geforce8", "ideal", "llvmpipe"}) {
            HardCaseRenderer renderer{*scenes::find_hard_case(hard), *find_profile(profile), DepthFormat::d24};
            for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
                const HardRow row = renderer.run(algorithm);
                if (row.verdict != HardVerdict::refused) ++rows;
                if (row.verdict == HardVerdict::failed && first.empty())
                    first = std::string{hard} + " " + profile + " " + algorithm.name + ": " + row.reasons.front();
            }
        }
    CHECK(first == "");
    CHECK(rows > 350);
}

TEST_CASE("every case runs in every execution except deep ones and huge frames which combine them") {
    std::vector<std::string> combined, other;
    for (const scenes::HardCase& hard : scenes::hard_cases()) {
        const std::vector<std::string> ways = tools::ways_of(hard);
        CHECK(ways.front() == "default");
        const bool is_usual = ways.size() == 4 + available_simd().size() && ways[1] == "literal" &&
                              ways[2] == "threads=2" && ways[3] == "effects=all";
        const bool is_combined = ways.size() == 2 && ways[1] == "literal threads=2 effects=all simd=scalar";
        if (is_combined) combined.emplace_back(hard.name);
        if (!is_combined && !is_usual) other.push_back(std::string{hard.name} + ": " + ways.at(1));
    }
    CHECK(combined ==
          std::vector<std::string>{"million-in-a-pixel", "layer-ladder", "counts-past-2048", "frame-8192x8192"});
    CHECK(other.empty());
}

TEST_CASE("an algorithm whose default execution differs from its literal passes fails") {
    peeling::Algorithm broken = *peeling::find_algorithm("front_to_back");
    broken.resolve_loop = [](Region& region) {
        if (region.frame().replay.bytes == 0) return false;  // literal execution
        const Target result = region.make_color();
        region.copy(region.opaque_color(), result);
        region.publish(result);
        return true;
    };
    const auto has = [](const HardRow& row, const char* way) {
        return std::find(row.unlike.begin(), row.unlike.end(), way) != row.unlike.end();
    };
    const HardRow usual = run("layer-1", "ideal", DepthFormat::d24, broken);
    CHECK(usual.verdict == HardVerdict::failed);
    CHECK(has(usual, "literal"));
    CHECK(!has(usual, "threads=2"));
}
