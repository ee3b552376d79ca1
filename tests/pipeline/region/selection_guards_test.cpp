// Tests a pass that selects fragments, and the same pass with one setting changed, for which the selection no longer
// applies or applies to other stages. The reference is literal execution, which visits every fragment.
#include <catch2/catch.hpp>

#include "pipeline/frame/selection.h"
#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/changed_states.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr StencilFace routes{.func = CompareFunc::equal,
                             .ref = 2,
                             .fail = StencilOp::decr,
                             .depth_fail = StencilOp::decr,
                             .pass = StencilOp::decr};

// Up to seven layers per pixel in random order, with ties, and an opaque surface at every fifth pixel.
const FragmentScene& layered_scene() {
    static const FragmentScene scene = [] {
        FragmentScene made{16, 16};
        Random random{2051};
        for (std::size_t p = 0; p < made.pixels.size(); ++p) {
            for (int i = random_int(random, 0, 7); i-- > 0;) {
                const auto depth = static_cast<float>(random_int(random, 0, 15)) / 16.0f;
                Rgba color = random_color(random);
                color[3] = static_cast<float>(random_int(random, 0, 4)) / 4.0f;
                made.pixels[p].fragments.push_back({depth, color});
            }
            if (p % 5 == 0) made.pixels[p].opaque = GivenFragment{0.625f, {0, 1, 0, 1}};
        }
        return made;
    }();
    return scene;
}

// Every third triangle is reversed, so that both faces of a stencil test get fragments.
DrawList layered_list() {
    DrawList list = draw_list(layered_scene());
    std::vector<std::uint32_t>& indices = list.meshes[0].indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 9) std::swap(indices[i + 1], indices[i + 2]);
    return list;
}

// A kind of pass: its input targets and its state.
struct Stage {
    KeptFragments keeps;
    int samples = 1;
    const StencilFace* face = nullptr;
    DepthTest depth{};
    Blend blend{};
    Format color = Format::rgba32f;
    std::uint32_t least = 0;  // least key of the window
    Outside outside = Outside::dies;
    bool writes_registers = false;
};

constexpr DepthTest any_stays{.enabled = true, .func = CompareFunc::always, .write = true};

const std::vector<Stage> stages{
    {.keeps = KeptFragments::nearest, .depth = nearest_stays},
    {.keeps = KeptFragments::interval, .blend = blend_mode::over, .least = 0x3f400000},
    {.keeps = KeptFragments::interval, .face = &counts_updates, .depth = nearest_stays, .least = 0x3f400000},
    {.keeps = KeptFragments::submitted, .samples = 4, .face = &routes, .depth = any_stays},
    {.keeps = KeptFragments::ends, .blend = blend_mode::max, .color = Format::rg32f, .outside = Outside::writes_alike},
    {.keeps = KeptFragments::interval,
     .blend = blend_mode::under,
     .least = 0x3f400000,
     .outside = Outside::writes_alike,
     .writes_registers = true},
};

// The program of every stage; it keeps keys from `least` on, before the opaque surface. With MAX of (-z, z) and with
// registers, fragments outside write values that change nothing.
struct StageProgram {
    const Stage& stage;
    DepthKey key;
    void operator()(const FragmentBatch& in, const Loads& loads, Outputs& out) const {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const bool is_inside = key == DepthKey::shader_z
                                       ? in.shader_z[i] < std::bit_cast<float>(loads.depth(0)[i])
                                       : in.code[i] >= stage.least && in.code[i] < loads.depth(0)[i];
            for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = 0.5f;
            if (stage.keeps == KeptFragments::ends) {
                out.color[0][0][i] = is_inside ? -in.shader_z[i] : -1.0f;
                out.color[0][1][i] = is_inside ? in.shader_z[i] : -1.0f;
                continue;
            }
            if (!is_inside && !stage.writes_registers) out.discard(static_cast<int>(i));
            for (std::size_t c = 0; c < 4; ++c) out.color[0][c][i] = stage.writes_registers ? 0.0f : in.color[c][i];
        }
    }
};

