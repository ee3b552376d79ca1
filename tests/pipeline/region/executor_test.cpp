// Tests bodies that an incorrect executor gets wrong. Literal execution is the definition; the expected result of each
// body is also worked out here.
#include "pipeline/region/executor.h"

#include <bit>
#include <catch2/catch.hpp>
#include <set>

#include "pipeline/device/check.h"
#include "pipeline/region/region_shortcuts.h"
#include "tests/pipeline/frames.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr int slots = 12;

float slot_depth(int slot) { return static_cast<float>(slot + 1) / 16.0f; }

// Counts the fragments at the depth of `slot`; with `opaque_only` those of alpha 1 only.
Count count_slot(Region& region, int slot, bool opaque_only = false) {
    const std::uint32_t code = std::bit_cast<std::uint32_t>(slot_depth(slot));
    return region
        .draw(PassState{},
              [&](const FragmentBatch& in, const Loads&, Outputs& out) {
                  for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                      if (in.code[i] != code || (opaque_only && in.color[3][i] != 1.0f)) out.alive[i] = 0;
              })
        .passed;
}

// Adds one code to `channel` of every pixel.
void add_one(Region& region, Target sum, std::size_t channel) {
    PassState state;
    state.color[0] = sum;
    state.blend[0] = blend_mode::sum;
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch&, const Loads&, Outputs& out) {
        for (std::size_t c = 0; c < 4; ++c) out.color[0][c].fill(c == channel ? 1.0f / 255.0f : 0.0f);
    }));
}

// Adds one code of red where there is a fragment in `slot`.
void add_found(Region& region, Target sum, int slot) {
    PassState state;
    state.color[0] = sum;
    state.blend[0] = blend_mode::sum;
    const std::uint32_t code = std::bit_cast<std::uint32_t>(slot_depth(slot));
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            if (in.code[i] != code) out.alive[i] = 0;
            for (std::size_t c = 0; c < 4; ++c) out.color[0][c][i] = c == 0 ? 1.0f / 255.0f : 0.0f;
        }
    }));
}

struct Spot {
    std::size_t pixel;
    std::vector<int> slots;  // one fragment in each slot
    float alpha = 0.5f;
};

FragmentScene spots(const std::vector<Spot>& all) {
    FragmentScene scene{32, 16};  // eight tiles of 8 x 8
    for (const Spot& spot : all)
        for (const int slot : spot.slots)
            scene.pixels[spot.pixel].fragments.push_back({slot_depth(slot), {1, 1, 1, spot.alpha}});
    return scene;
}

// (a) and (d): red counts the frame's iterations at every pixel, including pixels without fragments left.
void count_iterations(Region& region) {
    const Target sum = region.make_color();
    for (int slot = 0; slot < slots && !region.limit_reached(); ++slot) {
        region.begin_iteration();
        const Count found = count_slot(region, slot);
        add_one(region, sum, 0);
        if (!region.any(found, Idle::no)) break;
    }
    region.publish(sum);
}

// (c): two queries per iteration. Green counts the iterations that found alpha 1, blue those that did not.
template <Idle promise>
void branch(Region& region) {
    const Target sum = region.make_color();
    for (int slot = 0; slot < slots && !region.limit_reached(); ++slot) {
        region.begin_iteration();
        const bool opaque = region.any(count_slot(region, slot, true), Idle::no);
        if (opaque || promise == Idle::no) add_one(region, sum, opaque ? 1 : 2);
        if (!opaque) static_cast<void>(count_slot(region, slots));  // finds nothing, but is counted
        if (!region.any(count_slot(region, slot), promise)) break;
    }
    static_cast<void>(count_slot(region, 0));  // a pass after the loop
    region.publish(sum);
}

// One loop from each of these slots. A tile that has found all of a loop's fragments leaves the loop.
template <int... starts>
void loops_from(Region& region) {
    const Target sum = region.make_color();
    for (const int start : {starts...}) {
        region.begin_loop();
        for (int slot = start; slot < slots && !region.limit_reached(2); ++slot) {
            region.begin_iteration();
            const Count found = count_slot(region, slot);
            add_found(region, sum, slot);
            if (!region.any(found, Idle::yes)) break;
        }
    }
    region.publish(sum);
}

FrameResult execute(const TestFrame& test, const Body& body, Execution execution) {
    return run(test.frame, body, execution, 2);
}

