// pipeline/device/vertex_path.h - the ways in which devices and drivers compute a position, as a choice. Two passes
// that choose differently may differ in the last bits of a vertex: the commonest reason for a ported peel to fail.
// Rules of each: pipeline/vertices/vertex_transform.h.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {

// The formulas of rows stand in vertices.md 2.
enum class VertexPath : std::uint8_t {
    // Every product and every sum rounded to binary32: the default.
    separate,
    // Fused multiply-add, each rounded once: compilers that contract.
    fused,
    // Model-view first, then the projection, with sums in pairs: drivers that keep two matrices.
    reassociated,
    // In binary64, rounded once: a host that transforms by itself.
    double_precision,
    // Every product and every sum cut toward zero.
    toward_zero,
    // The vertex engine of GeForce3, with its divide by w and its viewport.
    nv20
};

// In the order of the enum.
inline constexpr std::array<std::string_view, 6> vertex_path_names{"separate", "fused",       "reassociated",
                                                                   "double",   "toward_zero", "nv20"};
static_assert(vertex_path_names.size() == enum_values<VertexPath>.size());

}  // namespace strata::pipeline
