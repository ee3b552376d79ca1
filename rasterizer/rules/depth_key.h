// rasterizer/rules/depth_key.h - the key by which fragments are ordered under reversed depth: a smaller key is nearer,
// as with standard depth.
//
// Rule     Under DepthOrder::greater every depth leaves the rasterizer as its key, an involution that reverses the
//          order. Of d16 and d24 it is the greatest code less the code. Of d32f 0 and 1 are exchanged, other normal
//          numbers z in [0,1] become the number with the bits 3fffffff - bits(z). Denormal depths count as 0. Outside
//          the range, z > 1 becomes a negative key and z < 0 a key above 1, in order.
// Source   rasterizer/reference/depth.md 11: a device that tests GREATER, clears to 0 and blends depths with MAX gives
//          the same results on depths as one with LESS, 1 and MIN gives on keys.
// Numbers  bits(0.5) = 3f000000. No key is denormal, so blending into float targets, which may flush denormals, does
//          not change keys.
// Tests    tests/rasterizer/rules/depth_key_test.cpp
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::rasterizer {

inline namespace strict {

// The key of a D32F code, bits 0 to 3f800000; also the inverse.
[[nodiscard]] constexpr std::uint32_t depth_key(std::uint32_t code) noexcept {
    constexpr std::uint32_t one = 0x3f800000u, least_normal = 0x00800000u;
    if (code < least_normal) return one;
    return code >= one ? 0u : 0x3fffffffu - code;
}

// The key of a code of d16, d24 or d32f; also the inverse.
[[nodiscard]] constexpr std::uint32_t depth_key(std::uint32_t code, DepthFormat format) noexcept {
    return format == DepthFormat::d32f ? depth_key(code) : max_code(format) - code;
}

// The key of any float; NaN is returned unchanged.
[[nodiscard]] constexpr float depth_key(float z) noexcept {
    constexpr std::uint32_t one = 0x3f800000u, greatest_denormal = 0x007fffffu, infinity = 0x7f800000u;
    if (z != z) return z;
    const auto bits = std::bit_cast<std::uint32_t>(z), magnitude = bits & 0x7fffffffu;
    if (magnitude <= greatest_denormal) return 1.0f;
    if (bits == magnitude) {
        if (magnitude <= one) return std::bit_cast<float>(depth_key(magnitude));
        return -std::bit_cast<float>(magnitude - one + greatest_denormal);
    }
    const std::uint32_t beyond = magnitude - greatest_denormal;
    return std::bit_cast<float>(beyond > infinity - one ? infinity : one + beyond);
}

}  // namespace strict
}  // namespace strata::rasterizer
