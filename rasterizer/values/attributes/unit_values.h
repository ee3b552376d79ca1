// rasterizer/values/attributes/unit_values.h - the values of VertexExtras at a triangle's fragments: the coordinates of
// texture units, the fog coordinate and the secondary colour.
//
// Rule     Each of s, t, r, q and the fog coordinate is interpolated like every attribute in plane_attributes.h. Under
//          another DepthHypothesis they are interpolated as depth_paths.h does r and q; where truncated_coordinates.h
//          applies, by its rule. Nothing is divided by q here: the texture shader decides which operation does. The
//          secondary colour is interpolated like the colour: by its plane, or by NV2A's weights.
// Source   rasterizer/reference/attributes.md 1.1, 2.8 and 3.4 (GL 2.1 equation 3.8).
// Tests    tests/rasterizer/values/unit_values_test.cpp
#pragma once
#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {
inline namespace strict {
struct ChipKernels;  // chip_lanes.h
}

struct UnitValues {
    const LaneKernels& kernels;
    const ChipKernels* chip_kernels;
    UnitMask units = 0;
    bool has_fog = false, has_secondary = false;
    // Fragments have weights. Returns the number of exact fallbacks.
    [[nodiscard]] int fill(const TriangleFragments& fragments) const;
};

}  // namespace strata::rasterizer
