// pipeline/formats/half.h - conversion between binary16 and binary32.
//
//     15 14     10 9                 0     value = (-1)^s 2^(e-15) (1 + m/1024); e = 0: (-1)^s 2^-14 m/1024;
//     [s][exponent][    mantissa     ]     e = 31: infinity where m = 0, else NaN
//
// Rule     To binary32: exact, a NaN keeps its sign and payload. From binary32: nearest even (65520 and above is
//          infinity) or toward zero (finite values end at 65504); denormals are kept; a NaN keeps its sign and the
//          upper ten payload bits and becomes quiet. no_infinity: e = 31 is an ordinary exponent, for 65536 to 131008.
//          It rounds to nearest even; larger values and infinity become 131008. A NaN becomes -131008: arithmetic does
//          not define the sign of a NaN, and x86 generates negative ones. Below 2^-14 the significand is truncated to
//          24 bits after the shift and then rounded.
// Source   pipeline/reference/formats.md 3 (GL 3.3c 2.1.2; D3D 11.3 3.2.2; NV_gpu_program4).
// Tests    tests/pipeline/formats/half_test.cpp: all 65,536 halves; all 2^32 floats under both roundings
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "pipeline/formats/lane_mask.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

// The rounding of binary32 to binary16 on a store. Values out of range become infinity with nearest_even, 65504 with
// toward_zero, and 131008 with no_infinity.
enum class HalfRounding : std::uint8_t { nearest_even, toward_zero, no_infinity };

namespace half_bits {
inline constexpr std::uint32_t sign = 0x8000, infinity = 0x7c00, largest = 0x7bff, quiet_nan = 0x7e00,
                               largest_without_infinity = 0x7fff;
}

// The greatest half, at which sums stop under a rounding that never gives infinity; 0: sums become infinite.
[[nodiscard]] constexpr std::uint16_t stopping_half(HalfRounding rounding) noexcept {
    if (rounding == HalfRounding::nearest_even) return 0;
    return rounding == HalfRounding::toward_zero ? half_bits::largest : half_bits::largest_without_infinity;
}

// Without branches and variable shifts, so that the compiler vectorizes a loop over it.
[[nodiscard]] constexpr float half_to_float(std::uint16_t half) noexcept {
    const std::uint32_t sign = (std::uint32_t{half} & half_bits::sign) << 16;
    // Exponent and mantissa at their positions in binary32. The bias then changes from 15 to 127; e = 31 takes the same
    // step once more, to 255.
    const std::uint32_t magnitude = (std::uint32_t{half} & 0x7fffu) << 13;
    const std::uint32_t normal = magnitude + (112u << 23);
    const std::uint32_t special = normal + (112u << 23);
    // (1 + m/1024) 2^-14 - 2^-14: exact, and neither operand nor result is a binary32 denormal.
    const float denormal = std::bit_cast<float>(magnitude + (113u << 23)) - 0x1p-14f;
    std::uint32_t result = select(mask(magnitude < (1u << 23)), std::bit_cast<std::uint32_t>(denormal), normal);
    result = select(mask(magnitude >= (31u << 23)), special, result);
    return std::bit_cast<float>(sign | result);
}

// The value of a code under a rounding: with no_infinity exponent 31 is one more binade.
template <HalfRounding rounding>
[[nodiscard]] constexpr float half_value(std::uint16_t half) noexcept {
    const std::uint32_t magnitude = half & half_bits::largest_without_infinity;
    if (rounding != HalfRounding::no_infinity || magnitude < half_bits::infinity) return half_to_float(half);
    return std::bit_cast<float>((std::uint32_t{half} & half_bits::sign) << 16 | ((magnitude << 13) + (112u << 23)));
}
[[nodiscard]] constexpr float half_value(std::uint16_t half, HalfRounding rounding) noexcept {
    return rounding == HalfRounding::no_infinity ? half_value<HalfRounding::no_infinity>(half) : half_to_float(half);
}

// to_half<no_infinity>.
[[nodiscard]] constexpr std::uint16_t to_half_without_infinity(float value) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu, field = magnitude >> 23;
    // The code with 13 more bits; for a denormal the shift has already dropped some.
    const std::uint32_t shift = std::min(113 - field, 31u);
    const std::uint32_t denormal = field == 0 ? 0 : ((magnitude & 0x7fffffu) | 0x800000u) >> shift;
    const std::uint32_t wide = field < 113 ? denormal : magnitude - (112u << 23);
    const std::uint32_t code = (wide + 0xfffu + (wide >> 13 & 1u)) >> 13;
    const bool is_beyond = magnitude >= std::bit_cast<std::uint32_t>(131040.0f), is_nan = magnitude > 0x7f800000u;
    return static_cast<std::uint16_t>((is_nan ? half_bits::sign : bits >> 16 & half_bits::sign) |
                                      (is_beyond ? half_bits::largest_without_infinity : code));
}

// Computes normal, denormal and overflowing results and selects one, without a branch.
template <HalfRounding rounding>
[[nodiscard]] constexpr std::uint16_t to_half(float value) noexcept {
    if constexpr (rounding == HalfRounding::no_infinity) return to_half_without_infinity(value);
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    const std::uint32_t is_denormal = mask(magnitude < (113u << 23));  // below 2^-14
    const std::uint32_t rebiased = magnitude - (112u << 23);
    const float small = std::bit_cast<float>(magnitude & is_denormal);
    std::uint32_t normal = 0, denormal = 0, overflow = 0;
    if constexpr (rounding == HalfRounding::nearest_even) {
        normal =
            // A carry out of the mantissa propagates into the exponent, up to infinity.
            (rebiased + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
        denormal =
            // 0.5 has an ulp of 2^-24, the unit of half denormals, so the addition rounds to that unit.
            std::bit_cast<std::uint32_t>(small + 0.5f) - std::bit_cast<std::uint32_t>(0.5f);
        overflow = half_bits::infinity;
    } else {
        normal = rebiased >> 13;
        // The product is exact; the conversion truncates.
        denormal = static_cast<std::uint32_t>(static_cast<std::int32_t>(small * 0x1p24f));
        overflow = select(mask(magnitude == (255u << 23)), half_bits::infinity, half_bits::largest);
    }
    std::uint32_t result = select(is_denormal, denormal, normal);
    // Magnitudes of 2^16 and above.
    result = select(mask(magnitude >= (143u << 23)), overflow, result);
    result = select(mask(magnitude > (255u << 23)), half_bits::quiet_nan | ((magnitude >> 13) & 0x3ffu), result);
    return static_cast<std::uint16_t>(((bits >> 16) & half_bits::sign) | result);
}

[[nodiscard]] constexpr std::uint16_t to_half(float value, HalfRounding rounding) noexcept {
    using enum HalfRounding;
    switch (rounding) {
        case nearest_even: return to_half<nearest_even>(value);
        case toward_zero: return to_half<toward_zero>(value);
        case no_infinity: break;
    }
    return to_half<no_infinity>(value);
}

}  // namespace strict
}  // namespace strata::pipeline
