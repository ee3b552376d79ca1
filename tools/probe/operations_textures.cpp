// tools/probe/operations_textures.cpp - operations for texel selection, weights of bilinear filtering, sRGB
// conversions, and shadow comparisons.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

constexpr auto plain_image = "uniform highp sampler2D image;";

Operation operation(std::string name, std::string question, const std::string& body, const std::string& declared) {
    Operation o{.name = std::move(name), .question = std::move(question)};
    o.corners = whole_picture();
    o.programs = one_pass(body, declared);
    return o;
}

// 25 texels with values 0 to 24: coordinates at and next to every texel edge, including outside, then arbitrary ones.
Operation nearest_texel() {
    constexpr int texels = 25;
    Operation o = operation("texture.nearest", "which texel is the nearest?",
                            "result = uvec4(U(texture(image, vec2(F(given.x), 0.5)).r), 0u, 0u, 0u);", plain_image);
    o.image = SourceImage{.format = "r32f"};
    for (int i = 0; i < texels; ++i) o.image->texels.push_back(word_of(static_cast<float>(i)));
    for (int i = -1; i <= texels + 1; ++i) {
        const std::uint32_t edge = word_of(static_cast<float>(i) / texels);
        for (std::uint32_t k = 0; k < 32; ++k)
            o.inputs.push_back(one_word(i == 0 ? word_of(static_cast<float>(k) * 0x1p-30f) : edge + k - 16));
    }
    RandomGenerator random{811};
    while (o.inputs.size() % 64 != 0 || o.inputs.size() < 1024) o.inputs.push_back(one_word(word_of(random.unit())));
    const auto texel = [](double place) {
        return one_word(word_of(static_cast<float>(std::clamp(place, 0.0, texels - 1.0))));
    };
    o.hypotheses = {{"floor of the binary32 product",
                     [texel](const Texel& t) { return texel(std::floor(double{float_of(t[0]) * 25.0f})); }},
                    {"floor of the exact product",
                     [texel](const Texel& t) { return texel(std::floor(double{float_of(t[0])} * texels)); }}};
    for (const int fraction : {8, 16})
        o.hypotheses.push_back(
            {fmt::format("floor of the product rounded to {} bits", fraction), [texel, fraction](const Texel& t) {
                 return texel(std::floor(
                     std::ldexp(std::floor(std::ldexp(double{float_of(t[0])} * texels, fraction) + 0.5), -fraction)));
             }});
    return o;
}

// Weights with a fixed number of bits; 0: all of binary32.
float weight_of(float u, int weight_bits, bool nearest) {
    const float exact = std::clamp(u * 2.0f - 0.5f, 0.0f, 1.0f);
    if (weight_bits == 0) return exact;
    const float scaled = std::ldexp(exact, weight_bits);
    return std::ldexp(std::floor(nearest ? scaled + 0.5f : scaled), -weight_bits);
}

float code_nearest(float weight) { return std::floor(weight * 255.0f + 0.5f) / 255.0f; }
float code_nearest_scaled(float weight) { return std::floor(weight * 255.0f + 0.5f) * (1.0f / 255.0f); }
// The weight of a texel that is stored as the upper 8 of 16 bits.
float of_65280ths(float weight) { return weight * 65280.0f * (1.0f / 65280.0f); }
float code_cut(float weight) { return std::floor(weight * 255.0f) / 255.0f; }

// Two texels, 0 and 1: the result is the weight.
Operation weights(const std::string& format) {
    Operation o = operation("texture.weights-" + format, "how many bits has the weight of a bilinear lookup?",
                            "result = uvec4(U(texture(image, vec2(F(given.x), 0.5)).r), 0u, 0u, 0u);", plain_image);
    const bool codes = format == "rgba8";
    o.image = SourceImage{.format = format, .texels = {0, codes ? 0xffu : 0x3f800000u}, .linear = true};
    RandomGenerator random{812};
    for (int i = 0; i < 2048; ++i) {
        const std::uint32_t word = random.next();
        o.inputs.push_back(one_word(word_of(0.25f + static_cast<float>(word >> 9) * 0x1p-24f)));
    }
    const auto add = [&o](const std::string& name, int count, bool nearest, float (*stored)(float)) {
        o.hypotheses.push_back({name, [count, nearest, stored](const Texel& t) {
                                    const float weight = weight_of(float_of(t[0]), count, nearest);
                                    return one_word(word_of(stored == nullptr ? weight : stored(weight)));
                                }});
    };
    add("binary32", 0, false, nullptr);
    for (int count = 4; count <= 16; ++count)
        for (const bool nearest : {true, false}) {
            const std::string name = fmt::format("{} bits, {}", count, nearest ? "nearest" : "cut");
            add(name, count, nearest, nullptr);
            if (!codes) continue;
            add(name + ", then the nearest code", count, nearest, code_nearest);
            add(name + ", then the nearest code times 1 / 255", count, nearest, code_nearest_scaled);
            add(name + ", then the code below", count, nearest, code_cut);
        }
    if (!codes) return o;
    add("binary32, then the nearest code", 0, false, code_nearest);
    add("binary32, times 65,280, times its reciprocal", 0, false, of_65280ths);
    return o;
}

