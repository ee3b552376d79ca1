// tools/probe/operations_srgb.cpp - sRGB conversions: codes of a texture to linear values, linear values to codes of a
// target.
//
// Source   the drivers' source code, verified on their pictures. Mesa 22: util/format_srgb.py (a table in 8 decimal
//          digits; 104 lines after F. Giesen, "Float to sRGB8", https://gist.github.com/rygorous/2203834),
//          gallivm/lp_bld_format_srgb.c (a cubic, and roots). SwiftShader: Pipeline/Constants.cpp (a table of
//          65,280ths) and Pipeline/ShaderCore.cpp (powers).
// Tests    tests/tools/probe/operations_rules_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "scenes/numbers/elementary.h"
#include "scenes/numbers/srgb_encode.h"
#include "tools/probe/operations_parts.h"

namespace strata::probe {

namespace {

// a * b + c, with one rounding or two.
template <bool is_fused>
float sum_of(float a, float b, float c) {
    return is_fused ? std::fma(a, b, c) : a * b + c;
}

using Decode = float (*)(std::uint32_t);

float formula(std::uint32_t code) { return scenes::decode_srgb(static_cast<float>(code) / 255.0f); }

template <int greatest>
float formula_in_steps(std::uint32_t code) {
    return std::floor(formula(code) * greatest + 0.5f) / greatest;
}
template <int greatest>
float formula_in_steps_scaled(std::uint32_t code) {
    return std::floor(formula(code) * greatest + 0.5f) * (1.0f / greatest);
}

double exact_formula(std::uint32_t code) {
    const double encoded = code / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : scenes::pow((encoded + 0.055) / 1.055, 2.4);
}

float formula_once(std::uint32_t code) { return static_cast<float>(exact_formula(code)); }

// The value as printed in a source file's table.
float formula_in_digits(std::uint32_t code) {
    const std::string digits = fmt::format("{:.7e}", exact_formula(code));
    float value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

// A line for the first 16 codes, then a cubic polynomial with even and odd powers summed separately.
template <bool is_fused>
float cubic(std::uint32_t code) {
    const auto x = static_cast<float>(code);
    if (code <= 15) return x * (1.0f / (12.6f * 255.0f));
    constexpr float c0 = 0.0023f, c1 = 0.0030f / 255.0f, c2 = 0.6935f / (255.0f * 255.0f),
                    c3 = 0.3012f / (255.0f * 255.0f * 255.0f);
    const float square = x * x;
    const float even = sum_of<is_fused>(square, c2, c0), odd = sum_of<is_fused>(square, c3, c1);
    return sum_of<is_fused>(odd, x, even);
}

Operation decoded() {
    Operation o{.name = "texture.srgb-decode", .question = "how exact is the table of sRGB?"};
    o.corners = whole_picture();
    o.programs = one_pass("result = uvec4(U(texelFetch(image, ivec2(int(given.x), 0), 0).r), 0u, 0u, 0u);",
                          "uniform highp sampler2D image;");
    o.image = SourceImage{.format = "srgb8"};
    for (std::uint32_t code = 0; code < 256; ++code) {
        o.image->texels.push_back(code);
        o.inputs.push_back(one_word(code));
    }
    const auto add = [&o](const std::string& name, Decode decode) {
        o.hypotheses.push_back({name, [decode](const Texel& t) { return one_word(word_of(decode(t[0]))); }});
    };
    add("the formula of the binary32 quotient", formula);
    add("the formula, rounded once", formula_once);
    add("the formula in 8 decimal digits", formula_in_digits);
    add("the formula, rounded to 8 bits", formula_in_steps<255>);
    add("the formula, rounded to 16 bits", formula_in_steps<65535>);
    add("the formula in steps of 1 / 65,280", formula_in_steps_scaled<65280>);
    add("a cubic, each step rounded", cubic<false>);
    add("a cubic, fused", cubic<true>);
    return o;
}

using Encode = std::uint32_t (*)(float);

std::uint32_t nearest_code(float linear) { return scenes::encode_srgb8(linear); }
std::uint32_t code_below(float linear) {
    return static_cast<std::uint32_t>(std::floor(scenes::encode_srgb(std::clamp(linear, 0.0f, 1.0f)) * 255.0f));
}

// Eight pieces per octave from 2^-13 on: the upper half of an entry is its start, in steps of 2^-7 code, the lower half
// its slope.
constexpr std::array<std::uint32_t, 104> pieces{
    0x0073000d, 0x007a000d, 0x0080000d, 0x0087000d, 0x008d000d, 0x0094000d, 0x009a000d, 0x00a1000d, 0x00a7001a,
    0x00b4001a, 0x00c1001a, 0x00ce001a, 0x00da001a, 0x00e7001a, 0x00f4001a, 0x0101001a, 0x010e0033, 0x01280033,
    0x01410033, 0x015b0033, 0x01750033, 0x018f0033, 0x01a80033, 0x01c20033, 0x01dc0067, 0x020f0067, 0x02430067,
    0x02760067, 0x02aa0067, 0x02dd0067, 0x03110067, 0x03440067, 0x037800ce, 0x03df00ce, 0x044600ce, 0x04ad00ce,
    0x051400ce, 0x057b00c5, 0x05dd00bc, 0x063b00b5, 0x06970158, 0x07420142, 0x07e30130, 0x087b0120, 0x090b0112,
    0x09940106, 0x0a1700fc, 0x0a9500f2, 0x0b0f01cb, 0x0bf401ae, 0x0ccb0195, 0x0d950180, 0x0e56016e, 0x0f0d015e,
    0x0fbc0150, 0x10630143, 0x11070264, 0x1238023e, 0x1357021d, 0x14660201, 0x156601e9, 0x165a01d3, 0x174401c0,
    0x182401af, 0x18fe0331, 0x1a9602fe, 0x1c1502d2, 0x1d7e02ad, 0x1ed4028d, 0x201a0270, 0x21520256, 0x227d0240,
    0x239f0443, 0x25c003fe, 0x27bf03c4, 0x29a10392, 0x2b6a0367, 0x2d1d0341, 0x2ebe031f, 0x304d0300, 0x31d105b0,
    0x34a80555, 0x37520507, 0x39d504c5, 0x3c37048b, 0x3e7c0458, 0x40a8042a, 0x42bd0401, 0x44c20798, 0x488e071e,
    0x4c1c06b6, 0x4f76065d, 0x52a50610, 0x55ac05cc, 0x5892058f, 0x5b590559, 0x5e0c0a23, 0x631c0980, 0x67db08f6,
    0x6c55087f, 0x70940818, 0x74a007bd, 0x787d076c, 0x7c330723};

std::uint32_t by_pieces(float linear) {
    const std::uint32_t word = word_of(std::clamp(linear, 0x1p-13f, 0x1.fffffep-1f));
    const std::uint32_t piece = pieces[(word - word_of(0x1p-13f)) >> 20];
    return ((piece >> 16 << 9) + (piece & 0xffffu) * (word >> 12 & 0xffu)) >> 16;
}

// a x^(3/8) + b x^(1/2) + c, with rounded square roots; the driver computes them from the processor's estimates.
std::uint32_t by_roots(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f), root = std::sqrt(x);
    const auto a = static_cast<float>(0.675f * 1.0622 * 255.0f), b = static_cast<float>(0.325f * 1.0622 * 255.0f);
    const float power = std::sqrt(std::sqrt(root * x));
    const float code = x <= 0.0031308f ? x * (12.92f * 255.0f) : a * power + (b * root + -0.0620f * 255.0f);
    return static_cast<std::uint32_t>(std::nearbyint(code));
}

// SwiftShader's binary32 power before "Mediump" (its SWIFTSHADER_LEGACY_PRECISION): log2 is the exponent plus a
// quotient of two polynomials of the mantissa m; exp2 is a polynomial of the fraction.
template <bool is_fused>
float logarithm_of_2(float x) {
    const std::uint32_t word = word_of(x);
    const float m = float_of((word & 0x7fffffu) | 0x3f800000u);
    // The exponent's bits as the upper bits of a mantissa.
    const float exponent = (float_of((word & 0x7f800000u) >> 8 | 0x3f800000u) - 1.4960938f) * 256.0f;
    const auto sum = sum_of<is_fused>;
    const float over = sum(sum(9.5428179e-2f, m, 4.7779095e-1f), m, 1.9782813e-1f);
    const float under = sum(sum(sum(1.6618466e-2f, m, 2.0350508e-1f), m, 2.7382900e-1f), m, 4.0496687e-2f);
    return exponent + (m - 1.0f) * (over / under);
}

float power_of_2(float x) {
    const float whole = std::nearbyint(x - 0.5f), rest = x - whole;
    float sum = float_of(0x3af61905u);
    for (const std::uint32_t word : {0x3c134806u, 0x3d64aa23u, 0x3e75ead4u, 0x3f31727bu, 0x3f800000u})
        sum = sum * rest + float_of(word);
    return std::ldexp(1.0f, static_cast<int>(whole)) * sum;
}

template <bool is_fused>
std::uint32_t by_power(float linear) {
    const float power = power_of_2(logarithm_of_2<is_fused>(linear) * (1.0f / 2.4f));
    const float encoded = linear < 0.0031308f ? linear * 12.92f : sum_of<is_fused>(1.055f, power, -0.055f);
    return static_cast<std::uint32_t>(std::nearbyint(std::clamp(encoded, 0.0f, 1.0f) * 255.0f));
}

// Alpha is linear: its codes are those of a store to UNORM8.
Operation encoded() {
    Operation o{.name = "target.srgb-encode", .question = "which code does a linear value get in an sRGB target?"};
    o.corners = whole_picture();
    o.programs = one_pass("result = vec4(F(given.x), F(given.x), F(given.x), 1.0);", "", true);
    o.result = ResultKind::srgb8;
    for (std::uint32_t code = 0; code < 256; ++code) {
        // The value of the code, and the border to the next code with values a relative 2^-10 below and above it.
        const float middle = scenes::decode_srgb(static_cast<float>(code) / 255.0f);
        const float border = scenes::decode_srgb((static_cast<float>(code) + 0.5f) / 255.0f);
        for (const float value : {middle, border * (1.0f - 0x1p-10f), border, border * (1.0f + 0x1p-10f)})
            o.inputs.push_back(one_word(word_of(value)));
    }
    const auto add = [&o](const std::string& name, Encode encode) {
        o.hypotheses.push_back({name, [encode](const Texel& t) { return one_word(encode(float_of(t[0]))); }});
    };
    add("the nearest code of the exact formula", nearest_code);
    add("the code below of the exact formula", code_below);
    add("8 lines an octave", by_pieces);
    add("square and eighth roots", by_roots);
    add("a power by quotients, each step rounded", by_power<false>);
    add("a power by quotients, fused", by_power<true>);
    return o;
}

}  // namespace

void add_srgb(std::vector<Operation>& list) {
    list.push_back(decoded());
    list.push_back(encoded());
}

}  // namespace strata::probe
