// rasterizer/rules/depth_code.h - converts window depth to its stored code. Depth is compared only as stored codes.
//
// Rule     D16, D24: clamp to [0,1], scale by 2^n - 1, round by the profile's rule (DepthRounding); NaN is 0. D32F: the
//          float itself, clamped to [0,1] and with -0 replaced by +0, so the codes of each format are ordered like
//          unsigned integers. D16F: depth 1 is its greatest value, 511.9375; the mantissa is truncated to 12 bits and
//          an exponent field of 0 is flushed to 0, whatever the rounding rule. D24F: depth 1 is 1e30; binary32 without
//          its sign, mantissa truncated to 16 bits, values below 2^-126 flushed to 0. The conversions are in
//          depth_text-inl.h. Under DepthLimits::wrap nothing is clamped (rasterizer/reference/depth.md 2.9).
// Source   depth.md 2 (D3D 11.3 17.10-17.11, GL 2.1 2.11.1, ARB_depth_buffer_float); floor is GeForce3's. D16F and
//          D24F: chip-float-depth.md 3.
// Numbers  Scaling is in binary64: a product of 24 by 24 bits is exact, while binary32 cannot represent halves of a
//          code above z = 0.5.
// Tests    tests/rasterizer/rules/depth_code_test.cpp, tests/rasterizer/values/d16f_paths_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {

// d16f: 4 bits of exponent, 12 of mantissa, no sign; values below the smallest normal one are 0. d24f: 8 bits of
// exponent, 16 of mantissa, no sign.
enum class DepthFormat : std::uint8_t { d16, d24, d32f, d16f, d24f };
// The rounding of a value to a fixed-point code. floor: truncated. nearest: to nearest, a half rounds up. product_even:
// scaled in binary32, and that product to nearest, a half to the even code. product_floor: 16 bits are scaled in
// binary32 and truncated, 24 bits as by floor. The float formats ignore it.
enum class DepthRounding : std::uint8_t { floor, nearest, product_even, product_floor };

[[nodiscard]] constexpr bool truncates(DepthRounding rounding) noexcept {
    return rounding == DepthRounding::floor || rounding == DepthRounding::product_floor;
}

// The conversions from a value to a code.
enum class CodeKind : std::uint8_t { fixed, fixed_product, fixed_truncated_product, binary32, d16f, d24f };

// The conversion of values in one unit to codes of one format. `Limit` is binary32 for values in [0,1], whose limits it
// represents exactly.
template <class Limit>
struct DepthConversion {
    CodeKind kind;
    Limit least, greatest;  // the depth range, in the unit of the values
    double scale, half;     // buffer units per unit of the values; the rounding term, added before truncation
    bool wraps = false;     // DepthLimits::wrap: the range is not applied; to_wrapped_code is used
    [[nodiscard]] constexpr bool is_fixed() const noexcept {
        return kind == CodeKind::fixed || kind == CodeKind::fixed_product || kind == CodeKind::fixed_truncated_product;
    }
};

inline namespace strict {

// An order-preserving code of any float except NaN: the sort key of depths that are not stored codes.
[[nodiscard]] constexpr std::uint32_t ordered_code(float z) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(z == 0.0f ? 0.0f : z);  // -0 is 0
    return bits >> 31 != 0 ? ~bits : bits | 0x80000000u;
}

// The value of depth 1.0 in D24F: the limit that NV2A's drivers used (depth.md 1.3).
inline constexpr float max_d24f = 1e30f;

// The code of depth 1.0: 2^n - 1, the bits of 1.0f, or those of 1e30.
[[nodiscard]] constexpr std::uint32_t max_code(DepthFormat format) noexcept {
    switch (format) {
        case DepthFormat::d16: return 0xffffu;
        case DepthFormat::d24: return 0xffffffu;
        case DepthFormat::d32f: return std::bit_cast<std::uint32_t>(1.0f);
        case DepthFormat::d16f: return 0xffffu;
        case DepthFormat::d24f: break;
    }
    return std::bit_cast<std::uint32_t>(max_d24f) >> 7;
}

// (2 - 2^-12) 2^8: the value of code 0xffff.
inline constexpr float max_d16f = 511.9375f;

[[nodiscard]] constexpr CodeKind code_kind(DepthFormat format) noexcept {
    switch (format) {
        case DepthFormat::d16:
        case DepthFormat::d24: return CodeKind::fixed;
        case DepthFormat::d32f: return CodeKind::binary32;
        case DepthFormat::d16f: return CodeKind::d16f;
        case DepthFormat::d24f: break;
    }
    return CodeKind::d24f;
}

