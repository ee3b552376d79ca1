// tools/probe/operations_discard.cpp - which alphas `if (a < t) discard` keeps, for values read as bits and for an
// attribute.
#include <array>
#include <cmath>

#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8.h"
#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

constexpr int ulps = 2;  // the largest distance of a threshold from its alpha

// Thresholds: zeros, the smallest numbers, 8-bit codes and the middles between two of them, and arbitrary values.
float threshold(int i, RandomGenerator& random) {
    constexpr std::array odd{0.0f, -0.0f, 0x1p-149f, 0x1p-130f, 0x1p-126f, 0x1.8p-126f, 0.5f, 1.0f, INFINITY};
    if (i < static_cast<int>(odd.size())) return odd[static_cast<std::size_t>(i)];
    const float code = static_cast<float>(random.below(256)) / 255.0f;
    return i % 3 == 0 ? code : i % 3 == 1 ? code + 0.5f / 255.0f : random.unit();
}

// Alphas for a threshold: its neighbours, values with the same code or half, its negative and NaN.
std::vector<Texel> alphas_and_thresholds() {
    RandomGenerator random{831};
    std::vector<Texel> all;
    for (int i = 0; i < 64; ++i) {
        const float t = threshold(i, random), above = std::nextafter(t, INFINITY), below = std::nextafter(t, -INFINITY);
        const std::array<float, 16> alphas{t,
                                           above,
                                           std::nextafter(above, INFINITY),
                                           below,
                                           std::nextafter(below, -INFINITY),
                                           t + 0.25f / 255.0f,
                                           t - 0.25f / 255.0f,
                                           t + 0.75f / 255.0f,
                                           t - 0.75f / 255.0f,
                                           t * (1.0f + 0x1p-14f),
                                           t * (1.0f - 0x1p-14f),
                                           -t,
                                           NAN,
                                           0x1p-140f,
                                           -0x1p-140f,
                                           random.unit()};
        for (const float alpha : alphas) all.push_back({word_of(alpha), word_of(t), 0, 0});
    }
    return all;
}

float as_it_is(float value) { return value; }
float flushed_denormal(float value) { return std::fabs(value) < 0x1p-126f ? 0.0f : value; }
float code_of_8_bits(float value) { return static_cast<float>(pipeline::to_unorm8(value)); }
float half_of(float value) {
    return pipeline::half_to_float(pipeline::to_half<pipeline::HalfRounding::nearest_even>(value));
}

// keeps_nan: kept unless a < t, so a NaN is kept. Otherwise: kept if a >= t, so it is not.
template <bool keeps_nan>
Hypothesis compared(std::string name, float (*rounded)(float)) {
    return {std::move(name), [rounded](const Texel& given) {
                const float alpha = rounded(float_of(given[0])), t = rounded(float_of(given[1]));
                const bool is_kept = keeps_nan ? !(alpha < t) : alpha >= t;
                return one_word(is_kept ? 1 : 0);
            }};
}

Operation by_value() {
    Operation o{.name = "test.discard", .question = "which alphas does `if (a < t) discard` keep?"};
    o.result = ResultKind::words;
    o.corners = whole_picture();
    o.programs = one_pass("if (F(given.x) < F(given.y)) discard; result = uvec4(1u, 0u, 0u, 0u);");
    o.inputs = alphas_and_thresholds();
    o.hypotheses = {compared<true>("binary32", as_it_is),
                    compared<false>("binary32, NaN is discarded", as_it_is),
                    compared<true>("binary32, denormals are 0", flushed_denormal),
                    compared<false>("binary32, denormals are 0, NaN is discarded", flushed_denormal),
                    compared<true>("binary16", half_of),
                    compared<true>("codes of 8 bits", code_of_8_bits)};
    return o;
}

// The interpolated value of a constant attribute with value a and w.
float by_reciprocals(float a, float w) {
    const float inverse = 1.0f / w, product = a * inverse;
    return product * (1.0f / inverse);
}
float by_quotient(float a, float w) {
    const float inverse = 1.0f / w, product = a * inverse;
    return product / inverse;
}
float by_product(float a, float w) {
    const float quotient = a / w;
    return quotient * w;
}
float by_quotients(float a, float w) {
    const float quotient = a / w, inverse = 1.0f / w;
    return quotient / inverse;
}

// SwiftShader's planes of a / w and 1 / w (its Pipeline/SetupRoutine.cpp), starting at the third corner, which is a
// quarter of a pixel above the centre: `own` and `other` are the corners' parts of the slope along y, which cancel
// except for rounding. Along x they are 0.
float by_planes(float a, float w) {
    const float inverse = 1.0f / w, square = w * w, scale = 1.0f / (square * 0.25f);
    const float own = square * 0.5f * (scale * inverse), other = -0.25f * w * scale;
    const float over = inverse - 0.25f * ((own + other) + other);
    const float value = a * inverse - 0.25f * ((a * own + a * other) + a * other);
    return value * (1.0f / over);
}

Hypothesis arriving(std::string name, float (*arrived)(float, float)) {
    return {std::move(name), [arrived](const Texel& given) {
                return one_word(arrived(float_of(given[0]), float_of(given[2])) < float_of(given[1]) ? 0 : 1);
            }};
}

// One triangle per pixel, as in test.facing: its corners have one alpha, stored in z, and one w. The threshold is the
// alpha or a neighbour of it.
Operation by_attribute() {
    constexpr int side = 32;
    Operation o{.name = "test.discard-attribute",
                .question = "does a constant alpha of a triangle come through its w to the bit?",
                .width = side};
    o.result = ResultKind::words;
    o.programs = one_pass("if (alpha < F(given.y)) discard; result = uvec4(1u, 0u, 0u, 0u);", "in highp float alpha;");
    o.programs.front().vertex =
        "layout(location = 0) in highp vec4 clip;\nout highp float alpha;\n"
        "void main() { gl_Position = vec4(clip.xy, 0.0, clip.w); alpha = clip.z; }";
    RandomGenerator random{832};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float alpha = static_cast<float>(1 + random.below(254)) / 255.0f;
            // A quarter of them are powers of two, with which every rule is exact.
            const float w =
                random.below(4) == 0 ? static_cast<float>(1 << random.below(3)) : random.between(0.5f, 4.0f);
            const std::uint32_t t = word_of(alpha) + static_cast<std::uint32_t>(random.below(2 * ulps + 1)) - ulps;
            const float at_x = (static_cast<float>(2 * x + 1) / side - 1.0f) * w;
            const float at_y = (static_cast<float>(2 * y + 1) / side - 1.0f) * w, reach = w / 64.0f;
            o.corners.insert(o.corners.end(), {{at_x - reach, at_y - reach, alpha, w},
                                               {at_x + reach, at_y - reach, alpha, w},
                                               {at_x, at_y + reach, alpha, w}});
            o.inputs.push_back({word_of(alpha), t, word_of(w), 0});
        }
    o.hypotheses = {arriving("as it is", [](float a, float) { return a; }),
                    arriving("a (1 / w), times the reciprocal of 1 / w", by_reciprocals),
                    arriving("a (1 / w) / (1 / w)", by_quotient),
                    arriving("(a / w) w", by_product),
                    arriving("(a / w) / (1 / w)", by_quotients),
                    arriving("planes of a / w and 1 / w, times a reciprocal", by_planes)};
    return o;
}

}  // namespace

void add_discards(std::vector<Operation>& list) {
    list.push_back(by_value());
    list.push_back(by_attribute());
}

}  // namespace strata::probe