// Checks that replay of the test's tiles, with memory for every fragment, for one byte and for none, equals literal
// execution; returns the literal result.
FrameResult both(const TestFrame& test, const Body& body) {
    FrameResult literal = execute(test, body, Execution::literal);
    constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
    for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1}, megabyte}) {
        Frame frame = test.frame;
        frame.replay.bytes = memory;
        const FrameResult found = run(frame, body, Execution::replay, 2);
        INFO(memory << " bytes of fragments a region");
        CHECK(found.color == literal.color);
        CHECK(found.iterations == literal.iterations);
        CHECK(found.passes == literal.passes);
        CHECK_FALSE(found.counters.has_value());
        CHECK(found.diagnostics == literal.diagnostics);
    }
    return literal;
}

// Two codes that identify each pixel of these frames.
void write_place(Region& region, Target target) {
    PassState state;
    state.color[0] = target;
    static_cast<void>(region.full_screen(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            out.color[0][0][i] = static_cast<float>(in.x[i]) / 255.0f;
            out.color[0][1][i] = static_cast<float>(in.y[i]) / 255.0f;
            out.color[0][2][i] = out.color[0][3][i] = 0;
        }
    }));
}

// Loads must be of the fragment's own pixel: red counts the fragments and full-screen pixels for which they are.
void read_place(Region& region) {
    const Target places = region.make(Format::rgba8), sum = region.make_color();
    write_place(region, places);
    PassState state;
    state.reads[0] = places;
    state.color[0] = sum;
    state.blend[0] = blend_mode::sum;
    const auto program = [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const bool same = loads.color(0)[0][i] == static_cast<float>(in.x[i]) / 255.0f &&
                              loads.color(0)[1][i] == static_cast<float>(in.y[i]) / 255.0f;
            out.color[0][0][i] = same ? 1.0f / 255.0f : 0.0f;
            for (std::size_t c = 1; c < 4; ++c) out.color[0][c][i] = 0;
        }
    };
    for (int pass = 0; pass < 2; ++pass) static_cast<void>(region.draw(state, program));  // the second may be replayed
    static_cast<void>(region.full_screen(state, program));
    region.publish(sum);
}

// The code of every pixel in `channel` if they are all equal; else -1.
int everywhere(const FrameResult& result, std::size_t channel) {
    const auto& codes = result.color.codes;
    for (std::size_t i = channel; i < codes.size(); i += 4)
        if (codes[i] != codes[channel]) return -1;
    return static_cast<int>(codes[channel]);
}

}  // namespace

// One layer from the far and one from the near end per iteration; green where there is a fragment in the slot.
void keep_both_ends(Region& region) {
    const Target layer = region.make_color(), depth = region.make_depth();
    const auto keep = [&](int slot, Side side) {
        region.clear(layer, {.color = {0, 0, 0, 0}});
        region.clear(depth, {.depth = 1});
        add_found(region, layer, slot);
        region.keep_layer(layer, depth, side);
    };
    for (int slot = 0; slot < slots && !region.limit_reached(); ++slot) {
        region.begin_iteration();
        const Count found = count_slot(region, slot);
        keep(slots - 1 - slot, Side::back);
        keep(slot, Side::front);
        if (!region.any(found, Idle::yes)) break;
    }
    region.clear(layer, {.color = {0, 0, 0, 0}});
    region.clear(depth, {.depth = 1});
    region.keep_no_layer(layer, depth);
    region.publish(layer);
}

TEST_CASE("layers keep the end from which they were peeled whichever tile stops first") {
    // Five, one and two slots in the first tile, in a middle one and in the last.
    for (const std::size_t deepest : {std::size_t{1}, std::size_t{260}, std::size_t{511}}) {
        TestFrame test{spots({{1, {0}}, {260, {0, 11}}, {511, {0, 1}}, {deepest, {0, 1, 2, 3, 4, 7}}}), "geforce8"};
        test.frame.keep_layers = true;
        const FrameResult literal = execute(test, keep_both_ends, Execution::literal);
        // Slots 0 to 4 have fragments and slot 5 has none: six iterations of two layers, and a last one without.
        REQUIRE(literal.layers.size() == 12);
        for (std::size_t i = 0; i < 12; ++i) CHECK(literal.layers[i].side == (i % 2 == 0 ? Side::back : Side::front));
        const FrameResult tiled = execute(test, keep_both_ends, Execution::replay);
        REQUIRE(tiled.layers.size() == 12);
        for (std::size_t i = 0; i < 12; ++i) {
            INFO("layer " << i << ", deepest at pixel " << deepest);
            CHECK(tiled.layers[i].side == literal.layers[i].side);
            CHECK(tiled.layers[i].color == literal.layers[i].color);
            CHECK(tiled.layers[i].depth == literal.layers[i].depth);
        }
    }
}