// The depth of a code: the quotient rounded to binary32.
float depth_of(std::uint32_t code, int depth_bits) {
    if (depth_bits == 32) return float_of(code);
    return static_cast<float>(code) / static_cast<float>((1u << depth_bits) - 1u);
}
double code_of(double reference, int depth_bits) { return std::clamp(reference, 0.0, 1.0) * ((1u << depth_bits) - 1u); }

// The next code whose quotient differs from its product with a reciprocal.
std::uint32_t parting_code(std::uint32_t from, int depth_bits) {
    const float step = depth_of(1, depth_bits);
    while (static_cast<float>(from) * step == depth_of(from, depth_bits)) ++from;
    return from;
}

// The code of texel i of 64: both ends, codes that distinguish two conversions to a depth, and arbitrary ones.
std::uint32_t shadow_texel(std::uint32_t i, int depth_bits, RandomGenerator& random) {
    const float depth = random.unit();
    if (i == 0) return 0;
    if (depth_bits == 32) return word_of(i == 63 ? 1.0f : depth);
    const std::uint32_t greatest = (1u << depth_bits) - 1u;
    if (i == 63) return greatest;
    return i < 9 ? parting_code(greatest / 10 * i, depth_bits)
                 : static_cast<std::uint32_t>(depth * static_cast<float>(greatest));
}

// 64 texels; references at each, off by some representable numbers and by fractions of a code, and outside 0 to 1.
Operation shadow(const std::string& format, int depth_bits) {
    Operation o = operation("texture.shadow-" + format,
                            "is the reference rounded to the format, or clamped, before it is compared?",
                            "result = uvec4(texture(image, vec3((float(given.x) + 0.5) / 64.0, 0.5, F(given.y))) > 0.5 "
                            "? 1u : 0u, 0u, 0u, 0u);",
                            "uniform highp sampler2DShadow image;");
    o.result = ResultKind::words;
    o.image = SourceImage{.format = format, .compare = true};
    RandomGenerator random{813};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t code = shadow_texel(i, depth_bits, random);
        o.image->texels.push_back(code);
        const float at = depth_of(code, depth_bits), step = depth_bits == 32 ? at * 0x1p-12f : depth_of(1, depth_bits);
        for (const float part : {-0.75f, -0.55f, -0.45f, -0.25f, 0.25f, 0.45f, 0.55f, 0.75f})
            o.inputs.push_back({i, word_of(at + part * step), code, 0});
        for (const float value : {at, std::nextafter(std::max(at, 0x1p-125f), 2.0f),
                                  std::nextafter(std::max(at, 0x1p-125f), -1.0f), -0.5f, 1.5f, 1.0f, 0.0f, 0.5f})
            o.inputs.push_back({i, word_of(value), code, 0});
    }
    const auto add = [&o, depth_bits](const std::string& name, bool (*passes)(float, std::uint32_t, int)) {
        o.hypotheses.push_back({name, [passes, depth_bits](const Texel& t) {
                                    return one_word(passes(float_of(t[1]), t[2], depth_bits) ? 1 : 0);
                                }});
    };
    const auto clamped = [](float r, std::uint32_t code, int n) {
        return std::clamp(r, 0.0f, 1.0f) <= depth_of(code, n);
    };
    const auto as_it_is = [](float r, std::uint32_t code, int n) { return r <= depth_of(code, n); };
    if (depth_bits == 32) {
        add("as it is", as_it_is);
        add("clamped", clamped);
        return o;
    }
    add("clamped, binary32", clamped);
    add("as it is, binary32", as_it_is);
    add("clamped, against the code times a reciprocal", [](float r, std::uint32_t code, int n) {
        return std::clamp(r, 0.0f, 1.0f) <= static_cast<float>(code) * depth_of(1, n);
    });
    // Stored as binary32: from 32 bits, with the code's upper bits repeated below, and 2^32 - 1 rounded, too.
    if (depth_bits == 24) {
        add("as it is, against the binary32 of 32 bits", [](float r, std::uint32_t code, int) {
            return r <= static_cast<float>(code << 8 | code >> 16) * 0x1p-32f;
        });
        add("clamped, against the binary32 of 32 bits", [](float r, std::uint32_t code, int) {
            return std::clamp(r, 0.0f, 1.0f) <= static_cast<float>(code << 8 | code >> 16) * 0x1p-32f;
        });
    }
    add("rounded to the nearest code",
        [](float r, std::uint32_t code, int n) { return std::floor(code_of(double{r}, n) + 0.5) <= code; });
    add("cut to a code", [](float r, std::uint32_t code, int n) { return std::floor(code_of(double{r}, n)) <= code; });
    return o;
}

}  // namespace

void add_textures(std::vector<Operation>& list) {
    list.push_back(nearest_texel());
    list.push_back(weights("rgba8"));
    list.push_back(weights("r16f"));
    add_srgb(list);
    list.push_back(shadow("d16", 16));
    list.push_back(shadow("d24", 24));
    list.push_back(shadow("d32f", 32));
}

}  // namespace strata::probe
