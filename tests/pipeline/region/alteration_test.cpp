// Tests alterations of passes on small cases with a few fragments per pixel, MAX and replacement, whose results with
// and without the change are worked out by hand.
#include "pipeline/frame/alteration.h"

#include <catch2/catch.hpp>

#include "pipeline/region/region_shortcuts.h"
#include "tests/pipeline/frames.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

// Pixel p has one fragment of red p / 8, depth 1/2.
FragmentScene ramp_of_reds() {
    FragmentScene scene{8, 1};
    for (int p = 0; p < 8; ++p)
        scene.pixels[static_cast<std::size_t>(p)].fragments.push_back({0.5f, {static_cast<float>(p) / 8, 0, 0, 1}});
    return scene;
}

struct AlteredMachine {
    TestFrame test;
    strata::pipeline::RegionStatistics statistics;
    Region region;
    explicit AlteredMachine(const Alteration& alteration)
        : test{ramp_of_reds(), "geforce8"},
          region{test.frame, {test.frame.rect()}, statistics, {.alteration = &alteration}} {}
};

// Clears a float target to red 1/4 and draws the ramp over it.
std::vector<float> reds_after_pass(const Alteration& alteration, bool by_quad = false) {
    AlteredMachine m{alteration};
    const Target target = m.region.make(Format::rgba32f);
    m.region.set_name(target, "target");
    m.region.clear(target, {.color = {0.25f, 0, 0, 0}});
    PassState state;
    state.color[0] = target;
    const auto program = [by_quad](const FragmentBatch& in, const Loads&, Outputs& out) {
        if (by_quad)
            for (auto& channel : out.color[0]) channel.fill(0.75f);
        else
            out.color[0] = in.color;
    };
    if (by_quad)
        static_cast<void>(m.region.full_screen(state, program));
    else
        static_cast<void>(m.region.draw(state, program));
    std::vector<float> reds;
    for (std::uint32_t p = 0; p < 8; ++p) reds.push_back(m.region.targets().color(target, p)[0]);
    return reds;
}

const std::vector<float> unaltered_reds{0, 0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f, 0.875f};

}  // namespace

TEST_CASE("an alteration without functions changes no step") {
    CHECK(reds_after_pass({}) == unaltered_reds);
    CHECK(reds_after_pass({}, true) == std::vector<float>(8, 0.75f));
}

TEST_CASE("a pass uses the state that its alteration returns for geometry and quads") {
    int geometry = 0, quads = 0;
    const Alteration changed{.pass = [&](Region&, PassState& state, PassKind kind) {
        ++(kind == PassKind::geometry ? geometry : quads);
        state.blend[0] = blend_mode::max;
    }};
    CHECK(reds_after_pass(changed) == std::vector<float>{0.25f, 0.25f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f, 0.875f});
    CHECK(reds_after_pass(changed, true) == std::vector<float>(8, 0.75f));
    CHECK(geometry == 1);
    CHECK(quads == 1);
}

TEST_CASE("an alteration gets the number of fragments that passed in each pass") {
    std::vector<std::pair<PassKind, std::uint64_t>> heard;
    const Alteration listens{.program =
                                 [](const ProgramCall& call, const std::function<void()>& run) {
                                     run();
                                     for (std::size_t i = 0; i < static_cast<std::size_t>(call.in.count); ++i)
                                         if (call.out.color[0][0][i] > 0.5f) call.out.discard(static_cast<int>(i));
                                 },
                             .drawn = [&](PassKind kind, std::uint64_t passed) { heard.emplace_back(kind, passed); }};
    static_cast<void>(reds_after_pass(listens));
    static_cast<void>(reds_after_pass(listens, true));
    // Five of the eight reds are at most 1/2; a quad of 3/4 is discarded everywhere.
    CHECK(heard ==
          std::vector<std::pair<PassKind, std::uint64_t>>{{PassKind::geometry, 5}, {PassKind::full_screen, 0}});
}