// Draws the stage with `change` applied to its state.
void draw_stage(Region& region, const Stage& stage, const Changed& change) {
    const auto depth_target = [&] {
        const Target made = region.make(target_format(region.frame().key_request().format), stage.samples);
        if (stage.samples == 1)
            region.copy(region.opaque_depth(), made);
        else
            region.clear(made, {.depth = 1.0f});
        return made;
    };
    PassState state;
    state.reads[0] = region.opaque_depth();
    state.selection = {.keeps = stage.keeps,
                       .outside = stage.outside,
                       .far = {KeyBound::beyond(region.opaque_depth())},
                       .least = stage.least};
    state.depth = stage.depth;
    if (stage.depth.enabled) state.depth_target = depth_target();
    if (stage.face != nullptr) {
        state.stencil = {.enabled = true, .front = *stage.face, .back = {}};
        state.stencil_target = region.make(Format::s8, stage.samples);
        region.clear(state.stencil_target, {.stencil = 0});
        for (int s = 0; stage.keeps == KeptFragments::submitted && s < stage.samples; ++s)
            region.clear(state.stencil_target, {.stencil = static_cast<std::uint8_t>(s + 2)},
                         static_cast<std::uint8_t>(1u << s));
    }
    const StageProgram program{stage, region.frame().key};
    state.color[0] = region.make(stage.color, stage.samples);
    state.blend[0] = stage.blend;
    if (stage.blend.enabled) region.clear(state.color[0], {.color = {-1, -1, -1, 1}});
    if (stage.writes_registers) {
        state.color[1] = region.make(Format::rgba32f);
        region.clear(state.color[1], {.color = {0.5f, 0.5f, 0.5f, 0.5f}});
        state.ordered_rmw = true;
    }
    change(state, region);
    static_cast<void>(region.draw(state, program));
    region.publish(region.opaque_color());
}

struct Ways {
    RunResult literal, tiled;
};

Ways both_ways(const Stage& stage, const Changed& change, const std::function<void(Frame&)>& reframe = {},
               const Instruments& instruments = {}) {
    const FragmentScene& scene = layered_scene();
    TestFrame test{layered_list(), {}, scene.width, scene.height, "ideal"};
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    if (reframe) reframe(test.frame);
    const Body body = [&](Region& region) { draw_stage(region, stage, change); };
    return {run_one_way(test.frame, body, Execution::literal, instruments),
            run_one_way(test.frame, body, Execution::replay, instruments)};
}

}  // namespace

TEST_CASE("a pass that selects gives the same result as one that visits every fragment for any changed state",
          "[slow]") {
    for (std::size_t number = 0; number < stages.size(); ++number)
        for (const Change& change : changes()) {
            const Ways ways = both_ways(stages[number], change.make);
            INFO("stage " << number << ", changed: " << change.name);
            CHECK(difference_of(ways.literal, ways.tiled).empty());
        }
}

TEST_CASE("a selection is used where nothing is changed and not where its tests differ") {
    for (std::size_t number = 0; number < stages.size(); ++number) {
        const Ways ways = both_ways(stages[number], changes().front().make);
        INFO("stage " << number);
        CHECK(ways.tiled.visited < ways.literal.visited);
        const Ways changed = both_ways(stages[number], [](PassState& s, Region&) { s.replaces_depth = true; });
        CHECK(changed.tiled.visited > ways.tiled.visited);
    }
}

TEST_CASE("fragments behind a surface of the pass's own are omitted with the same result as visiting every fragment") {
    const Changed own_surface = [](PassState& state, Region& region) {
        const Target surface = region.make_depth();
        region.clear(surface, {.depth = 0.5f});
        state.reads[0] = surface;
        state.selection.far[0] = KeyBound::beyond(surface);
    };
    for (std::size_t number = 0; number < stages.size(); ++number) {
        const Ways ways = both_ways(stages[number], own_surface);
        INFO("stage " << number);
        CHECK(difference_of(ways.literal, ways.tiled).empty());
    }
}

TEST_CASE("frames without memory or with every effect or with another key select no wrong fragment", "[slow]") {
    const std::vector<std::function<void(Frame&)>> frames{
        [](Frame& f) { f.replay.bytes = 0; },          [](Frame& f) { f.replay.bytes = 512; },
        [](Frame& f) { f.replay.bytes = 12'000; },     [](Frame& f) { f.effects = Effects::all; },
        [](Frame& f) { f.key = DepthKey::shader_z; },  [](Frame& f) { f.second = f.transparent; },
        [](Frame& f) { f.replay.needs.color = false; }};
    for (std::size_t number = 0; number < stages.size(); ++number)
        for (std::size_t frame = 0; frame < frames.size(); ++frame) {
            const Ways ways = both_ways(
                stages[number], [](PassState&, Region&) {}, frames[frame]);
            INFO("stage " << number << ", frame " << frame);
            CHECK(difference_of(ways.literal, ways.tiled).empty());
        }
}

TEST_CASE("instruments that measure and check a pass do not change its result", "[slow]") {
    std::vector<Instruments> all{{.log_passes = true}, {.check_selections = true}};
    for (const Effect effect :
         {Effect::color, Effect::texcoord, Effect::shader_z, Effect::code, Effect::facing, Effect::loads,
          Effect::alpha_test, Effect::stencil_test, Effect::depth_test, Effect::blending})
        all.push_back({.once_more = effect});
    for (std::size_t number = 0; number < stages.size(); ++number) {
        const RunResult plain = both_ways(stages[number], [](PassState&, Region&) {}).literal;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const Ways ways = both_ways(
                stages[number], [](PassState&, Region&) {}, {}, all[k]);
            INFO("stage " << number << ", instrument " << k);
            CHECK(difference_of(plain, ways.literal).empty());
            CHECK(difference_of(plain, ways.tiled).empty());
        }
    }
}
