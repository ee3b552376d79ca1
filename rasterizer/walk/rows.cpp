#include "rasterizer/walk/rows.h"

#include <bit>

#include "rasterizer/base/simd.h"

namespace strata::rasterizer {

bool row_walk_suits(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept {
    const bool clips_fragments = geometry.rules.z_clip == ZClip::per_fragment && !geometry.state.depth_clamp;
    // Of the sets, those with fewer than four lanes of binary64 are faster with batches. D16F has no vector
    // conversion, and row tables hold max_row_pixels columns.
    return chosen_simd() >= Simd::avx2 && depth.path == DepthPath::float32 && depth.format != DepthFormat::d16f &&
           (depth.format == DepthFormat::d32f || geometry.rules.depth_rounding != DepthRounding::product_even) &&
           !clips_fragments && geometry.state.depth_order == DepthOrder::less &&
           geometry.rules.plane_rule == PlaneRule::exact && geometry.rules.coverage == CoverageRule::snapped_edges &&
           geometry.rules.subpixel_bits <= 8 && region.width() <= max_row_pixels;
}

void decide_lanes(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index, const std::int32_t* x,
                  const std::int32_t* y, std::uint32_t lanes, float* values) noexcept {
    const TriangleEdges edges{geometry.points(geometry.triangles[index]), geometry.rules.tie_rule};
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = std::countr_zero(lanes);
        const SubpixelPoint centre = pixel_centre(x[i], y[i], geometry.rules.subpixel_bits);
        values[i] = exact_float(plane, edges.at(centre), edges.area());
    }
}

FilterPlane constant_filter(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index) noexcept {
    FilterPlane filter;
    const TriangleEdges edges{geometry.points(geometry.triangles[index]), geometry.rules.tie_rule};
    // Both slopes and the error are 0: every pixel gets this value.
    filter.w0 = constant_float(plane, edges.area());
    return filter;
}

}  // namespace strata::rasterizer
