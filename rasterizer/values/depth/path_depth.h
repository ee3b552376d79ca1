// rasterizer/values/depth/path_depth.h - one function for each way in which a DepthPath computes depths and codes.
//
// Rule     select_path chooses the functions of a path once per draw. A path without a function for codes converts its
//          values: the quotients, float32_plane, and window_z rounded to binary32. `exact` rounds the plane in codes
//          once and clamps to the codes of the depth range; float32 converts shader_z.
// Source   rasterizer/reference/depth.md 4
// Tests    tests/rasterizer/values/fragment_values_test.cpp, stored_depths_test.cpp, depth_paths_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/values/depth/depth_scale.h"
#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {
inline namespace strict {
struct ChipKernels;  // chip_lanes.h
}

// The same for all triangles of a draw.
struct DepthConstants {
    const LaneKernels& kernels;
    const ChipKernels* chip_kernels;  // null: the definitions run
    DepthScale scale;
};

// A triangle and some of its fragments. `shader_z` is read only by float32 and packed_rgba8, and by the
// codes of `exact` in D32F.
struct DepthInput {
    const SetupTriangle& corners;
    const DrawnTriangle& triangle;
    const TriangleLanes& lanes;
    const float* shader_z;
};

// Functions return the number of exact fallbacks.
struct PathDepth {
    // Depths in the buffer's own units, before any clamp.
    int (*values)(const DepthConstants& constants, const DepthInput& input, double* out);
    // The codes of the path; null: those of its values.
    int (*codes)(const DepthConstants& constants, const DepthInput& input, std::uint32_t* out);

    [[nodiscard]] bool converts_values() const noexcept { return codes == nullptr; }
    friend bool operator==(const PathDepth&, const PathDepth&) = default;
};

[[nodiscard]] PathDepth select_path(DepthPath path, const DepthHypothesis& hypothesis) noexcept;

// True for the quotients r / q of two vertex values.
[[nodiscard]] constexpr bool is_quotient(DepthPath path) noexcept {
    return path == DepthPath::perspective_rq || path == DepthPath::depth_replace;
}
// True for depths that NV2A computes itself (chip_depth.cpp).
[[nodiscard]] constexpr bool is_chip(DepthPath path, const DepthHypothesis& hypothesis) noexcept {
    return path == DepthPath::w_buffer || (path == DepthPath::window_z && hypothesis.window_z == WindowZRule::chip);
}

// The functions of `exact`, of NV2A's window z and of its w buffer, and of r / q.
int exact_codes(const DepthConstants& constants, const DepthInput& input, std::uint32_t* out) noexcept;
int chip_window_z_values(const DepthConstants& constants, const DepthInput& input, double* out) noexcept;
int chip_window_z_codes(const DepthConstants& constants, const DepthInput& input, std::uint32_t* out) noexcept;
int w_buffer_values(const DepthConstants& constants, const DepthInput& input, double* out) noexcept;
int w_buffer_codes(const DepthConstants& constants, const DepthInput& input, std::uint32_t* out) noexcept;
int quotient_values(const DepthConstants& constants, const DrawnTriangle& triangle, const TriangleLanes& lanes,
                    double* out) noexcept;

// Codes of NV2A's window z by its kernel; false if the kernel does not suit the triangle.
[[nodiscard]] bool chip_window_z_by_kernel(const DepthConstants& constants, const DrawnTriangle& triangle,
                                           const std::uint16_t* x, const std::uint16_t* y, int count,
                                           std::uint32_t* out) noexcept;

}  // namespace strata::rasterizer
