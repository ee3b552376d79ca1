// rasterizer/values/attributes/stepped_attributes.h - colours and texture coordinates by planes that are stepped in
// binary32 (float_planes.h, ordered_planes.h).
//
// Rule     PerspectiveDivide::reciprocal multiplies by the rounded reciprocal of the plane of 1/w.
// Source   pipeline/reference/mesa-rasterizers.md 2.4 and 3.3
// Tests    tests/rasterizer/values/float_planes_test.cpp, ordered_planes_test.cpp
#pragma once
#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {

struct SteppedAttributes {
    const LaneKernels& kernels;
    bool has_color, has_texcoord;
    void fill(const TriangleFragments& fragments) const noexcept;
};

}  // namespace strata::rasterizer
