// pipeline/region/region_layer.cpp - quads over saved layers: blended from word to word, where a tile's pass is nothing but that
// (execution.md 6). Literal execution never takes this way: the program of the pass is what it is tested against.
#include <algorithm>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/stages/layer_blend.h"

namespace strata::pipeline {

namespace {

// Nothing but UNDER or OVER into one target, of all channels or of the colours.
bool only_blends(const PassState& state) {
    Blend blend = state.blend[0];
    const bool is_whole = blend.write_mask == 0xf || blend.write_mask == 0x7;
    blend.write_mask = blend_mode::over.write_mask;
    const bool is_tested =
        state.alpha.enabled || state.stencil.enabled || state.depth.enabled || state.depth_unit_count > 0;
    return (blend == blend_mode::under || blend == blend_mode::over) && is_whole && !is_tested && !state.ordered_rmw &&
           std::ranges::count_if(state.color, &Target::exists) == 1;
}

LayerOrder order_of(const PassState& state) {
    return state.blend[0].color == blend_mode::under.color ? LayerOrder::under : LayerOrder::over;
}

}  // namespace

bool Region::is_saved_layer(const PassState& state) const {
    if (!state.layer.color.exists() || extent_ != Extent::tile || frame_.effects != Effects::needed ||
        instruments_.once_more != Effect::none || pass_samples_ != 1 || !only_blends(state))
        return false;
    const TargetStorage &layer = storage(state.layer.color), &to = storage(state.color[0]);
    return layer.format() == to.format() && layer.samples() == 1 && info(to.format()).channels == 4 &&
           !is_narrow(to.format());
}

Drawn Region::blend_layer(const PassState& state) {
    const auto& [color, depth_target, surface_target] = state.layer;
    const Word *const depth = codes_of(depth_target), *const surface = codes_of(surface_target);
    const std::size_t area = rect_.area();
    const LayerOrder order = order_of(state);
    pipeline::blend_layer({.layer = storage(color).texels(0),
                           .to = at(state.color[0]).texels(0),
                           .depth = depth,
                           .surface = surface,
                           .pixels = area,
                           .order = order,
                           .keeps_alpha = state.blend[0].write_mask != 0xf,
                           .rules = color_rules(profile(), at(state.color[0]).format())});
    const Side side = order == LayerOrder::under ? Side::front : Side::back;
    for (std::uint32_t p = 0; frame_.trace && books_.counts && p < area; ++p)
        if (depth[p] != surface[p]) trace({p, depth[p], 0, side, false});
    Drawn drawn;
    drawn.passed.own_ = area;
    return drawn;
}

}  // namespace strata::pipeline
