// rasterizer/values/depth/depth_scale.h - the units of a draw's depths, and their conversion to codes.
//
// Rule     Codes are clamped to the depth range, unless RasterRules::depth_limits says otherwise. Keys of reversed
//          depth are limited to the depth range; the formats without a sign have no codes outside it.
// Source   rasterizer/reference/depth.md 1 and 2
// Tests    tests/rasterizer/values/stored_depths_test.cpp, fragment_values_test.cpp
#pragma once
#include <algorithm>
#include <array>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {
inline namespace strict {

// Converts a value in the buffer's own units to a code: clamped to two limits, then truncated. For fixed point the
// limits are codes.
struct ChipConversion {
    CodeKind kind = CodeKind::fixed;  // fixed, d16f or d24f
    double least = 0.0, greatest = 0.0;
};

// What a pass that stores window_z needs for a triangle: the conversion to codes, and the depth range that removes
// fragments.
struct ChipDepth {
    ChipConversion to_code;
    PolygonOffset offset;            // added per fragment (OffsetRule::fragments)
    double least = 0, greatest = 0;  // the depth range in the buffer's own units
    double low = 0, high = 0;        // the depth range in the units of vertex z
    bool clips = false;              // ZClip::per_fragment without depth clamp

    // A convex combination leaves the range only if a corner is outside; the products are exact.
    [[nodiscard]] bool may_leave_range(const std::array<double, 3>& z) const noexcept {
        const auto [nearest, farthest] = std::minmax({z[0], z[1], z[2]});
        return clips && (nearest < low || farthest > high);
    }
};

}  // namespace strict

struct DepthScale {
    DepthFormat format;
    // Units of vertex z, and of the buffer, in depth 1.0.
    double z_units, code_units;
    DepthConversion<float> to_code;         // for shader_z, as DepthPath::float32 stores it
    DepthConversion<double> value_to_code;  // for values in the buffer's own units
    ChipDepth chip;                         // for NV2A's window z
};

[[nodiscard]] DepthScale depth_scale(const Geometry& geometry, const DepthRequest& depth) noexcept;

}  // namespace strata::rasterizer
