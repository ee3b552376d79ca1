// pipeline/formats/unorm8.h - 8-bit normalized colour: the value of code k is k / 255.
//
// Rule     To UNORM8: NaN is 0, clamp to [0,1], floor(255 x + 1/2) of the exact product. UnormRounding::product_even
//          and product_even_wide: 255 x rounded to binary32, and that to the nearest even code. From UNORM8: k / 255,
//          rounded once; with the other two roundings as in unorm8_product.h.
// Source   pipeline/reference/formats.md 2 (D3D 11.3 3.2.3.5 and 3.2.3.6, GL 2.1 2.14.9).
// Numbers  255 x has at most 32 significant bits: exact in binary64. If adding 1/2 rounds, x is far from every half
//          code.
// Tests    tests/pipeline/formats/unorm8_test.cpp: all 256 codes; all 2^32 floats
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "pipeline/formats/lane_mask.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

// The conversion between a binary32 value and an 8-bit code, in both directions.
enum class UnormRounding : std::uint8_t { half_up, product_even, product_even_wide };

// x clamped to [0,1]; 0 for NaN.
[[nodiscard]] constexpr float unorm_clamped(float x) noexcept {
    const std::uint32_t positive = std::bit_cast<std::uint32_t>(x) & mask(x > 0.0f);  // ordered like x
    return std::bit_cast<float>(std::min(static_cast<std::int32_t>(positive), std::bit_cast<std::int32_t>(1.0f)));
}

template <UnormRounding rounding = UnormRounding::half_up>
[[nodiscard]] constexpr std::uint8_t to_unorm8(float x) noexcept {
    const float clamped = unorm_clamped(x);
    if constexpr (rounding == UnormRounding::half_up)
        return static_cast<std::uint8_t>(static_cast<std::int32_t>(double{clamped} * 255.0 + 0.5));
    const float product = clamped * 255.0f;
    // The unit in the last place of a sum with this number is 1.
    constexpr float round_at_one = 0x1.8p23f;
    const float code = (product + round_at_one) - round_at_one;
    return static_cast<std::uint8_t>(static_cast<std::int32_t>(code));
}

[[nodiscard]] constexpr std::uint8_t to_unorm8(float x, UnormRounding rounding) noexcept {
    return rounding == UnormRounding::half_up ? to_unorm8<UnormRounding::half_up>(x)
                                              : to_unorm8<UnormRounding::product_even>(x);
}

[[nodiscard]] constexpr float from_unorm8(std::uint8_t code) noexcept {
    return static_cast<float>(code) / 255.0f;  // both are exact, so only the division rounds
}

// from_unorm8 without a division: k / 255 = k 257/2^16 + k / (255 2^16). The first product is exact and the second at
// most 2^-15 of it, so its rounding error does not affect the rounded sum; all 256 codes are checked below.
[[nodiscard]] constexpr float unorm8_value(std::uint32_t code) noexcept {
    const auto k = static_cast<float>(static_cast<std::int32_t>(code));  // this conversion has a vector form
    return k * 0x1.01p-8f + k * (1.0f / 0xff0000p0f);
}
static_assert([] {
    for (std::uint32_t k = 0; k < 256; ++k)
        if (unorm8_value(k) != from_unorm8(static_cast<std::uint8_t>(k))) return false;
    return true;
}());

// from_unorm8 of every code, for lookups instead of a division.
inline constexpr auto unorm8_table = [] {
    std::array<float, 256> table{};
    for (int k = 0; k < 256; ++k) table[static_cast<std::size_t>(k)] = from_unorm8(static_cast<std::uint8_t>(k));
    return table;
}();

}  // namespace strict
}  // namespace strata::pipeline
