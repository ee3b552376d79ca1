// rasterizer/values/depth/depth_scale.cpp - the units and limits of a draw's depths (depth_scale.h).
#include "rasterizer/values/depth/depth_scale.h"

#include <cassert>

#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {

namespace {

// Fixed point: NV2A truncates, whatever the rounding rule, and clamps to the codes of the depth range.
[[nodiscard]] ChipConversion chip_conversion(const DepthScale& scale) noexcept {
    const DepthConversion<float>& to = scale.to_code;
    if (!to.is_fixed()) return {to.kind, scale.value_to_code.least, scale.value_to_code.greatest};
    return {CodeKind::fixed, static_cast<double>(depth_code(to.least, to)),
            static_cast<double>(depth_code(to.greatest, to))};
}

[[nodiscard]] ChipDepth chip_depth(const DepthScale& scale, const RasterState& state,
                                   const RasterRules& rules) noexcept {
    return {chip_conversion(scale),
            rules.offset_rule == OffsetRule::fragments ? state.polygon_offset : PolygonOffset{},
            scale.value_to_code.least,
            scale.value_to_code.greatest,
            scale.to_code.least * scale.z_units,
            scale.to_code.greatest * scale.z_units,
            rules.z_clip == ZClip::per_fragment && !state.depth_clamp};
}

}  // namespace

DepthScale depth_scale(const Geometry& geometry, const DepthRequest& depth) noexcept {
    const RasterState& state = geometry.state;
    const RasterRules& rules = geometry.rules;
    const float near = state.depth_near, far = state.depth_far;
    const double code_units = buffer_units(depth.format);
    DepthScale scale{depth.format,
                     z_units(state, rules),
                     code_units,
                     depth_conversion(depth.format, rules.depth_rounding, 1.0f, near, far),
                     depth_conversion(depth.format, rules.depth_rounding, code_units, near, far),
                     {}};
    scale.chip = chip_depth(scale, state, rules);
    const bool is_float = depth.format == DepthFormat::d32f, is_reversed = state.depth_order == DepthOrder::greater;
    [[maybe_unused]] const bool is_fixed = depth.format == DepthFormat::d16 || depth.format == DepthFormat::d24;
    assert((!is_reversed || is_float || is_fixed) && "reversed depth has keys for codes of d16, d24 and d32f");
    const bool may_have_limits = depth.path == DepthPath::float32 && !is_reversed && !state.depth_clamp &&
                                 (scale.to_code.is_fixed() || is_float);
    if (!may_have_limits) return scale;
    if (rules.depth_limits == DepthLimits::wrap) scale.to_code.wraps = true;
    if (rules.depth_limits == DepthLimits::zero_to_one && !scale.chip.clips)
        scale.to_code = depth_conversion(depth.format, rules.depth_rounding, 1.0f);
    return scale;
}

}  // namespace strata::rasterizer
