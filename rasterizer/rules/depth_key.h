// rasterizer/rules/depth_key.h - the number by which fragments are ordered under reversed depth: less is nearer, as
// everywhere.
//
// Rule     Under DepthOrder::greater every depth leaves the rasterizer as its key, an involution that turns the order
//          round: 0 and 1 change places, other normal numbers z in [0,1] become the number with the bits 3fffffff -
//          bits(z). Denormal depths count as 0. Beyond the range, z > 1 becomes a negative key and z < 0 one above 1,
//          in order.
// Source   depth.md 11: a machine whose tests are GREATER, whose clears are 0 and whose MIN is MAX does on depths what
//          one with LESS, 1 and MIN does on keys.
// Numbers  bits(0.5) = 3f000000. No key is denormal, so that blending into float targets, which may flush, leaves keys
//          alone.
// Tests    tests/rasterizer/rules/depth_key_test.cpp
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {

inline namespace strict {

// Of a D32F code, bits 0 to 3f800000; and back.
[[nodiscard]] constexpr std::uint32_t depth_key(std::uint32_t code) noexcept {
    constexpr std::uint32_t one = 0x3f800000u, least_normal = 0x00800000u;
    if (code < least_normal) return one;
    return code >= one ? 0u : 0x3fffffffu - code;
}

// Of any float; NaN stays as it is.
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
