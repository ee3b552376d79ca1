// tests/support/color_machine.h - independent model of a colour target, one channel at a time. Each operation is
// computed in binary64 and rounded to binary32; for one product or sum of binary32 values this double rounding gives
// the correctly rounded result (53 >= 2 * 24 + 2). Storing follows the model's own rules.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/stages/stored_color.h"
#include "tests/support/random_numbers.h"

// The model's short names have a namespace of their own.
namespace strata::testing::color_model {

using pipeline::BlendRounding;
using pipeline::BlendStorage;
using pipeline::ChannelType;
using pipeline::HalfRounding;
using pipeline::UnormRounding;

// All combinations of rules for storing and blending a colour that the tests use.
inline std::vector<pipeline::ColorRules> all_color_rules() {
    std::vector<pipeline::ColorRules> rules;
    for (const auto by : {BlendRounding::nearest, BlendRounding::truncate, BlendRounding::each_product,
                          BlendRounding::unrounded_source})
        for (const auto unorm : {UnormRounding::half_up, UnormRounding::product_even, UnormRounding::product_even_wide})
            rules.push_back({ChannelType::unorm8, {HalfRounding::nearest_even, unorm}, by, true});
    for (const auto unorm : {UnormRounding::half_up, UnormRounding::product_even, UnormRounding::product_even_wide})
        rules.push_back({ChannelType::unorm8,
                         {HalfRounding::nearest_even, unorm},
                         BlendRounding::nearest,
                         true,
                         BlendStorage::cached_tiles});
    for (const bool flushes : {false, true}) {
        rules.push_back({ChannelType::single, HalfRounding::nearest_even, BlendRounding::nearest, flushes});
        for (const auto half : {HalfRounding::nearest_even, HalfRounding::toward_zero, HalfRounding::no_infinity})
            rules.push_back({ChannelType::half, half, BlendRounding::nearest, flushes});
    }
    return rules;
}

inline float rounded(double exact) { return static_cast<float>(exact); }
inline float product(float a, float b) { return rounded(double{a} * b); }
inline float sum(float a, float b) { return rounded(double{a} + b); }

// x rounded to a half, to nearest or toward zero. The unit is 2^(exponent - 10), or 2^-24 below the normal range.
inline float model_half(float x, HalfRounding rounding) {
    const bool has_infinity = rounding != HalfRounding::no_infinity;
    if (!has_infinity && !(std::fabs(x) < 131040)) return std::isnan(x) ? -131008.0f : std::copysign(131008.0f, x);
    if (!std::isfinite(x) || x == 0) return x;
    const int unit = std::max(std::ilogb(x), -14) - 10;
    double units = std::ldexp(double{x}, -unit);
    if (!has_infinity)
        units = std::ldexp(std::trunc(std::ldexp(units, 13)), -13);  // keeps 24 significant bits of a normal half
    const double whole = rounding == HalfRounding::toward_zero ? std::trunc(units) : std::nearbyint(units);
    const double half = std::copysign(std::ldexp(whole, unit), x);
    if (std::fabs(half) < 65536 || !has_infinity) return rounded(half);
    return std::copysign(rounding == HalfRounding::nearest_even ? std::numeric_limits<float>::infinity() : 65504.0f, x);
}

// The model of one colour target under the given rules.
struct ColorMachine {
    pipeline::ColorRules rules;

