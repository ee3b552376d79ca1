// Tests the memory needed for a frame against sizes of the listed targets, added by hand; an increase of any input
// never reduces the need.
#include "peeling/memory_need.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/parallel.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

// Six fragments at each of 8 x 8 pixels.
DrawList six_layers() {
    FragmentScene scene{8, 8};
    for (GivenPixel& pixel : scene.pixels)
        for (int i = 1; i <= 6; ++i) pixel.fragments.push_back({static_cast<float>(i) / 8.0f, {1, 1, 1, 0.5f}});
    return draw_list(scene);
}

MemoryNeed need_of(const char* algorithm, const RenderOptions& options, const char* profile = "geforce8",
                   int samples = 1) {
    static const DrawList list = six_layers();
    RenderOptions sampled = options;
    sampled.sampling.samples = samples;
    return memory_need({list, {}, *find_profile(profile), sampled}, *find_algorithm(algorithm));
}

RenderOptions options_of(int columns, int rows) {
    RenderOptions options;
    options.width = columns;
    options.height = rows;
    options.threads = 2;
    return options;
}

}  // namespace

TEST_CASE("pictures take 32 bits per channel and per depth") {
    const MemoryNeed need = need_of("dual", options_of(300, 200));
    CHECK(need.pictures == std::uint64_t{300} * 200 * 4 * (4 + 1));
    RenderOptions without = options_of(300, 200);
    without.nearest_depth = false;
    CHECK(need_of("dual", without).pictures == std::uint64_t{300} * 200 * 4 * 4);
}

// A resolve keeps the picture and no targets of passes. Whether denormals are flushed matters only for denormal depths.
TEST_CASE("a resolve takes less memory per pixel than the passes that it replaces and also on devices that flush") {
    for (const char* algorithm : {"dual", "front_to_back"}) {
        RenderOptions options = options_of(1024, 512);
        options.tile_size = 32;
        options.threads = 1;
        const std::uint64_t closed = need_of(algorithm, options).targets / (32 * 32);
        options.execution = Execution::literal;
        const std::uint64_t passes = need_of(algorithm, options).targets / (std::uint64_t{1024} * 512);
        INFO(algorithm << ": " << closed << " bytes a pixel, and " << passes << " by passes");
        CHECK(closed + 4 <= passes);
    }
}

TEST_CASE("targets of a whole frame have every pixel and those of tiles the pixels of as many tiles as run at once") {
    RenderOptions literal = options_of(1000, 500);
    literal.execution = Execution::literal;
    literal.nearest_depth = false;
    RenderOptions replay = literal;
    replay.execution = Execution::replay;
    replay.termination.rule = strata::pipeline::TerminationRule::paper;  // by passes
    replay.tile_size = 32;
    const std::uint64_t whole = need_of("front_to_back", literal).targets / (std::uint64_t{1000} * 500);
    const std::uint64_t tiled = need_of("front_to_back", replay).targets /
                                (static_cast<std::uint64_t>(strata::thread_count(replay.threads)) * 32 * 32);
    CHECK(whole == tiled);
}

// weighted_average's own: sums of two 32-bit values, a count and a result of one each; nothing is kept for a later
// pass.
TEST_CASE("targets are those that the algorithm makes when it runs and only the oracle has lists") {
    RenderOptions literal = options_of(1000, 500);
    literal.execution = Execution::literal;
    literal.audit = false;
    CHECK(need_of("weighted_average", literal).targets >= std::uint64_t{1000} * 500 * 4 * (2 + 1 + 1));
    CHECK(need_of("depth_units", literal).targets >= std::uint64_t{1000} * 500 * 4 * 2);
    CHECK(need_of("weighted_average", literal).fragments == 0);
    CHECK(need_of("a_buffer", literal).fragments >= std::uint64_t{6} * 1000 * 500 * 4);
}

// One frame after the other, or four literal ones together.
TEST_CASE("targets and triangles and fragments of n samples take n times the memory of one") {
    RenderOptions options = options_of(300, 200);
    for (const Execution execution : {Execution::replay, Execution::literal}) {
        options.execution = execution;
        const MemoryNeed one = need_of("front_to_back", options);
        const MemoryNeed four = need_of("front_to_back", options, "geforce8", 4);
        CHECK(four.pictures == std::uint64_t{300} * 200 * 4 * (5 * 4 + 1));  // the audit compares those of all samples
        CHECK(four.targets == 4 * one.targets);
        CHECK(four.fragments > 3 * one.fragments);  // as many as sample 0 covers, which is not at the centre
        CHECK(four.fragments < 5 * one.fragments);
        CHECK(four.triangles == 4 * one.triangles);
    }
}

TEST_CASE("a rejected frame needs nothing") { CHECK(need_of("dual", options_of(64, 64), "geforce3").total() == 0); }

TEST_CASE("an increase of frame size or threads or any memory setting never reduces the need", "[slow]") {
    for (const char* algorithm : {"dual", "front_to_back", "depth_units", "a_buffer", "weighted_average"})
        for (const Execution execution : {Execution::literal, Execution::replay}) {
            INFO(algorithm << (execution == Execution::literal ? ", literal" : ", replay"));
            std::uint64_t before = 0;
            RenderOptions options = options_of(64, 64);
            options.execution = execution;
            options.audit = false;
            options.fragment_memory = 1 << 10;
            options.threads = 1;
            const auto grows = [&] {
                const std::uint64_t now = need_of(algorithm, options).total();
                CHECK(now >= before);
                before = now;
            };
            grows();
            for (const int side : {65, 128, 700, 1024, 4096}) {
                options.width = options.height = side;
                grows();
            }
            options.threads = 7;
            grows();
            options.fragment_memory = 1 << 20;
            grows();
            options.audit = true;
            grows();
        }
}