TEST_CASE("an alteration can replace a program or run code around it") {
    const Alteration behind{.program = [](const ProgramCall& call, const std::function<void()>& run) {
        run();
        for (std::size_t i = 0; i < static_cast<std::size_t>(call.in.count); ++i)
            if (call.out.color[0][0][i] > 0.5f) call.out.discard(static_cast<int>(i));
    }};
    CHECK(reds_after_pass(behind) == std::vector<float>{0, 0.125f, 0.25f, 0.375f, 0.5f, 0.25f, 0.25f, 0.25f});
    const Alteration unused{.program = [](const ProgramCall& call, const std::function<void()>&) {
        for (auto& channel : call.out.color[0]) channel.fill(0.0625f);
    }};
    CHECK(reds_after_pass(unused) == std::vector<float>(8, 0.0625f));
}

TEST_CASE("a clear and a copy may be changed or redirected or skipped") {
    for (const bool is_left_out : {false, true}) {
        const Alteration changed{.clear =
                                     [&](Region&, Target&, ClearValue& value) {
                                         value.color[0] *= 2;
                                         return !is_left_out;
                                     },
                                 .copy = [&](Region&, Target&, Target&) { return !is_left_out; }};
        AlteredMachine m{changed};
        const Target from = m.region.make(Format::r32f), to = m.region.make(Format::r32f);
        m.region.clear(from, {.color = {0.25f, 0, 0, 0}});
        m.region.copy(from, to);
        CHECK(m.region.targets().color(from, 3)[0] == (is_left_out ? 0.0f : 0.5f));
        CHECK(m.region.targets().color(to, 3)[0] == (is_left_out ? 0.0f : 0.5f));
    }
    const Alteration turned{.clear = [](Region&, Target& target, ClearValue&) {
        target = {target.id + 1};
        return true;
    }};
    AlteredMachine m{turned};
    const Target asked = m.region.make(Format::r32f), hit = m.region.make(Format::r32f);
    m.region.clear(asked, {.color = {1, 0, 0, 0}});
    CHECK(m.region.targets().color(asked, 0)[0] == 0.0f);
    CHECK(m.region.targets().color(hit, 0)[0] == 1.0f);
}

TEST_CASE("an alteration answers queries and receives names and sees nothing of the emulator's internal work") {
    std::uint64_t asked = 0;
    std::string names;
    int clears = 0;
    const Alteration stubborn{.named = [&](Target, std::string_view name) { names += name; },
                              .clear =
                                  [&](Region&, Target&, ClearValue&) {
                                      ++clears;
                                      return true;
                                  },
                              .query =
                                  [&](std::uint64_t count, bool) {
                                      asked = count;
                                      return false;
                                  }};
    AlteredMachine m{stubborn};
    CHECK(clears == 0);  // the opaque targets were cleared before
    const Target target = m.region.make_color();
    m.region.set_name(target, "layer");
    RegionShortcuts{m.region}.uncounted([&] { m.region.clear(target, {}); });
    CHECK(clears == 0);
    PassState state;
    state.color[0] = target;
    m.region.begin_iteration();
    const DrawCounts drawn =
        m.region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; });
    CHECK_FALSE(m.region.any(drawn.passed, Idle::no));
    CHECK(asked == 8);
    CHECK(names == "layer");
}

TEST_CASE("an altered run is literal for any requested execution") {
    TestFrame test{ramp_of_reds(), "geforce8"};
    int regions = 0, copies = 0;
    const Body body = [&](Region& region) {
        ++regions;
        const Target target = region.make_color();
        region.copy(region.opaque_color(), target);
        region.publish(target);
    };
    const Alteration counting{.copy = [&](Region&, Target&, Target&) {
        ++copies;
        return true;
    }};
    static_cast<void>(run(test.frame, body, Execution::replay, 2, {}, {.alteration = &counting}));
    CHECK(regions == 1);
    CHECK(copies == 1);
}