TEST_CASE("a body that changes finished pixels runs every tile to the frame's end") {
    const TestFrame test{spots({{5, {0, 1, 2, 3}}, {20, {0}}}), "geforce8"};  // most tiles are empty
    const FrameResult result = both(test, count_iterations);
    CHECK(result.iterations == 5);
    CHECK(everywhere(result, 0) == 5);
    CHECK(result.passes == PassCount{5, 5, 0});
    CHECK(result.counters->fragments_rasterized == 5 * 5);
    CHECK(result.counters->blended == 5);
}

TEST_CASE("a tile whose count is zero and is nonzero later continues with the frame") {
    // Tile 0 has nothing in slots 1 and 3, tile 2 fills these gaps; slot 4 is empty everywhere, so slot 5 is never
    // reached.
    const TestFrame test{spots({{5, {0, 2, 5}}, {20, {1}}, {300, {3}}}), "geforce8"};
    const FrameResult result = both(test, count_iterations);
    CHECK(result.iterations == 5);
    CHECK(everywhere(result, 0) == 5);
    CHECK(result.counters->blended == 4);
}

TEST_CASE("a tile leaves each of several loops by itself and counts the cost of the frame's loops") {
    // Loop 1 finds slots 0 to 3 and not 4, loop 2 slots 6 and 7 and not 8; tile 3 has nothing, others less.
    const TestFrame test{spots({{5, {0, 1, 2, 3}}, {20, {0, 6}}, {300, {6, 7}}, {301, {0, 1}}}), "geforce8"};
    const FrameResult result = both(test, loops_from<0, 6>);
    CHECK(result.iterations == 5 + 3);
    CHECK(result.passes.geometry == 2 * (5 + 3));
    CHECK(result.answers == Answers{{}, {true, true, true, true, false}, {true, true, false}});
    CHECK(result.color.codes[4 * 5] == 4);
    CHECK(result.color.codes[4 * 20] == 2);
    CHECK(result.color.codes[4 * 300] == 2);
}

TEST_CASE("a limit ends the third loop where the frame's passes end even if tiles left the first two early") {
    // Slots 0 to 2, 4 to 6 and 8 to 10 have fragments, in tile 0 alone or in others: four iterations of two passes.
    const std::vector<Spot> all{
        {1, {0, 1, 2, 4, 8, 9}}, {28, {0, 4, 5, 6}}, {260, {8}}, {511, {0, 1, 8, 9, 10}}, {300, {4}}};
    std::set<int> iterations;
    for (int limit = 1; limit <= 26; ++limit) {
        TestFrame test{spots(all), "geforce8"};
        test.frame.max_passes = limit;
        INFO("at most " << limit << " passes");
        iterations.insert(both(test, loops_from<0, 4, 8>).iterations);
    }
    CHECK(iterations.size() >= 10);
}

TEST_CASE("a ratio is of the frame's pixels and stops tiles that would continue by their own count") {
    TestFrame test{spots({{0, {0, 1, 2, 3, 4, 5}}, {1, {0, 1, 2}}, {40, {0, 1}}, {100, {0}}, {500, {0, 1, 2, 3}}}),
                   "geforce8"};
    // Counts 5, 4, 3, 2, 1 and 1 of 512 pixels.
    for (const auto& [count, iterations] : {std::pair{6, 1}, {5, 2}, {4, 3}, {3, 4}, {2, 5}, {1, 7}}) {
        test.frame.termination = {.rule = TerminationRule::ratio, .ratio = count / 512.0};
        const FrameResult result = both(test, count_iterations);
        CHECK(result.iterations == iterations);
        CHECK(everywhere(result, 0) == iterations);
    }
}

TEST_CASE("two queries per iteration and one for a branch are answered for the whole frame") {
    // Alpha 1 is found in slots 0 (tile 0), 2 (tile 3) and 3 (tile 7); no fragment at all in slot 5.
    const TestFrame test{spots({{1, {0}, 1}, {2, {1, 2, 3, 4}}, {28, {2}, 1}, {511, {3}, 1}, {260, {0, 4, 6}}}),
                         "geforce8"};
    const FrameResult result = both(test, branch<Idle::no>);
    CHECK(result.iterations == 6);
    CHECK(everywhere(result, 1) == 3);
    CHECK(everywhere(result, 2) == 3);
    CHECK(result.passes == PassCount{2 * 6 + 3 + 1, 6, 0});
}

TEST_CASE("passes after a branch are those of the frame whichever tile is idle") {
    const auto scene = [](int first, float alpha) {
        return spots({{static_cast<std::size_t>(first), {0}, alpha}, {3, {0, 1, 2, 3, 4}}, {28, {0, 1}}, {300, {0}}});
    };
    for (const int first : {1, 255}) {
        // Alpha 1 in slot 0 alone: every later iteration of every tile takes the same branch, so the promise holds.
        const TestFrame once{scene(first, 1), "geforce8"};
        const FrameResult found = both(once, branch<Idle::yes>);
        CHECK(found.iterations == 6);
        CHECK(everywhere(found, 1) == 1);
        CHECK(found.passes == PassCount{2 * 6 + 5 + 1, 1, 0});
        // No alpha 1 at all: every iteration is like the one before.
        const TestFrame never{scene(first, 0.5f), "geforce8"};
        CHECK(both(never, branch<Idle::yes>).passes == PassCount{2 * 6 + 6 + 1, 0, 0});
    }
}

