// pipeline/stages/stored_color.h - how a colour target stores and blends a channel, for passes that blend no pixel
// twice: the scalar reference of stored_color-inl.h.
//
// Rule     A channel is stored as a code. A program reads the value of the code, and its output is converted once. A
//          blend has operands (8-bit codes as integers, floats without denormals) and rounds its sum once, or each
//          product, as in blend_unorm8.h and blend_float.h. With BlendStorage::cached_tiles 8-bit codes are blended as
//          their values, in binary32; this is the only effect here. The same holds for BlendRounding::unrounded_source,
//          because a stored layer is a code.
// Numbers  Codes of values that are not negative have the order of the values: MAX of a plain colour is MAX of its
//          code.
// Tests    tests/peeling/loops/block_passes_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/format.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/stages/blend_float.h"
#include "pipeline/stages/blend_unorm8.h"

namespace strata::pipeline {

// The rules for storing and blending a colour.
struct ColorRules {
    ChannelType type = ChannelType::unorm8;
    ColorRounding rounding = HalfRounding::nearest_even;
    BlendRounding blend = BlendRounding::nearest;
    bool flushes = true;  // flushes denormals in float blends
    BlendStorage storage = BlendStorage::target;
};

[[nodiscard]] inline ColorRules color_rules(const DeviceProfile& profile, Format format) {
    return {.type = info(format).type,
            .rounding = profile.color_rounding(),
            .blend = profile.blend_rounding,
            .flushes = profile.denormals == DenormalRule::flush,
            .storage = profile.blend_storage};
}

// The rules as types, for loops that are compiled per rule.
template <BlendRounding blend, UnormRounding to_code, BlendStorage storage = BlendStorage::target>
struct Unorm8Rules {};
template <ChannelType type, HalfRounding half>
struct FloatRules {};

template <UnormRounding to_code, class Body>
void with_blend(const ColorRules& rules, const Body& body) {
    using enum BlendRounding;
    using enum BlendStorage;
    if (rules.storage == cached_tiles) return body(Unorm8Rules<nearest, to_code, cached_tiles>{});
    switch (rules.blend) {
        case nearest: return body(Unorm8Rules<nearest, to_code>{});
        case truncate: return body(Unorm8Rules<truncate, to_code>{});
        case each_product: return body(Unorm8Rules<each_product, to_code>{});
        case unrounded_source: return body(Unorm8Rules<unrounded_source, to_code>{});
    }
}

// Calls body with the type of the rules.
template <class Body>
void with_rules(const ColorRules& rules, const Body& body) {
    using enum ChannelType;
    using enum HalfRounding;
    using enum UnormRounding;
    if (rules.type == single) return body(FloatRules<single, nearest_even>{});
    if (rules.type == half && rules.rounding.half == nearest_even) return body(FloatRules<half, nearest_even>{});
    if (rules.type == half && rules.rounding.half == toward_zero) return body(FloatRules<half, toward_zero>{});
    if (rules.type == half) return body(FloatRules<half, no_infinity>{});
    switch (rules.rounding.unorm) {
        case half_up: return with_blend<half_up>(rules, body);
        case product_even: return with_blend<product_even>(rules, body);
        case product_even_wide: return with_blend<product_even_wide>(rules, body);
    }
}

inline namespace strict {

namespace scalar {

template <class Rules>
struct StoredColor;

// Values of codes are multiples of about 2^-8: no product of them is a denormal.
template <BlendRounding blend, UnormRounding to_code, BlendStorage storage>
struct StoredColor<Unorm8Rules<blend, to_code, storage>> {
    static constexpr bool blends_values =
        storage == BlendStorage::cached_tiles || blend == BlendRounding::unrounded_source;
    static constexpr float one = blends_values ? 1.0f : 255.0f;

    explicit StoredColor(const ColorRules&) noexcept {}
    [[nodiscard]] static float value(std::uint32_t code) noexcept { return code_value<to_code>(code); }
    [[nodiscard]] static std::uint32_t code(float x) noexcept { return to_unorm8<to_code>(x); }
    // The code that MAX stores for x > 0.
    [[nodiscard]] static std::uint32_t max_code(float x) noexcept { return code(x); }
    [[nodiscard]] static float operand(std::uint32_t code) noexcept {
        return blends_values ? value(code) : static_cast<float>(code);
    }
    [[nodiscard]] static float rest(float x) noexcept { return one - x; }
    [[nodiscard]] static std::uint32_t add(float s, float s_factor, float d, float d_factor) noexcept {
        if constexpr (blends_values) {
            const float source = s * s_factor, destination = d * d_factor;
            return code(source + destination);
        }
        using Arithmetic = Unorm8Arithmetic<blend>;
        return static_cast<std::uint32_t>(Arithmetic::template combine<BlendEquation::add>(s, s_factor, d, d_factor));
    }
};

template <ChannelType type, HalfRounding half>
struct StoredColor<FloatRules<type, half>> {
    static constexpr float one = 1.0f;
    bool flushes;

    explicit StoredColor(const ColorRules& rules) noexcept : flushes{rules.flushes} {}
    [[nodiscard]] static float value(std::uint32_t code) noexcept {
        if constexpr (type == ChannelType::single) return std::bit_cast<float>(code);
        return half_value<half>(static_cast<std::uint16_t>(code));
    }
    [[nodiscard]] static std::uint32_t code(float x) noexcept {
        if constexpr (type == ChannelType::single) return std::bit_cast<std::uint32_t>(x);
        return to_half<half>(x);
    }
    [[nodiscard]] float flushed(float x) const noexcept {
        return flushes ? strict::flushed<DenormalRule::flush>(x) : x;
    }
    [[nodiscard]] std::uint32_t max_code(float x) const noexcept { return code(flushed(x)); }
    [[nodiscard]] float operand(std::uint32_t code) const noexcept { return flushed(value(code)); }
    [[nodiscard]] float rest(float x) const noexcept { return flushed(one - x); }
    [[nodiscard]] std::uint32_t add(float s, float s_factor, float d, float d_factor) const noexcept {
        const float sum = flushed(s * s_factor) + flushed(d * d_factor);
        return code(canonical(flushed(sum)));
    }
};

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
