// rasterizer/values/depth/fast_depth.h - fills the depths of a triangle in one loop, for what most draws request.
//
// Rule     Every form gives the bits of DepthSteps (depth_steps.h), or nothing: then DepthSteps must run. A form is
//          selected once per draw; monostate: none suits the draw.
// Tests    tests/rasterizer/values/fragment_values_test.cpp, tests/rasterizer/walk/tile_rasterizer_test.cpp
#pragma once
#include <optional>
#include <variant>

#include "rasterizer/values/depth/path_depth.h"

namespace strata::rasterizer {

// fill returns the number of exact fallbacks, or nothing if the form does not suit the triangle.

// At most shader_z and its code by DepthPath::float32, by a kernel that computes the weights in the same loop.
struct KernelDepth {
    bool has_z, has_code, has_weights;
    [[nodiscard]] std::optional<int> fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept;
};

// Codes of NV2A's window z by its kernel; at most shader_z, and a reference by quotient, beside them.
struct ChipKernelDepth {
    bool has_z, has_code, has_reference, has_weights;
    [[nodiscard]] std::optional<int> fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept;
};

// shader_z by planes stepped in binary32, and its code by DepthPath::float32; no weights.
struct SteppedDepth {
    bool has_z, has_code;
    [[nodiscard]] std::optional<int> fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept;
};

using FastDepth = std::variant<std::monostate, KernelDepth, ChipKernelDepth, SteppedDepth>;

[[nodiscard]] FastDepth select_fast_depth(const DepthConstants& constants, const Geometry& geometry,
                                          const DepthRequest& depth, const FragmentNeeds& needs) noexcept;

}  // namespace strata::rasterizer
