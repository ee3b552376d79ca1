// rasterizer/values/depth_paths.h - depth paths that compute a real value before it is converted to a code.
//
// Rule     perspective_rq, depth_replace: R = r/q from the first two extra values of the vertices (depth_quotient.h).
//          As for every attribute, three vertex values with the same bits give that constant, and where every w is 1
//          the planes are not divided. float32_plane: dz/dx = (z1 y2 - z2 y1) / a, dz/dy = (z2 x1 - z1 x2) / a and a =
//          x1 y2 - x2 y1, where corners 1 and 2 are relative to corner 0, at the positions of rules.plane_origin; z =
//          (z0 + dz/dx (x - x0)) + dz/dy (y - y0) at the pixel's centre, in pixels, every operation rounded to
//          binary32. PlaneAnchor::window_corner moves the plane to x0 = y0 = 0 first.
// Source   rasterizer/reference/depth.md 4; the form of float32_plane is assumed, it is in common use.
// Tests    tests/rasterizer/values/depth_paths_test.cpp
#pragma once
#include <array>

#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/depth_quotient.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/plane.h"

namespace strata::rasterizer {

// r, q and 1/w at the corners of a triangle.
struct QuotientCorners {
    std::array<float, 3> r, q, inverse_w;
};
[[nodiscard]] QuotientCorners quotient_corners(const Geometry& geometry, const TriangleRecord& triangle) noexcept;

// Interpolates one coordinate u at every lane as a perspective attribute: planes, then the division. Returns the number
// of exact fallbacks.
int interpolate(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w, const TriangleLanes& lanes,
                const DepthHypothesis& hypothesis, float* out) noexcept;

// R at every lane, in the units of r. Returns the number of exact fallbacks. Under the default hypothesis the attribute
// kernel computes it if its filter is certain.
int quotient_depth(const QuotientCorners& corners, const TriangleLanes& lanes, const DepthHypothesis& hypothesis,
                   const LaneKernels& kernels, double* out) noexcept;

// DepthPath::float32_plane by the rule above, in the units of vertex z. Its bits depend on the order of the corners
// (depth.md 4.7).
void float32_plane_depth(const SetupTriangle& triangle, const RasterRules& rules, const TriangleLanes& lanes,
                         double* out) noexcept;

// The plane of z rounded once to binary32, and in binary64, both in the units of vertex z. rounded_plane_depth returns
// the number of exact fallbacks.
int rounded_plane_depth(const SetupTriangle& triangle, const TriangleLanes& lanes, double* out) noexcept;
void plane_depth(const SetupTriangle& triangle, const TriangleLanes& lanes, double* out) noexcept;

// Adds r and q to vertices that have none: r = z S + w O with the viewport's scale S and offset O of z, each operation
// rounded; q = w.
void add_rq(TriangleSoup& soup, const RasterState& state, const RasterRules& rules);

}  // namespace strata::rasterizer
