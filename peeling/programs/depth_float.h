// peeling/programs/depth_float.h - converts stored depths to values that a program writes into a float target, and back
// to codes.
//
// Rule     D32F: the float itself. D16, D24: code / (2^n - 1) rounded to binary32, and back to the nearest code; every
//          code is recovered, and greater codes have greater values (24 bits fit into a binary32).
// Tests    tests/peeling/programs/programs_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/rules/depth_code.h"

namespace strata::peeling {
inline constexpr float no_node = 2.0f;  // where no fragment's depth is kept: behind every depth

inline namespace strict {

[[nodiscard]] constexpr float depth_as_float(std::uint32_t code, rasterizer::DepthFormat format) noexcept {
    return static_cast<float>(rasterizer::depth_value(code, format));
}

[[nodiscard]] constexpr std::uint32_t depth_as_code(float depth, rasterizer::DepthFormat format) noexcept {
    return rasterizer::to_depth_code(depth, format, rasterizer::DepthRounding::nearest);
}

}  // namespace strict
}  // namespace strata::peeling