// Every iteration adds to all pixels, so a tile with nothing left is not idle.
TEST_CASE("a broken promise is detected where promises are not trusted") {
    const TestFrame test{spots({{1, {0}}, {28, {0, 1, 2}}}), "geforce8"};
    const Body broken = [](Region& region) {
        const Target sum = region.make_color();
        for (int slot = 0; slot < slots; ++slot) {
            region.begin_iteration();
            const Count found = count_slot(region, slot);
            add_one(region, sum, 0);
            if (!region.any(found, Idle::yes)) break;
        }
        region.publish(sum);
    };
    const auto left_by = [&](Execution execution, bool trust) {
        return run(test.frame, broken, execution, 1, {}, {.trust_idle = trust}).color;
    };
    const Image literal = left_by(Execution::literal, true);
    CHECK(left_by(Execution::replay, false) == literal);
    CHECK_FALSE(left_by(Execution::replay, true) == literal);
}

TEST_CASE("a program loads only its own pixel in any region for fragments of any source") {
    std::vector<Spot> everywhere_once;
    for (std::size_t pixel = 0; pixel < 32 * 16; ++pixel)
        everywhere_once.push_back({pixel, {static_cast<int>(pixel % slots)}});
    const TestFrame test{spots(everywhere_once), "geforce8"};
    CHECK(everywhere(both(test, read_place), 0) == 3);  // two draws and one full-screen pass
}

TEST_CASE("max_passes and fixed:N count geometry passes equally in every region") {
    TestFrame test{spots({{5, {0, 1, 2, 3}}, {20, {0}}}), "geforce8"};
    for (int passes = 1; passes <= 8; ++passes) {
        test.frame.termination = {};
        test.frame.max_passes = passes;
        CHECK(everywhere(both(test, count_iterations), 0) == std::min(passes, 5));
        test.frame.max_passes = 0;
        test.frame.termination = {.rule = TerminationRule::fixed, .passes = passes};
        const FrameResult result = both(test, count_iterations);
        CHECK(result.iterations == passes);
        CHECK(everywhere(result, 0) == passes);
    }
}

TEST_CASE("a body without a query runs once and its fragments are counted once") {
    const TestFrame test{spots({{5, {0, 1, 2, 3}}, {20, {0}}, {511, {2}}}), "geforce8", 16};
    const FrameResult result = both(test, [](Region& region) {
        const Target color = region.make_color();
        static_cast<void>(count_slot(region, 0));
        region.publish(color);
    });
    CHECK(result.iterations == 0);
    CHECK(result.passes == PassCount{1, 0, 0});
    CHECK(result.counters->fragments_rasterized == 6);
    CHECK(result.counters->discarded == 4);
}

TEST_CASE("a pass that the profile lacks throws Refused from every execution") {
    const TestFrame test{spots({{5, {0}}}), "geforce8"};
    const Body body = [](Region& region) {
        const Target color = region.make_color();
        PassState state;
        state.color[0] = color;
        state.reads[0] = color;
        state.ordered_rmw = true;
        static_cast<void>(region.full_screen(state, [](const FragmentBatch&, const Loads&, Outputs&) {}));
    };
    for (const Execution execution : {Execution::literal, Execution::replay})
        CHECK_THROWS_MATCHES(
            static_cast<void>(execute(test, body, execution)), Refused,
            Catch::Message("profile geforce8 has no ordered read-modify-write of render targets (STRATA_ordered_rmw); "
                           "use ideal or direct3d11"));
}

TEST_CASE("faults of tiles add up to those of the frame with the first pixel in row-major order") {
    const TestFrame test{spots({{5, {0}}, {300, {0}}, {14, {0}}}), "geforce8"};
    const FrameResult result = both(test, [](Region& region) {
        std::uint64_t pixels = 0;
        std::uint32_t first = ~0u;
        for (const CapturedFragment& f : RegionShortcuts{region}.capture(Counting::silent))
            ++pixels, first = std::min(first, f.pixel);
        region.report(Fault::half_saturated, pixels, first, "a test's");
        region.publish(region.opaque_color());
    });
    REQUIRE(result.diagnostics.size() == 1);
    CHECK(result.diagnostics[0] == Diagnostic{Fault::half_saturated, 3, 5, 0, "a test's"});
}
