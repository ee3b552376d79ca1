// Tests rare uses of regions: the messages of invalid passes, images of several samples and channels, observers and
// alterations with a single function, empty tiles with diagnostics. Expected messages are written by hand; expected
// codes encode their position; counts are made by hand.
#include <catch2/catch.hpp>

#include "pipeline/device/check.h"
#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/changed_states.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

FragmentScene few_fragments() {
    FragmentScene scene{8, 4};
    scene.pixels[3].fragments = {{0.5f, {1, 0, 0, 1}}, {0.25f, {0, 1, 0, 1}}};
    return scene;
}

struct Fixture {
    TestFrame test{few_fragments(), "geforce8"};
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
};

std::string broken(Region& region, const PassState& state) {
    try {
        static_cast<void>(region.draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {}));
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "drawn";
}

}  // namespace

TEST_CASE("a pass with targets of the wrong kind throws an error that names the fault") {
    Fixture f;
    const Target color = f.region.make(Format::rgba8), depth = f.region.make_depth(), s8 = f.region.make(Format::s8);
    PassState state;
    state.depth = nearest_stays;
    state.depth_target = color;
    CHECK(broken(f.region, state) == "pass state: a depth test needs a depth target");
    state = {};
    state.stencil.enabled = true;
    CHECK(broken(f.region, state) == "pass state: a stencil test needs a stencil target");
    state.stencil_target = depth;
    CHECK(broken(f.region, state) == "pass state: a stencil test needs a stencil target");
    state.stencil_target = s8;
    CHECK(broken(f.region, state) == "drawn");
    state.reads[0] = s8;
    CHECK(broken(f.region, state) ==
          "pass state: a target is read and written at once (a feedback loop) without ordered_rmw");
    state = {};
    state.textures[0] = color;
    CHECK(broken(f.region, state) == "pass state: texture units sample depth targets");
    state.textures[0] = depth;
    CHECK(broken(f.region, state) == "drawn");
    state = {};
    state.color = {color, f.region.make(Format::rgba8)};
    state.blend[0].logic_op = state.blend[1].logic_op = state.blend[2].logic_op = LogicOp::invert;
    CHECK(broken(f.region, state) == "drawn");
    state.blend[1].logic_op.reset();
    CHECK(broken(f.region, state) == "pass state: targets of one pass have one logical operation");
}

TEST_CASE("a region's image is ordered by pixel then sample then channel for any format and number of samples") {
    for (const Format format :
         {Format::rgba8, Format::rgba16f, Format::r16f, Format::rg32f, Format::rgba32f, Format::r32f})
        for (const int samples : {1, 4}) {
            Fixture f;
            const Target target = f.region.make(format, samples);
            for (int s = 0; s < samples; ++s) {
                PassState state;
                state.color[0] = target;
                state.sample_mask = static_cast<std::uint8_t>(1u << s);
                static_cast<void>(f.region.full_screen(state, [s](const FragmentBatch& in, const Loads&, Outputs& out) {
                    for (std::size_t c = 0; c < 4; ++c)
                        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                            out.color[0][c][i] =
                                static_cast<float>(in.pixel[i] * 4 + c) / 255.0f + static_cast<float>(s) / 4;
                }));
            }
            const Image image = f.region.targets().image(target);
            const auto channels = static_cast<std::size_t>(info(format).channels);
            std::size_t at = 0, wrong = 0;
            for (std::size_t p = 0; p < 32; ++p)
                for (int s = 0; s < samples; ++s)
                    for (std::size_t c = 0; c < channels; ++c, ++at)
                        wrong += image.codes[at] != f.region.storage(target).code(p, static_cast<int>(c), s) ? 1 : 0;
            INFO("format " << static_cast<int>(format) << ", " << samples << " samples");
            CHECK(at == image.codes.size());
            CHECK(wrong == 0);
            CHECK(image.codes[at - 1] != image.codes[0]);
        }
}

TEST_CASE(
    "an observer gets the events that it requests and an alteration without a function leaves that step unchanged") {
    TestFrame test{few_fragments(), "geforce8"};
    const Body body = [](Region& region) {
        const Target depth = region.make_depth(), copy = region.make_color();
        region.set_name(depth, "depth");
        region.copy(region.opaque_color(), copy);
        PassState state;
        state.depth = nearest_stays;
        state.depth_target = depth;
        region.clear(depth, {.depth = 1.0f});
        state.color[0] = copy;
        const DrawCounts drawn = region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                out.side[i] = Side::front;
                out.key[i] = in.code[i];
            }
            out.traced = true;
        });
        static_cast<void>(region.any(drawn.passed, Idle::no));
        region.publish(copy);
    };
    const auto color = [&](const Instruments& instruments) {
        return run(test.frame, body, Execution::replay, 1, {}, instruments).color;
    };
    const Image plain = color({});
    int steps = 0, names = 0, traces = 0, stages = 0;
    const Observer to_steps{.step = [&](const Region&, const StepEvent&) { ++steps; }};
    const Observer to_names{.named = [&](Target, std::string_view) { ++names; }};
    const Observer to_traces{.traced = [&](const Region&, const TraceEntry&) { ++traces; }};
    const Observer to_stages{.stage = [&](const Region&, const StageEvent&) { ++stages; }};
    for (const Observer* observer : {&to_steps, &to_names, &to_traces, &to_stages})
        CHECK(color({.observer = observer}) == plain);
    CHECK(steps > 3);
    CHECK(names == 1);
    CHECK(traces == 2);  // the second fragment is nearer, so both pass
    CHECK(stages > 3);
    const Alteration of_names{.named = [&](Target, std::string_view) { ++names; }};
    const Alteration of_queries{.query = [](std::uint64_t, bool goes_on) { return goes_on; }};
    CHECK(color({.alteration = &of_names}) == plain);
    CHECK(color({.alteration = &of_queries}) == plain);
    CHECK(names == 2);
}

TEST_CASE("empty tiles with diagnostics run one by one and a second list fills a tile and progress rises to 1") {
    FragmentScene corner{32, 8};
    corner.pixels[0].fragments = {{0.5f, {1, 1, 1, 1}}};
    FragmentScene right{32, 8};
    right.pixels[31].fragments = {{0.5f, {1, 1, 1, 1}}};
    TestFrame test{corner, "geforce8"}, other{right, "geforce8"};
    test.frame.blank_tiles_are_equal = true;
    int bodies = 0;
    const auto count_bodies = [&](bool reports) {
        bodies = 0;
        const Body body = [&](Region& region) {
            ++bodies;
            if (reports) region.report(Fault::count_limit, region.rect().area(), 0, "every pixel");
            region.publish(region.opaque_color());
        };
        std::vector<double> shares;
        const FrameResult result =
            run(test.frame, body, Execution::replay, 1, [&](double share) { shares.push_back(share); });
        CHECK(std::ranges::is_sorted(shares));
        CHECK(shares.back() == 1.0);
        CHECK(shares.size() == 4);  // tiles of 8 x 8
        CHECK((result.diagnostics.empty() ? 0 : result.diagnostics[0].pixels) == (reports ? 32u * 8 : 0u));
        return bodies;
    };
    CHECK(count_bodies(false) == 2);  // the corner tile, and one run for all empty tiles
    CHECK(count_bodies(true) == 4);
    test.frame.second = other.frame.transparent;
    CHECK(count_bodies(false) == 3);
}