// Depth 1.0 in the buffer's own units: 2^n - 1, 1, 511.9375, or 1e30.
[[nodiscard]] constexpr double buffer_units(DepthFormat format) noexcept {
    switch (code_kind(format)) {
        case CodeKind::fixed:
        case CodeKind::fixed_product:
        case CodeKind::fixed_truncated_product: return max_code(format);
        case CodeKind::binary32: return 1.0;
        case CodeKind::d16f: return max_d16f;
        case CodeKind::d24f: break;
    }
    return max_d24f;
}

// For values in D16F's own units, [0, 511.9375]: the leading bits of the binary64 minus those of 2^-7. Negative values
// and NaN give 0.
[[nodiscard]] constexpr std::uint32_t to_d16f_code(double value) noexcept {
    if (!(value > 0.0)) return 0;
    if (value >= max_d16f) return 0xffffu;
    constexpr std::uint64_t least = std::bit_cast<std::uint64_t>(0x1p-7);
    // A code below it has exponent field 0, and NV2A stores 0 instead (depth.md 2.3).
    constexpr std::uint32_t least_normal = 0x1000;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    // 12 of the 52 mantissa bits of binary64 remain; this truncation is the only rounding.
    const auto code = static_cast<std::uint32_t>(bits < least ? 0 : (bits - least) >> 40);
    return code < least_normal ? 0 : code;
}
// For values in D24F's own units, [0, FLT_MAX]: the leading bits of the binary64 minus those of 2^-127.
[[nodiscard]] constexpr std::uint32_t to_d24f_code(double value) noexcept {
    constexpr double least = 0x1p-126, greatest = 0x1.fffffep127;
    if (!(value >= least)) return 0;
    constexpr std::uint32_t below = 1023 - 127;  // difference of the exponent biases of binary64 and D24F
    const double bounded = value < greatest ? value : greatest;
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(bounded) >> 36) - (below << 16);
}
// The exact value of a code (depth.md 1.3). Codes below 2^16 do not occur, and codes whose exponent is all ones exceed
// the range of binary32.
[[nodiscard]] constexpr double d24f_value(std::uint32_t code) noexcept {
    const std::uint64_t bits = std::uint64_t{code + ((1023 - 127) << 16)} << 36;
    return code < 0x10000 ? 0.0 : std::bit_cast<double>(bits);
}
// The exact value of a code (depth.md 1.2).
[[nodiscard]] constexpr float d16f_value(std::uint32_t code) noexcept {
    return code == 0 ? 0.0f : std::bit_cast<float>((code << 11) + 0x3c000000u);
}

// The operations of depth_text-inl.h on a single value.
template <class Value>
struct OneLane {
    static constexpr Value all(Value v) noexcept { return v; }
    static constexpr Value greater_or_second(Value a, Value b) noexcept { return a > b ? a : b; }
    static constexpr Value less_or_second(Value a, Value b) noexcept { return a < b ? a : b; }
    static constexpr std::uint32_t bits(Value v) noexcept {
        return std::bit_cast<std::uint32_t>(static_cast<float>(v));
    }
    static constexpr double times(Value v, double scale) noexcept { return double{v} * scale; }
    static constexpr std::uint32_t truncated_sum(double v, double half) noexcept {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(v + half));  // vectors have no unsigned conversion
    }
    // The unit in the last place of a sum with this number is 1.
    static constexpr std::uint32_t nearest_even_of_product(double v) noexcept {
        constexpr double round_at_one = 0x1.8p52;
        return static_cast<std::uint32_t>((double{static_cast<float>(v)} + round_at_one) - round_at_one);
    }
    static constexpr std::uint32_t truncated_product(double v) noexcept {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(static_cast<float>(v)));
    }
    static constexpr std::uint32_t truncate_to_d16f(double v) noexcept { return to_d16f_code(v); }
    static constexpr std::uint32_t truncate_to_d24f(double v) noexcept { return to_d24f_code(v); }
};

#include "rasterizer/rules/depth_text-inl.h"

// The code of one value. Loops over many values select the kind outside the loop.
template <class Value>
[[nodiscard]] constexpr std::uint32_t depth_code(Value z, const DepthConversion<Value>& to) noexcept {
    switch (to.kind) {
        case CodeKind::fixed: return depth_code<CodeKind::fixed>(OneLane<Value>{}, z, to);
        case CodeKind::fixed_product: return depth_code<CodeKind::fixed_product>(OneLane<Value>{}, z, to);
        case CodeKind::fixed_truncated_product:
            return depth_code<CodeKind::fixed_truncated_product>(OneLane<Value>{}, z, to);
        case CodeKind::binary32: return depth_code<CodeKind::binary32>(OneLane<Value>{}, z, to);
        case CodeKind::d16f: return depth_code<CodeKind::d16f>(OneLane<Value>{}, z, to);
        case CodeKind::d24f: break;
    }
    return depth_code<CodeKind::d24f>(OneLane<Value>{}, z, to);
}