    [[nodiscard]] bool is_unorm8() const { return rules.type == ChannelType::unorm8; }
    // True if the codes are blended as integers, not the values that they represent.
    [[nodiscard]] bool blends_codes() const {
        return is_unorm8() && rules.storage == BlendStorage::target && rules.blend != BlendRounding::unrounded_source;
    }
    [[nodiscard]] float flushed(float x) const {
        return rules.flushes && std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0f, x) : x;
    }
    [[nodiscard]] float read(std::uint32_t code) const {
        if (rules.type == ChannelType::single) return std::bit_cast<float>(code);
        const bool is_beyond = rules.rounding.half == HalfRounding::no_infinity && (code & 0x7c00) == 0x7c00;
        if (rules.type == ChannelType::half && is_beyond)
            return ((code & 0x8000) != 0 ? -64.0f : 64.0f) * static_cast<float>(1024 + (code & 0x3ff));
        if (rules.type == ChannelType::half) return pipeline::half_to_float(static_cast<std::uint16_t>(code));
        if (rules.rounding.unorm == UnormRounding::half_up) return rounded(code / 255.0);
        if (rules.rounding.unorm == UnormRounding::product_even_wide)
            return product(static_cast<float>(257 * code), rounded(1.0 / 65535.0));
        return product(static_cast<float>(code), rounded(1.0 / 255.0));
    }
    [[nodiscard]] std::uint32_t write(float x) const {
        if (rules.type == ChannelType::single) return std::bit_cast<std::uint32_t>(x);
        const bool has_infinity = rules.rounding.half != HalfRounding::no_infinity;
        if (rules.type == ChannelType::half && std::isnan(x) && has_infinity)
            return pipeline::to_half<HalfRounding::nearest_even>(x);
        if (const float half = model_half(x, rules.rounding.half);
            rules.type == ChannelType::half && !(std::fabs(half) < 65536) && !has_infinity)
            return (std::signbit(half) ? 0xfc00u : 0x7c00u) + static_cast<std::uint32_t>(std::fabs(half) / 64.0f) -
                   1024u;
        if (rules.type == ChannelType::half)
            // already exact as a half
            return pipeline::to_half<HalfRounding::toward_zero>(model_half(x, rules.rounding.half));
        const float clamped = std::isnan(x) ? 0.0f : std::clamp(x, 0.0f, 1.0f);
        if (rules.rounding.unorm == UnormRounding::half_up)
            return static_cast<std::uint32_t>(std::floor(double{clamped} * 255 + 0.5));
        return static_cast<std::uint32_t>(std::nearbyint(product(clamped, 255)));
    }
    [[nodiscard]] std::uint32_t max(float x, std::uint32_t code) const {
        return is_unorm8() ? std::max(write(x), code) : write(std::max(flushed(x), read(code)));
    }

    // s F + d G on codes. `floats` is the same on values.
    [[nodiscard]] std::uint32_t integers(std::uint32_t s, std::uint32_t F, std::uint32_t d, std::uint32_t G) const {
        const auto part = [](std::uint32_t ab) { return (ab + ab / 256 + 128) / 256; };
        if (rules.blend == BlendRounding::each_product) return std::min(part(s * F) + part(d * G), 255u);
        const double t = std::min(s * F + d * G, 65025u) / 255.0;
        return static_cast<std::uint32_t>(std::floor(rules.blend == BlendRounding::nearest ? t + 0.5 : t));
    }
    [[nodiscard]] std::uint32_t floats(float s, float F, float d, float G) const {
        const float result = flushed(sum(flushed(product(s, F)), flushed(product(d, G))));
        return write(std::isnan(result) ? std::bit_cast<float>(0x7fffffffu) : result);
    }
    [[nodiscard]] std::uint32_t over(std::uint32_t s, std::uint32_t alpha, std::uint32_t d) const {
        if (blends_codes()) return integers(s, alpha, d, 255 - alpha);
        const float a = flushed(read(alpha));
        return floats(flushed(read(s)), a, flushed(read(d)), flushed(sum(1, -a)));
    }
    [[nodiscard]] std::uint32_t under(std::uint32_t s, std::uint32_t d, std::uint32_t transmittance) const {
        if (blends_codes()) return integers(s, transmittance, d, 255);
        return floats(flushed(read(s)), flushed(read(transmittance)), flushed(read(d)), 1);
    }
    [[nodiscard]] std::uint32_t through(std::uint32_t alpha, std::uint32_t transmittance) const {
        if (blends_codes()) return integers(alpha, 0, transmittance, 255 - alpha);
        const float a = flushed(read(alpha));
        return floats(a, 0, flushed(read(transmittance)), flushed(sum(1, -a)));
    }
};

// A random stored code: an arbitrary one, or the code of a random channel value.
inline std::uint32_t any_stored_code(Random& random, const pipeline::ColorRules& rules) {
    if (rules.type == ChannelType::unorm8) return static_cast<std::uint32_t>(random_int(random, 0, 255));
    const std::uint32_t bits = random() & (rules.type == ChannelType::half ? 0xffffu : 0xffffffffu);
    const std::uint32_t plain = ColorMachine{rules}.write(random_channel(random));
    return random_int(random, 0, 1) == 0 ? bits : plain;
}

}  // namespace strata::testing::color_model
