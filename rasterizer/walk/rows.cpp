// rasterizer/walk/rows.cpp - when passes may draw by rows (rows.h), and the exact arithmetic that their kernels fall
// back to.
#include "rasterizer/walk/rows.h"

#include <bit>

#include "rasterizer/base/simd.h"

namespace strata::rasterizer {

namespace {

// Requirements of every walk over rows. Instruction sets from AVX2 on have row_walk_lanes; row tables have
// max_row_pixels columns.
[[nodiscard]] bool can_walk(const Geometry& geometry, const Rect& region) noexcept {
    return chosen_simd() >= Simd::avx2 && geometry.state.depth_order == DepthOrder::less &&
           !geometry.state.window_positions && !geometry.has_other_shapes && !geometry.state.polygon_stipple &&
           geometry.rules.plane_rule == PlaneRule::exact && geometry.rules.coverage == CoverageRule::snapped_edges &&
           geometry.rules.subpixel_bits <= 8 && region.width() <= max_row_pixels;
}

[[nodiscard]] bool has_float_rows(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept {
    const bool clips_fragments = geometry.rules.z_clip == ZClip::per_fragment && !geometry.state.depth_clamp;
    // D16F and D24F have no vector conversion from binary32, nor have codes of a binary32 product.
    const bool has_conversion = depth.format != DepthFormat::d16f && depth.format != DepthFormat::d24f;
    return can_walk(geometry, region) && depth.path == DepthPath::float32 && has_conversion && !clips_fragments &&
           geometry.rules.depth_limits == DepthLimits::clamp &&
           depth_conversion(depth.format, geometry.rules.depth_rounding, 1.0f).kind == code_kind(depth.format);
}

}  // namespace

// Rows evaluate all values where they find coverage.
bool row_walk_suits(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept {
    return geometry.state.interpolation == Interpolation::sample && has_float_rows(geometry, depth, region);
}

bool depth_rows_suit(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept {
    const DepthHypothesis& h = geometry.rules.hypothesis;
    const bool is_chip =
        depth.path == DepthPath::window_z && h.window_z == WindowZRule::chip && h.weights == WeightRule::cut_edges;
    return is_chip ? can_walk(geometry, region) : has_float_rows(geometry, depth, region);
}

DepthDrawn draw_depth_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept {
    return depth.path == DepthPath::window_z ? draw_window_z_rows(geometry, triangles, depth, region, codes)
                                             : draw_float_rows(geometry, triangles, depth, region, codes);
}

void decide_lanes(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index, const std::int32_t* x,
                  const std::int32_t* y, std::uint32_t lanes, float* values) noexcept {
    const TriangleEdges edges = geometry.edges(geometry.triangles[index]);
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = std::countr_zero(lanes);
        const SubpixelPoint centre = pixel_centre(x[i], y[i], geometry.rules.subpixel_bits);
        values[i] = exact_float(plane, edges.at(centre), edges.area());
    }
}

FilterPlane constant_filter(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index) noexcept {
    FilterPlane filter;
    const TriangleEdges edges = geometry.edges(geometry.triangles[index]);
    // Both slopes and the error are 0: every pixel gets this value.
    filter.w0 = constant_float(plane, edges.area());
    return filter;
}

}  // namespace strata::rasterizer
