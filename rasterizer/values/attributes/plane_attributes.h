// rasterizer/values/attributes/plane_attributes.h - colours and texture coordinates by exact planes, or by NV2A's
// weights where the rules name them (chip_attributes.h).
//
// Rule     u (1/w) rounded to binary32 at the vertex, its exact plane rounded once, divided by the plane of 1/w rounded
//          once, the quotient correctly rounded; three vertex values with the same bits give that constant (assumed).
//          PlaneOrigin::unsnapped: the planes start at the unsnapped positions, are evaluated in binary64 and rounded
//          once.
// Source   rasterizer/reference/attributes.md 1 to 3
// Tests    tests/rasterizer/values/fragment_values_test.cpp
#pragma once
#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {
inline namespace strict {
struct AttributeLanes;  // lane_kernels.h
struct ChipKernels;     // chip_lanes.h
}  // namespace strict

struct PlaneAttributes {
    const LaneKernels& kernels;
    const ChipKernels* chip_kernels;
    bool has_color, has_texcoord;
    // Fragments have weights. Returns the number of exact fallbacks.
    [[nodiscard]] int fill(const TriangleFragments& fragments) const;
};

// Computes planes and constants by the kernel, or exactly if the kernel's filter cannot decide a lane.
[[nodiscard]] int fill_planes(const LaneKernels& kernels, const AttributeLanes& planes, const TriangleLanes& lanes);

}  // namespace strata::rasterizer
