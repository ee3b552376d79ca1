// rasterizer/values/depth/chip_depth.cpp - depths that NV2A computes itself, window_z and w_buffer (path_depth.h).
#include <algorithm>

#include "rasterizer/chip/w_buffer.h"
#include "rasterizer/chip/window_z.h"
#include "rasterizer/set_up/polygon_offset.h"
#include "rasterizer/values/chip_lanes.h"
#include "rasterizer/values/depth/code_lanes.h"
#include "rasterizer/values/depth/path_depth.h"

namespace strata::rasterizer {
namespace {

template <class Rule>
void fill_by(const Rule& rule, const TriangleLanes& lanes, double* out) noexcept {
    for (int i = 0; i < lanes.count; ++i) out[i] = rule.value(lanes.edge_values(i));
}

[[nodiscard]] PolygonOffset offset_of(const DepthConstants& c, const DepthInput& in) noexcept {
    return in.triangle.record.takes_offset() ? c.scale.chip.offset : PolygonOffset{};
}

// The intersection of viewport and scissor.
[[nodiscard]] Rect drawn_rect(const RasterState& state) noexcept {
    return state.scissor ? intersection(state.viewport, *state.scissor) : state.viewport;
}

void codes_of_values(const DepthScale& scale, const double* value, int count, std::uint32_t* out) noexcept {
    if (!scale.to_code.is_fixed()) return to_codes(value, count, scale.value_to_code, out);
    const ChipConversion& to = scale.chip.to_code;
    for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint32_t>(std::clamp(value[i], to.least, to.greatest));
}

}  // namespace

int chip_window_z_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    const RasterRules& rules = in.triangle.geometry.rules;
    const PolygonOffset offset = offset_of(c, in);
    const SetupTriangle& t = in.corners;
    const std::int64_t area = in.lanes.edges->area();
    if (offset.enabled) {
        const double slope = largest_slope(t.p, t.given_z, rules.subpixel_bits);
        fill_by(WindowZ24{t.given_z, area, rules.hypothesis, chip_offset(slope, offset)}, in.lanes, out);
    } else {
        fill_by(WindowZ24{t.z, area, rules.hypothesis}, in.lanes, out);
    }
    return 0;
}

int w_buffer_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    const Geometry& geometry = in.triangle.geometry;
    const PolygonOffset offset = offset_of(c, in);
    const std::array<float, 3> w = scaled_w(in.corners, geometry.state.w_scale);
    const bool has_slope = offset.enabled && offset.factor != 0.0f;
    const double slope = has_slope ? w_slope(in.corners, w, drawn_rect(geometry.state), geometry.rules) : 0.0;
    fill_by(WBuffer{w, geometry.rules.hypothesis, chip_offset(slope, offset)}, in.lanes, out);
    return 0;
}

bool chip_window_z_by_kernel(const DepthConstants& c, const DrawnTriangle& triangle, const std::uint16_t* x,
                             const std::uint16_t* y, int count, std::uint32_t* out) noexcept {
    const DepthHypothesis& h = triangle.geometry.rules.hypothesis;
    if (c.chip_kernels == nullptr || !ChipTriangle::suits(triangle.weights, triangle.record, h)) return false;
    const NarrowWindowZ z{window_z_corners(triangle.geometry, triangle.index, c.scale.chip.offset), h};
    if (!z.is_narrow) return false;
    c.chip_kernels->window_z({triangle.weights, h}, z, x, y, count, c.scale.chip.to_code, out);
    return true;
}

int chip_window_z_codes(const DepthConstants& c, const DepthInput& in, std::uint32_t* out) noexcept {
    if (chip_window_z_by_kernel(c, in.triangle, in.lanes.x, in.lanes.y, in.lanes.count, out)) return 0;
    Lanes<double> value;
    static_cast<void>(chip_window_z_values(c, in, value.data()));
    codes_of_values(c.scale, value.data(), in.lanes.count, out);
    return 0;
}

int w_buffer_codes(const DepthConstants& c, const DepthInput& in, std::uint32_t* out) noexcept {
    Lanes<double> value;
    static_cast<void>(w_buffer_values(c, in, value.data()));
    codes_of_values(c.scale, value.data(), in.lanes.count, out);
    return 0;
}

}  // namespace strata::rasterizer
