// rasterizer/values/depth_paths.h - depth paths that are a value of their own before they become a code.
//
// Rule     perspective_rq, depth_replace: R = r/q of the vertices' first two extras (depth_quotient.h); three vertex
//          values of the same bits are that constant, and where every w is 1 the planes are not divided, as for every
//          attribute. float32_plane: dz/dx = (z1 y2 - z2 y1) / a, dz/dy = (z2 x1 - z1 x2) / a with corners 1 and 2 seen
//          from corner 0, at the positions of rules.plane_origin, and a = x1 y2 - x2 y1; z = (z0 + dz/dx (x - x0)) +
//          dz/dy (y - y0) at the pixel's centre, in pixels, every operation rounded to binary32.
//          PlaneAnchor::window_corner: moved to x0 = y0 = 0 first.
// Source   depth.md 4; [A], a form in common use.
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

// One coordinate u at every lane, as every perspective attribute: planes, then the divide. Returns exact fallbacks.
int interpolate(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w, const TriangleLanes& lanes,
                const DepthHypothesis& hypothesis, float* out) noexcept;

// R at every lane, in the units of r. Returns exact fallbacks. Under the default hypothesis the kernel of attributes
// does it, where it is certain.
int quotient_depth(const QuotientCorners& corners, const TriangleLanes& lanes, const DepthHypothesis& hypothesis,
                   const LaneKernels& kernels, double* out) noexcept;

// In the units of vertex z.
// DepthPath::float32_plane as the head has it. Its bits depend on the order of the corners (depth.md 4.7).
void float32_plane_depth(const SetupTriangle& triangle, const RasterRules& rules, const TriangleLanes& lanes,
                         double* out) noexcept;

// The value that window_z turns into a code by another rule than the chip's, and the exact plane's in binary64; in the
// units of vertex z. Returns exact fallbacks.
int window_z_depth(const SetupTriangle& triangle, const TriangleLanes& lanes, const DepthHypothesis& hypothesis,
                   double* out) noexcept;
void plane_depth(const SetupTriangle& triangle, const TriangleLanes& lanes, double* out) noexcept;

// r and q of vertices that have none: r = z S + w O with the viewport's scale and offset of z, each rounded; q = w.
void add_rq(TriangleSoup& soup, const RasterState& state, const RasterRules& rules);

}  // namespace strata::rasterizer
