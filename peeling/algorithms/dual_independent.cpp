// peeling/algorithms/dual_independent.cpp - dual peeling with a blend equation a target: UNDER in front, OVER behind, during the peel.
// Bavoil and Myers 2008, "Blending on the Fly" (DirectX 10.1); algorithms.md 6.
//
// Needs      ARB_draw_buffers_blend (independent blending), RG32F and float MAX blending, three render targets.
// Passes     ceil(N/2) + 2: the last peel finds nothing. No layer is lost on ties.
// Invariant  before a peel, min_max = (-near, far) of what is left, front = what lies before near (alpha = transmittance),
//            back = what lies behind far, over the background. Neither is cleared between passes.
#include <algorithm>
#include <utility>

#include "peeling/algorithms/runs.h"
#include "peeling/programs/min_max.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The targets that the batch has nothing for. min_max was cleared to what is written there. Of codes UNDER and OVER leave (0, 0, 0, 0)
// out; of floats they make 0 of -0 and flush denormals, but only once: what lies between leaves that to the ends of its pixel, where
// it has them.
unsigned neutral_targets(const PeelSides& has, bool stores_codes, bool has_ends) noexcept {
    const bool keeps_colors = stores_codes || (has_ends && !has.near && !has.far);
    return (has.between ? 0u : 1u) | (keeps_colors && !has.near ? 2u : 0u) | (keeps_colors && !has.far ? 4u : 0u);
}

// (0, 0, 0, 0), which is neutral in both blends, where a lane is none of `chosen`; everywhere if none is.
void choose(bool some, const Lanes<std::uint32_t>& chosen, const ColorLanes& from, ColorLanes& to,
            std::size_t count) noexcept {
    for (std::size_t c = 0; c < 4; ++c)
        if (some)
            for (std::size_t i = 0; i < count; ++i) to[c][i] = select(chosen[i], from[c][i], 0.0f);
        else
            std::fill_n(to[c].begin(), count, 0.0f);
}

// Fragments outside the range are discarded; the others write all three targets, a neutral value where they do not
// count.
Drawn peel(Region& region, Target min_max, Target next_min_max, Target front, Target back) {
    region.clear(next_min_max, empty_min_max);
    PassState state;
    state.color = {next_min_max, front, back};
    state.blend = {blend_mode::max, blend_mode::under, blend_mode::over};
    state.blend[2].write_mask = 0x7;
    state.reads = {min_max, region.opaque_depth()};
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.code = false;
    state.needs.reference = !compare.is_plain();
    state.selection = ends_between(compare, min_max, region.opaque_depth(), Outside::discarded);
    state.selection.keys_suffice = compare.is_plain();
    const bool stores_codes = info(region.frame().color_format).type == ChannelType::unorm8;
    const bool has_ends = compare.is_plain();  // wherever something lies between
    const bool is_traced = region.frame().trace;
    return region.draw(state, List::second, [=](const FragmentBatch& in, const Loads& own, Outputs& out) {
        PeelLanes side;
        classify(compare, in, own.color(0), own.depth(1), side);
        write_min_max(in, side.is_between, out.color[0]);
        const PeelSides has{side, lanes(in)};
        if (has.near) premultiply(in.color, out.color[1], lanes(in));
        choose(has.near, side.is_near, out.color[1], out.color[1], lanes(in));
        choose(has.far, side.is_far, in.color, out.color[2], lanes(in));
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.alive[i] &= side.is_near[i] | side.is_far[i] | side.is_between[i];
        out.neutral = neutral_targets(has, stores_codes, has_ends);
        out.traced = is_traced;
        for (std::size_t i = 0; is_traced && i < lanes(in); ++i) {
            const std::uint32_t is_near = side.is_near[i], is_far = side.is_far[i];
            out.side[i] = is_near != 0 ? Side::front : is_far != 0 ? Side::back : Side::none;
            out.key[i] = ordered_code(in.shader_z[i]);
        }
    });
}

}  // namespace

void dual_independent(Region& region) {
    Target min_max = region.make(Format::rg32f), next_min_max = region.make(Format::rg32f);
    const Target front = region.make_color(), back = region.make_color();
    region.call(min_max, "min_max");
    region.call(next_min_max, "min_max");
    region.call(front, "front");
    region.call(back, "back");
    DualLayers layers{region};
    region.clear(front, {.color = {0, 0, 0, 1}});
    region.copy(region.opaque_color(), back);
    initialize(region, min_max);
    while (!region.limit_reached()) {
        region.begin_iteration();
        const Drawn drawn = peel(region, min_max, next_min_max, front, back);
        layers.keep(min_max);
        std::swap(min_max, next_min_max);
        if (!region.any(drawn.passed, Idle::yes)) break;
    }
    layers.end();
    publish_over_background(region, front, back);
}

}  // namespace strata::peeling
