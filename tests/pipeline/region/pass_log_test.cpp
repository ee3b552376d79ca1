// Tests the pass log with a body that marks every pass with the number of its tile, so the expected log is known.
#include <catch2/catch.hpp>

#include "pipeline/region/region.h"
#include "tests/pipeline/frames.h"

using namespace strata::pipeline;
using strata::testing::FragmentScene;
using strata::testing::TestFrame;

namespace {

constexpr int side = 64, tile = 8, tiles = (side / tile) * (side / tile), draws = 40;

FragmentScene one_fragment_a_pixel() {
    FragmentScene scene{side, side};
    for (auto& pixel : scene.pixels) pixel.fragments = {{0.5f, {1, 1, 1, 0.5f}}};
    return scene;
}

float tile_of(const strata::rasterizer::Rect& rect) {
    return static_cast<float>(rect.y0 / tile * (side / tile) + rect.x0 / tile);
}

// The tile is stored in the alpha test's reference value, the pass in the record's iteration.
void marked_passes(Region& region) {
    PassState state;
    state.color[0] = region.make_color();
    state.alpha = {.enabled = true, .func = CompareFunc::always, .ref = tile_of(region.rect())};
    for (int pass = 0; pass < draws; ++pass) {
        region.begin_iteration();
        const DrawCounts drawn =
            region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; });
        if (pass % 4 == 0) static_cast<void>(region.any(drawn.passed, Idle::no));
    }
    region.publish(state.color[0]);
}

FrameResult logged(const TestFrame& test, Execution execution, int threads) {
    return run(test.frame, marked_passes, execution, threads, {}, {.log_passes = true});
}

}  // namespace

TEST_CASE("a pass log has every region's passes in the order of the regions for any number of threads", "[slow]") {
    const TestFrame test{one_fragment_a_pixel(), "ideal", tile};
    for (const int threads : {1, 2, 8}) {
        const PassLog log = logged(test, Execution::replay, threads).pass_log;
        REQUIRE(log.passes.size() == static_cast<std::size_t>(tiles * draws));
        int wrong = 0;
        for (int i = 0; i < tiles * draws; ++i) {
            const PassRecord& record = log.passes[static_cast<std::size_t>(i)];
            wrong += record.state.alpha.ref != static_cast<float>(i / draws) || record.iteration != i % draws + 1;
        }
        INFO(threads << " threads");
        CHECK(wrong == 0);
        CHECK(log.queries == tiles * draws / 4);
    }
}

TEST_CASE("literal execution logs the frame's passes once") {
    const TestFrame test{one_fragment_a_pixel(), "ideal", tile};
    const PassLog log = logged(test, Execution::literal, 4).pass_log;
    CHECK(log.passes.size() == static_cast<std::size_t>(draws));
    CHECK(log.queries == draws / 4);
}

TEST_CASE("a run without logging has no log") {
    const TestFrame test{one_fragment_a_pixel(), "ideal", tile};
    const FrameResult result = run(test.frame, marked_passes, Execution::replay, 2);
    CHECK(result.pass_log.passes.empty());
    CHECK(result.pass_log.queries == 0);
}
