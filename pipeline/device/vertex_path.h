// pipeline/device/vertex_path.h - the ways in which devices and drivers compute a position, as a choice. Two passes
// with different choices may differ in the last bits of a vertex: the most common reason for a ported peel to fail. The
// rules are in pipeline/vertices/vertex_transform.h.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {

// The formulas of the rows are in pipeline/reference/vertices.md 2.
enum class VertexPath : std::uint8_t {
    // Every product and every sum rounded to binary32: the default.
    separate,
    // Fused multiply-add, each rounded once: compilers with contraction.
    fused,
    // Model-view first, then the projection, sums in pairs: drivers that keep two matrices.
    reassociated,
    // In binary64, rounded once: transform on the host.
    double_precision,
    // Every product and every sum truncated toward zero.
    toward_zero,
    // The vertex engine of GeForce3, including its division by w and its viewport transform.
    nv20
};

// In the order of the enum.
inline constexpr std::array<std::string_view, 6> vertex_path_names{"separate", "fused",       "reassociated",
                                                                   "double",   "toward_zero", "nv20"};
static_assert(vertex_path_names.size() == enum_values<VertexPath>.size());

}  // namespace strata::pipeline
