// pipeline/formats/packed.h - colours that a device packs into 32 bits with channels of different kinds.
//
// Rule     srgb8_alpha8: red, green and blue are sRGB codes of linear values, alpha is k / 255. rgb10_a2: k / 1023, and
//          k / 3 for alpha, kept as the code 341 k of equal value. r11g11b10f: floats without sign, five bits of
//          exponent and six of mantissa (five for blue), kept as the half of equal value; alpha is 1.
// Numbers  A value is rounded once, from binary32. Codes of k / n follow UnormRounding: floor(n x + 1/2) in binary64,
//          or the binary32 product to the nearest even; a product's reader multiplies by f32(1 / n), the other divides.
//          Floats follow HalfRounding: nearest even, or truncated with toward_zero. Negative values and -infinity
//          become 0, finite values end at 65024 (64512 for blue), infinity stays, and a NaN becomes the positive quiet
//          one. Denormals are kept.
// Source   pipeline/reference/formats.md 4.3 (GL 4.6 core 2.3.4.3 and 2.3.4.4; ARB_framebuffer_sRGB; D3D 11.3 3.2.3).
// Tests    tests/pipeline/formats/packed_test.cpp: every code of every channel and the halves between them
#pragma once
#include <bit>
#include <cstdint>

#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/format.h"
#include "pipeline/formats/srgb.h"
#include "pipeline/formats/srgb_codes.h"
#include "pipeline/formats/unorm8_product.h"

namespace strata::pipeline {
inline namespace strict {

// The code k of k / greatest that is nearest to x; `greatest` is at most 65535.
[[nodiscard]] constexpr std::uint32_t to_unorm_code(float x, float greatest, UnormRounding rounding) noexcept {
    const float clamped = unorm_clamped(x);
    if (rounding == UnormRounding::half_up) return static_cast<std::uint32_t>(double{clamped} * double{greatest} + 0.5);
    constexpr float round_at_one = 0x1.8p23f;  // the unit in the last place of a sum with it is 1
    const float product = clamped * greatest;
    return static_cast<std::uint32_t>((product + round_at_one) - round_at_one);
}

[[nodiscard]] constexpr float unorm_code_value(std::uint32_t code, float greatest, UnormRounding rounding) noexcept {
    const auto k = static_cast<float>(code);
    return rounding == UnormRounding::half_up ? k / greatest : k * (1.0f / greatest);
}

// The half of a value that has `bits` of mantissa and no sign.
[[nodiscard]] constexpr std::uint32_t to_short_half(float x, int bits, HalfRounding rounding) noexcept {
    const auto word = std::bit_cast<std::uint32_t>(x);
    if ((word & 0x7fffffffu) > 0x7f800000u) return half_bits::quiet_nan;
    if ((word >> 31) != 0) return 0;
    if (word == 0x7f800000u) return half_bits::infinity;
    const int dropped = 10 - bits;
    const std::uint32_t greatest = half_bits::largest >> dropped << dropped;
    if (x >= 65536.0f) return greatest;
    // x in units of the last bit of the short mantissa, a product with a power of two; the denormals' unit below 2^-14.
    const std::uint32_t exponent = word >> 23 < 113 ? 113 : word >> 23;
    const double scaled = double{x} * std::bit_cast<double>(std::uint64_t{1023u + 127u - exponent} << 52) *
                          static_cast<double>(1u << bits);
    auto units = static_cast<std::uint32_t>(scaled);
    const double rest = scaled - static_cast<double>(units);
    const bool rounds_up = rest > 0.5 || (rest == 0.5 && (units & 1u) != 0);
    if (rounding != HalfRounding::toward_zero && rounds_up) ++units;
    // The leading bit of `units` is one step of the exponent field, which a carry increases too.
    const std::uint32_t code = (((exponent - 113) << bits) + units) << dropped;
    return code < greatest ? code : greatest;
}

// Mesa's llvmpipe blends rgb10_a2 as codes of k / 65535: it widens stored codes by copies of their bits, and shortens a
// result by a shift, alpha by the product with 3.
[[nodiscard]] constexpr std::uint32_t widened_to_16(int channel, std::uint32_t code) noexcept {
    return channel == 3 ? code / 341 * 0x5555u : code << 6 | code >> 4;
}
[[nodiscard]] constexpr std::uint32_t shortened_from_16(int channel, std::uint32_t code) noexcept {
    return channel == 3 ? 341 * (((code >> 2) * 3 + (1u << 13)) >> 14) : code >> 6;
}

// The code that a packed format stores for the value of a channel. Channel 0 is r, 3 is a.
[[nodiscard]] constexpr std::uint32_t packed_code(Format format, int channel, float x,
                                                  ColorRounding rounding) noexcept {
    const bool is_alpha = channel == 3;
    if (format == Format::srgb8_alpha8) return is_alpha ? to_unorm8(x, rounding.unorm) : to_srgb8(x);
    if (format == Format::rgb10_a2)
        return is_alpha ? 341 * to_unorm_code(x, 3, rounding.unorm) : to_unorm_code(x, 1023, rounding.unorm);
    constexpr std::uint32_t half_of_one = 0x3c00;
    return is_alpha ? half_of_one : to_short_half(x, channel == 2 ? 5 : 6, rounding.half);
}

// The value of a code, as a program or a blend reads it.
[[nodiscard]] constexpr float packed_value(Format format, int channel, std::uint32_t code,
                                           ColorRounding rounding) noexcept {
    const bool is_alpha = channel == 3;
    if (format == Format::srgb8_alpha8)
        return is_alpha ? code_value(code, rounding.unorm) : srgb_to_linear[code & 0xffu];
    if (format == Format::rgb10_a2)
        return is_alpha ? unorm_code_value(code / 341, 3, rounding.unorm)
                        : unorm_code_value(code, 1023, rounding.unorm);
    return half_to_float(static_cast<std::uint16_t>(code));
}

}  // namespace strict
}  // namespace strata::pipeline
