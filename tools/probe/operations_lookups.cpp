// tools/probe/operations_lookups.cpp - textures: which texel is nearest, how finely two are mixed, sRGB, and compared depths.
#include <algorithm>
#include <cmath>

#include "rasterizer/rules/depth_code.h"
#include "scenes/numbers/srgb_encode.h"
#include "tools/probe/operation_numbers.h"

namespace strata::probe {

namespace {

using rasterizer::DepthFormat;
using rasterizer::DepthRounding;

constexpr auto look_up =
    "highp uvec4 operation(highp uvec4 a) {\n"
    "    return uvec4(floatBitsToUint(texture(table, uintBitsToFloat(a.xy)).r), 0u, 0u, 0u);\n}\n";

// Where coordinates of a texture of `width` texels pass from one to the next, as binary32 knows it, and beside it.
std::vector<Words> beside_edges(int width) {
    std::vector<Words> inputs;
    for (int edge = 1; edge < width; ++edge)
        for (int off = -6; off <= 6; ++off) {
            const float at = static_cast<float>(edge) / static_cast<float>(width);
            // A few units in the last place, then 2^-20, 2^-16, 2^-12 and 2^-9 of the texture.
            const float far = off < 0 ? -1.0f : 1.0f;
            const int size = std::abs(off);
            const float moved = size <= 2 ? as_float(as_word(at) + static_cast<std::uint32_t>(off))
                                          : at + far * std::exp2(-20.0f + 4.0f * static_cast<float>(size - 3));
            inputs.push_back({as_word(moved), as_word(0.5f), 0, 0});
        }
    return inputs;
}

// The coordinate in texels, in binary32 or with `bits` behind the point, is cut to the texel's number.
Hypothesis nearest_texel(const char* name, int width, int bits) {
    return float_rule(name, [width, bits](const Words& a) {
        const float u = as_float(a[0]);
        double texels = double{u * static_cast<float>(width)};
        if (bits > 0) texels = std::floor(double{u} * width * std::exp2(bits) + 0.5) * std::exp2(-bits);
        return std::clamp(static_cast<float>(std::floor(texels)), 0.0f, static_cast<float>(width - 1));
    });
}

Operation nearest() {
    constexpr int width = 61;
    OperationTexture texture{.format = "r32f", .width = width, .height = 1};
    for (int i = 0; i < width; ++i) texture.texels.push_back(as_word(static_cast<float>(i)));
    return {.name = "nearest-texel",
            .asks = "where GL_NEAREST passes from one texel to the next",
            .body = look_up,
            .inputs = beside_edges(width),
            .texture = texture,
            .hypotheses = {nearest_texel("u times the width in binary32, cut", width, 0),
                           nearest_texel("with 8 bits behind the point, rounded", width, 8),
                           nearest_texel("with 16 bits behind the point, rounded", width, 16)}};
}

// Between texels of 0 and 1 the result is the weight itself: of `bits` bits, cut or rounded, or of binary32.
Hypothesis mixed(const std::string& name, int bits, bool is_cut) {
    return float_rule(name.c_str(), [bits, is_cut](const Words& a) {
        const float at = as_float(a[0]) * 2.0f - 0.5f;
        double weight = std::clamp(double{at}, 0.0, 1.0);
        if (bits > 0) weight = std::floor(weight * std::exp2(bits) + (is_cut ? 0.0 : 0.5)) * std::exp2(-bits);
        return static_cast<float>(weight);
    });
}

// The same where the mixture is a code of 8 bits, as it is where the texels are mixed as they are stored.
Hypothesis mixed_codes(const std::string& name, int bits, bool weight_is_cut, bool code_is_cut) {
    return float_rule(name.c_str(), [bits, weight_is_cut, code_is_cut](const Words& a) {
        const float at = as_float(a[0]) * 2.0f - 0.5f;
        const double steps = std::exp2(bits);
        const double weight =
            std::floor(std::clamp(double{at}, 0.0, 1.0) * steps + (weight_is_cut ? 0.0 : 0.5)) / steps;
        return static_cast<float>(std::floor(weight * 255.0 + (code_is_cut ? 0.0 : 0.5))) / 255.0f;
    });
}

Operation bilinear() {
    OperationTexture texture{
        .format = "rgba8", .width = 2, .height = 1, .texels = {0xff000000u, 0xffffffffu}, .is_linear = true};
    std::vector<Words> inputs;
    Dice dice{31};
    for (int i = 0; i < 1024; ++i) {
        const float u = 0.25f + 0.5f * (static_cast<float>(i) + dice.unit()) / 1024.0f;
        inputs.push_back({as_word(u), as_word(0.5f), 0, 0});
    }
    std::vector<Hypothesis> hypotheses{mixed("weights of binary32", 0, false)};
    for (const int bits : {4, 6, 8, 10, 12, 16})
        for (const bool is_cut : {false, true})
            hypotheses.push_back(
                mixed("weights of " + std::to_string(bits) + (is_cut ? " bits, cut" : " bits, rounded"), bits, is_cut));
    for (const bool weight_is_cut : {false, true})
        for (const bool code_is_cut : {false, true})
            hypotheses.push_back(mixed_codes(std::string{"a code of 8 bits, "} + (code_is_cut ? "cut" : "rounded") +
                                                 ", by weights of 8 bits, " + (weight_is_cut ? "cut" : "rounded"),
                                             8, weight_is_cut, code_is_cut));
    return {.name = "linear-weight",
            .asks = "the bits of a weight between two texels",
            .body = look_up,
            .inputs = inputs,
            .in_units = true,
            .texture = texture,
            .hypotheses = hypotheses};
}

Operation from_srgb() {
    OperationTexture texture{.format = "srgb8", .width = 256, .height = 1};
    std::vector<Words> inputs;
    for (std::uint32_t code = 0; code < 256; ++code) {
        texture.texels.push_back(0xff000000u | code * 0x010101u);
        inputs.push_back({code, 0, 0, 0});
    }
    return {.name = "load-srgb",
            .asks = "the linear value of each sRGB code",
            .body =
                "highp uvec4 operation(highp uvec4 a) {\n"
                "    return uvec4(floatBitsToUint(texelFetch(table, ivec2(a.xy), 0).r), 0u, 0u, 0u);\n}\n",
            .inputs = inputs,
            .in_units = true,
            .texture = texture,
            .hypotheses = {
                float_rule("the exact curve rounded to binary32",
                           [](const Words& a) { return scenes::decode_srgb(static_cast<float>(a[0]) / 255.0f); }),
                float_rule("the exact curve to the nearest of 256 codes", [](const Words& a) {
                    return std::floor(scenes::decode_srgb(static_cast<float>(a[0]) / 255.0f) * 255.0f + 0.5f) / 255.0f;
                })}};
}

// A stored depth is compared with r, which goes through as it is, is held in [0, 1], or becomes a code first.
Operation shadow(const char* name, const char* format_name, DepthFormat format) {
    const bool is_float = format == DepthFormat::d32f;
    const double greatest = is_float ? 1.0 : rasterizer::buffer_units(format);
    OperationTexture texture{.format = format_name, .width = 64, .height = 1, .compares = true};
    std::vector<Words> inputs;
    Dice dice{41};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const auto depth = i == 63 ? 1.0 : static_cast<double>(dice.next()) * 0x1p-32;
        const std::uint32_t code =
            is_float ? as_word(static_cast<float>(depth)) : static_cast<std::uint32_t>(depth * greatest);
        texture.texels.push_back(code);
        const double stored = is_float ? double{as_float(code)} : code / greatest;
        for (const double off : {-1.5, -1.0, -0.75, -0.5, -0.25, -0.01, 0.0, 0.01, 0.25, 0.5, 0.75, 1.0, 1.5}) {
            const auto r = static_cast<float>(stored + off / (is_float ? 16777216.0 : greatest));
            inputs.push_back({i, as_word(r), code, 0});
        }
    }
    for (const std::uint32_t r : {0xbf800000u, 0x80000000u, 0x3f800001u, 0x40000000u, 0x7f800000u, 0xff800000u})
        for (const std::uint32_t texel : {5u, 63u}) inputs.push_back({texel, r, texture.texels[texel], 0});
    const auto stored = [is_float, greatest](const Words& a) {
        return is_float ? double{as_float(a[2])} : a[2] / greatest;
    };
    const auto compared = [](bool passes) { return passes ? 1.0f : 0.0f; };
    std::vector<Hypothesis> hypotheses{
        float_rule("r as it is, with the exact stored value",
                   [stored, compared](const Words& a) { return compared(double{as_float(a[1])} <= stored(a)); }),
        float_rule("r held in [0, 1], with the stored value in binary32", [stored, compared](const Words& a) {
            return compared(std::clamp(as_float(a[1]), 0.0f, 1.0f) <= static_cast<float>(stored(a)));
        })};
    if (!is_float)
        hypotheses.push_back(float_rule("r held in [0, 1], with the code times the rounded 1 / greatest code",
                                        [greatest, compared](const Words& a) {
                                            const float stored_depth =
                                                static_cast<float>(a[2]) * static_cast<float>(1.0 / greatest);
                                            return compared(std::clamp(as_float(a[1]), 0.0f, 1.0f) <= stored_depth);
                                        }));
    if (!is_float)
        for (const DepthRounding rounding : {DepthRounding::nearest, DepthRounding::floor, DepthRounding::product_even})
            hypotheses.push_back(float_rule(rounding == DepthRounding::nearest ? "r becomes the nearest code first"
                                            : rounding == DepthRounding::floor
                                                ? "r becomes a code first, cut"
                                                : "r becomes a code first, by a binary32 product",
                                            [format, rounding, compared](const Words& a) {
                                                const float r = std::clamp(as_float(a[1]), 0.0f, 1.0f);
                                                return compared(rasterizer::to_depth_code(r, format, rounding) <= a[2]);
                                            }));
    return {.name = name,
            .asks = std::string{"whether a compared depth becomes a code of the "} + format_name + " map first",
            .body =
                "highp uvec4 operation(highp uvec4 a) {\n"
                "    highp vec3 at = vec3((float(a.x) + 0.5) / 64.0, 0.5, uintBitsToFloat(a.y));\n"
                "    return uvec4(floatBitsToUint(textureLod(table, at, 0.0)), 0u, 0u, 0u);\n}\n",
            .inputs = inputs,
            .texture = texture,
            .hypotheses = hypotheses};
}

}  // namespace

void add_lookups(std::vector<Operation>& all) {
    all.push_back(nearest());
    all.push_back(bilinear());
    all.push_back(from_srgb());
    all.push_back(shadow("shadow-d16", "d16", DepthFormat::d16));
    all.push_back(shadow("shadow-d24", "d24", DepthFormat::d24));
    all.push_back(shadow("shadow-d32f", "d32f", DepthFormat::d32f));
}

}  // namespace strata::probe