// The code of a value under DepthLimits::wrap, where depth 1 is 1: D32F keeps the value. In fixed point it is scaled
// and rounded as usual and truncated toward zero to a signed integer; the lowest 32 bits are compared, and the target
// stores as many of them as it has (depth.md 2.9).
[[nodiscard]] constexpr std::uint32_t to_wrapped_code(float z, const DepthConversion<float>& to) noexcept {
    constexpr double most = 0x1p62;  // its lowest 32 bits are 0
    if (to.kind == CodeKind::binary32) return std::bit_cast<std::uint32_t>(z);
    const double exact = double{z} * to.scale;
    const bool is_product = to.kind == CodeKind::fixed_product || to.kind == CodeKind::fixed_truncated_product;
    const double scaled = is_product ? double{static_cast<float>(exact)} : exact;
    const double bounded = scaled > -most && scaled < most ? scaled : 0.0;  // NaN gives 0 too
    const auto whole = static_cast<std::int64_t>(bounded + (bounded < 0 ? -to.half : to.half));
    if (to.kind != CodeKind::fixed_product) return static_cast<std::uint32_t>(whole);
    const double rest = bounded - static_cast<double>(whole), distance = rest < 0 ? -rest : rest;
    const bool goes_on = distance > 0.5 || (distance == 0.5 && (whole & 1) != 0);
    return static_cast<std::uint32_t>(whole + (goes_on ? (rest < 0 ? -1 : 1) : 0));
}

// True if a code is outside the depth range, which occurs only under DepthLimits::wrap.
[[nodiscard]] constexpr bool is_beyond_range(std::uint32_t code, DepthFormat format) noexcept {
    return code > max_code(format);
}

// A limit of the depth range, clamped to [0,1] as glDepthRange does; -0 and NaN become 0.
[[nodiscard]] constexpr float range_limit(float z) noexcept { return z > 0.0f ? std::min(z, 1.0f) : 0.0f; }

// The conversion of values for which depth 1.0 is `units`: 1, or the buffer's own units.
template <class Limit>
[[nodiscard]] constexpr DepthConversion<Limit> depth_conversion(DepthFormat format, DepthRounding rounding, Limit units,
                                                                float near = 0.0f, float far = 1.0f) noexcept {
    const bool is_fixed = code_kind(format) == CodeKind::fixed, rounds = rounding == DepthRounding::nearest && is_fixed;
    const bool is_product = rounding == DepthRounding::product_even && is_fixed;
    const bool is_truncated_product = rounding == DepthRounding::product_floor && format == DepthFormat::d16;
    const CodeKind kind = is_product             ? CodeKind::fixed_product
                          : is_truncated_product ? CodeKind::fixed_truncated_product
                                                 : code_kind(format);
    const float n = range_limit(near), f = range_limit(far);
    return {kind, std::min(n, f) * units, std::max(n, f) * units, buffer_units(format) / units, rounds ? 0.5 : 0.0};
}

// The code of one depth, clamped to [0,1] (depth.md 2.1 to 2.3).
[[nodiscard]] constexpr std::uint32_t to_depth_code(float z, DepthFormat format, DepthRounding rounding) noexcept {
    return depth_code(z, depth_conversion(format, rounding, 1.0f));
}

// The exact value of a code in the buffer's own units.
[[nodiscard]] constexpr double buffer_value(std::uint32_t code, DepthFormat format) noexcept {
    switch (code_kind(format)) {
        case CodeKind::fixed:
        case CodeKind::fixed_product:
        case CodeKind::fixed_truncated_product: return code;
        case CodeKind::binary32: return double{std::bit_cast<float>(code)};
        case CodeKind::d16f: return double{d16f_value(code)};
        case CodeKind::d24f: break;
    }
    return d24f_value(code);
}

// k / (2^n - 1) rounded once to binary64, for images and reports; comparisons use codes.
[[nodiscard]] constexpr double depth_value(std::uint32_t code, DepthFormat format) noexcept {
    return buffer_value(code, format) / buffer_units(format);
}

}  // namespace strict
}  // namespace strata::rasterizer
