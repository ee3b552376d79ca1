// tools/probe/operations_arithmetic.cpp - sums, products, quotients and roots of binary32 in a shader.
#include <cmath>

#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

using Three = float (*)(float, float, float);

Hypothesis of(std::string name, Three formula) {
    return {std::move(name), [formula](const Texel& given) {
                return Texel{word_of(formula(float_of(given[0]), float_of(given[1]), float_of(given[2]))), 0, 0, 0};
            }};
}

// Normal numbers from 2^-20 to 2^20, of either sign if `is_signed`, else positive.
std::uint32_t ordinary(RandomGenerator& random, bool is_signed) {
    const std::uint32_t mantissa = random.next() & 0x7fffffu;
    const auto exponent = static_cast<std::uint32_t>(107 + random.below(40));
    const std::uint32_t sign = is_signed ? random.next() & 0x80000000u : 0;
    return sign | exponent << 23 | mantissa;
}

// x, y and z of every texel. If `cancelling`, z is close to -x y, so that the rounding of the product has an effect.
std::vector<Texel> triples(std::uint64_t seed, bool is_signed, bool cancelling) {
    RandomGenerator random{seed};
    std::vector<Texel> all;
    for (int i = 0; i < 4096; ++i) {
        Texel t{};
        for (std::size_t k = 0; k < 3; ++k) t[k] = ordinary(random, is_signed);
        if (cancelling && i % 2 == 1) t[2] = word_of(-(float_of(t[0]) * float_of(t[1])) * 1.25f);
        all.push_back(t);
    }
    return all;
}

std::uint32_t small(RandomGenerator& random) {
    const std::uint32_t word = random.next();
    return (word & 0x807fffffu) | (word >> 28 & 3u) << 23;
}

// Numbers around the smallest normal one. For a product: one of them, and a factor from 1/2 to 2.
std::vector<Texel> small_pairs(bool product) {
    RandomGenerator random{771};
    std::vector<Texel> all;
    for (int i = 0; i < 1024; ++i) {
        const std::uint32_t a = small(random);
        const std::uint32_t b = product ? (random.next() & 0x80ffffffu) + 0x3f000000u : small(random);
        all.push_back({a, b, 0, 0});
    }
    return all;
}

float flushed(float value) { return std::fabs(value) < 0x1p-126f ? std::copysign(0.0f, value) : value; }
float positive_zero(float value) { return std::fabs(value) < 0x1p-126f ? 0.0f : value; }

float rounded_twice(float a, float b, float c) { return a * b + c; }
float fused(float a, float b, float c) { return std::fma(a, b, c); }
float quotient(float a, float b, float) { return a / b; }
float by_reciprocal(float a, float b, float) { return a * (1.0f / b); }
float reciprocal(float a, float, float) { return 1.0f / a; }
float root(float a, float, float) { return std::sqrt(a); }
float root_by_inverse(float a, float, float) { return a * (1.0f / std::sqrt(a)); }
float root_of_inverse(float a, float, float) { return 1.0f / (1.0f / std::sqrt(a)); }
// Both steps are in binary64, whose error is far below half a unit in the last place of binary32.
float inverse_root(float a, float, float) { return static_cast<float>(1.0 / std::sqrt(double{a})); }
float inverse_of_root(float a, float, float) { return 1.0f / std::sqrt(a); }
float root_of_reciprocal(float a, float, float) { return std::sqrt(1.0f / a); }

Operation operation(std::string name, std::string question, const std::string& expression, std::vector<Texel> inputs,
                    std::vector<Hypothesis> hypotheses) {
    Operation o{.name = std::move(name), .question = std::move(question), .inputs = std::move(inputs)};
    o.corners = whole_picture();
    o.programs = one_pass("highp float a = F(given.x), b = F(given.y), c = F(given.z); result = uvec4(U(" + expression +
                          "), 0u, 0u, 0u);");
    o.hypotheses = std::move(hypotheses);
    return o;
}

}  // namespace

void add_arithmetic(std::vector<Operation>& list) {
    list.push_back(operation("shader.mul-add", "is a * b + c contracted?", "a * b + c", triples(901, true, true),
                             {of("rounded twice", rounded_twice), of("fused", fused)}));
    list.push_back(operation("shader.mul-add-through-bits", "is a product that became bits contracted?",
                             "F(U(a * b)) + c", triples(902, true, true),
                             {of("rounded twice", rounded_twice), of("fused", fused)}));
    // GLSL 3.30 supports the keyword with an extension, GLSL ES 3.00 does not.
    Operation precise = operation("shader.mul-add-precise", "is a * b + c contracted where it is `precise`?", "exact",
                                  triples(907, true, true), {of("rounded twice", rounded_twice), of("fused", fused)});
    std::string& text = precise.programs.front().fragment;
    text.insert(text.find("result ="), "precise highp float exact = a * b + c; ");
    text.insert(0,
                "#ifdef GL_ES\n#error GLSL ES 3.00 has no precise\n#else\n"
                "#extension GL_ARB_gpu_shader5 : require\n#endif\n");
    list.push_back(std::move(precise));
    list.push_back(operation("shader.division", "how is a / b rounded?", "a / b", triples(903, true, false),
                             {of("correctly rounded", quotient), of("a * (1 / b)", by_reciprocal)}));
    list.push_back(operation("shader.reciprocal", "how is 1 / a rounded?", "1.0 / a", triples(904, true, false),
                             {of("correctly rounded", reciprocal)}));
    list.push_back(operation("shader.sqrt", "how is a square root rounded?", "sqrt(a)", triples(905, false, false),
                             {of("correctly rounded", root), of("a * (1 / sqrt(a))", root_by_inverse),
                              of("1 / (1 / sqrt(a))", root_of_inverse)}));
    list.push_back(operation("shader.inversesqrt", "how is an inverse square root rounded?", "inversesqrt(a)",
                             triples(906, false, false),
                             {of("correctly rounded", inverse_root), of("1 / sqrt(a), each rounded", inverse_of_root),
                              of("sqrt(1 / a), each rounded", root_of_reciprocal)}));
    list.push_back(operation(
        "shader.denormal-sums", "are denormals kept in a + b?", "a + b", small_pairs(false),
        {of("kept", [](float a, float b, float) { return a + b; }),
         of("flushed, before and after", [](float a, float b, float) { return flushed(flushed(a) + flushed(b)); }),
         of("flushed before", [](float a, float b, float) { return flushed(a) + flushed(b); }),
         of("flushed after", [](float a, float b, float) { return flushed(a + b); })}));
    list.push_back(
        operation("shader.denormal-products", "are denormals kept in a * b?", "a * b", small_pairs(true),
                  {of("kept", [](float a, float b, float) { return a * b; }),
                   of("flushed, before and after", [](float a, float b, float) { return flushed(flushed(a) * b); }),
                   of("flushed before", [](float a, float b, float) { return flushed(a) * b; }),
                   of("flushed to +0", [](float a, float b, float) { return positive_zero(flushed(a) * b); })}));
}

}  // namespace strata::probe
