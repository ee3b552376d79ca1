// rasterizer/values/depth/path_depth.cpp - the functions of each depth path but NV2A's, and their selection.
#include "rasterizer/values/depth/path_depth.h"

#include <algorithm>

#include "rasterizer/values/depth/code_lanes.h"
#include "rasterizer/values/depth/program_depth.h"
#include "rasterizer/values/depth_paths.h"

namespace strata::rasterizer {
namespace {

// From the units of vertex z to those of the buffer.
void to_buffer_units(const DepthScale& scale, int count, double* values) noexcept {
    if (scale.z_units == scale.code_units) return;
    for (int i = 0; i < count; ++i) values[i] = values[i] * scale.code_units / scale.z_units;
}

int shader_z_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    for (int i = 0; i < in.lanes.count; ++i) out[i] = double{in.shader_z[i]} * c.scale.code_units;
    return 0;
}

int shader_z_codes(const DepthConstants& c, const DepthInput& in, std::uint32_t* out) noexcept {
    to_codes(in.shader_z, padded(in.lanes.count), c.scale.to_code, out);
    return 0;
}

int float32_plane_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    float32_plane_depth(in.corners, in.triangle.geometry.rules, in.lanes, out);
    to_buffer_units(c.scale, in.lanes.count, out);
    return 0;
}

int rounded_plane_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    const int fallbacks = rounded_plane_depth(in.corners, in.lanes, out);
    to_buffer_units(c.scale, in.lanes.count, out);
    return fallbacks;
}

int plane_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    plane_depth(in.corners, in.lanes, out);
    to_buffer_units(c.scale, in.lanes.count, out);
    return 0;
}

// v = 1 + w as a perspective attribute.
int logarithmic_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    const Geometry& geometry = in.triangle.geometry;
    std::array<float, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = 1.0f + in.corners.w[i];
    Lanes<float> interpolated;
    const int fallbacks =
        interpolate(v, in.corners.inverse_w, in.lanes, geometry.rules.hypothesis, interpolated.data());
    for (int i = 0; i < in.lanes.count; ++i)
        out[i] = double{logarithmic_depth(interpolated[static_cast<std::size_t>(i)], geometry.state.log_scale)} *
                 c.scale.code_units;
    return fallbacks;
}

int packed_values(const DepthConstants& c, const DepthInput& in, double* out) noexcept {
    for (int i = 0; i < in.lanes.count; ++i)
        out[i] = double{unpack_depth(pack_depth(in.shader_z[i]))} * c.scale.code_units;
    return 0;
}

// The exact plane in the buffer's own units, rounded once to binary32 and then truncated: NV2A's float formats.
int rounded_codes(const DepthScale& scale, const DepthInput& in, std::uint32_t* out) noexcept {
    const bool in_units = scale.z_units == scale.code_units;
    alignas(64) Lanes<float> z;
    const RationalPlane plane{in.corners.z, in_units ? 1.0 : scale.code_units, in_units ? 1.0 : scale.z_units};
    const int fallbacks = round_plane(plane, in.lanes, z.data());
    for (int i = 0; i < in.lanes.count; ++i)
        out[i] = depth_code(double{z[static_cast<std::size_t>(i)]}, scale.value_to_code);
    return fallbacks;
}

int fixed_codes(const DepthScale& scale, const DepthInput& in, std::uint32_t* out) noexcept {
    const std::uint32_t max = max_code(scale.format);
    const bool in_codes = scale.z_units == max;
    const RationalPlane plane{in.corners.z, in_codes ? 1.0 : max, in_codes ? 1.0 : scale.z_units};
    // The exact plane has no binary32 product: it rounds once, for product_even too, with a half rounded up.
    const double half = truncates(in.triangle.geometry.rules.depth_rounding) ? 0.0 : 0.5;
    const int fallbacks = round_plane(plane, in.lanes, CodeRounding{half, max}, out);
    const DepthConversion<float>& to = scale.to_code;
    const std::uint32_t least = depth_code(to.least, to), greatest = depth_code(to.greatest, to);
    for (int i = 0; i < padded(in.lanes.count); ++i) out[i] = std::clamp(out[i], least, greatest);
    return fallbacks;
}

}  // namespace

int exact_codes(const DepthConstants& c, const DepthInput& in, std::uint32_t* out) noexcept {
    const DepthScale& scale = c.scale;
    if (scale.to_code.is_fixed()) return fixed_codes(scale, in, out);
    if (scale.to_code.kind != CodeKind::binary32) return rounded_codes(scale, in, out);
    DepthConversion<float> in_range = scale.to_code;
    in_range.wraps = false;  // an audit sorts by exact codes, so they must not wrap
    to_codes(in.shader_z, padded(in.lanes.count), in_range, out);
    return 0;
}

int quotient_values(const DepthConstants& c, const DrawnTriangle& triangle, const TriangleLanes& lanes,
                    double* out) noexcept {
    const QuotientCorners corners = quotient_corners(triangle.geometry, triangle.record);
    const int fallbacks = quotient_depth(corners, lanes, triangle.geometry.rules.hypothesis, c.kernels, out);
    to_buffer_units(c.scale, lanes.count, out);
    return fallbacks;
}

PathDepth select_path(DepthPath path, const DepthHypothesis& hypothesis) noexcept {
    constexpr auto quotient = [](const DepthConstants& c, const DepthInput& in, double* out) {
        return quotient_values(c, in.triangle, in.lanes, out);
    };
    constexpr PathDepth exact{plane_values, exact_codes};
    switch (path) {
        case DepthPath::float32: return {shader_z_values, shader_z_codes};
        case DepthPath::float32_plane: return {float32_plane_values, nullptr};
        case DepthPath::perspective_rq:
        case DepthPath::depth_replace: return {quotient, nullptr};
        case DepthPath::w_buffer: return {w_buffer_values, w_buffer_codes};
        case DepthPath::exact: return exact;
        case DepthPath::logarithmic: return {logarithmic_values, nullptr};
        case DepthPath::packed_rgba8: return {packed_values, nullptr};
        case DepthPath::window_z: break;
    }
    switch (hypothesis.window_z) {
        case WindowZRule::chip: return {chip_window_z_values, chip_window_z_codes};
        case WindowZRule::float32: return {rounded_plane_values, nullptr};
        case WindowZRule::exact: break;
    }
    return exact;
}

}  // namespace strata::rasterizer
