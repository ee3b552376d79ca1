// pipeline/device/vertex_path.h - the ways in which devices and drivers compute a position, as a choice. Two passes that choose
// differently may differ in the last bits of a vertex: the commonest reason for a ported peel to fail.
// Rules of each: pipeline/vertices/vertex_transform.h.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {

enum class VertexPath : std::uint8_t {
    separate,          // every product and every sum rounded to binary32
    fused,             // fused multiply-add
    reassociated,      // model-view first, then the projection; sums in pairs
    double_precision,  // binary64, rounded once
    toward_zero,       // every product and every sum cut toward zero
    nv20               // the GeForce3's vertex engine, its divide by w and its viewport too
};

// In the order of the enum.
inline constexpr std::array<std::string_view, 6> vertex_path_names{"separate", "fused",       "reassociated",
                                                                   "double",   "toward_zero", "nv20"};
static_assert(vertex_path_names.size() == enum_values<VertexPath>.size());

}  // namespace strata::pipeline
