// tools/probe/operations_packing.cpp - operations in which a shader packs floats into the halves of a word.
#include <algorithm>
#include <cmath>

#include "pipeline/formats/half.h"
#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

// GLSL 3.30 supports the functions with an extension.
constexpr auto packing = "#ifndef GL_ES\n#extension GL_ARB_shading_language_packing : require\n#endif\n";

// Two numbers per texel: middles between two codes and values slightly off them, both ends of the range and values
// beyond.
std::vector<Texel> beside_codes(int greatest, bool is_signed) {
    RandomGenerator random{841};
    const auto one = [&] {
        const double code = random.below(greatest) + 0.25 * random.below(4) + 0x1p-8 * (random.below(3) - 1);
        const auto value = static_cast<float>(code / greatest * (random.below(8) == 0 ? 1.5 : 1.0));
        return is_signed && random.below(2) == 0 ? -value : value;
    };
    std::vector<Texel> all;
    for (int i = 0; i < 1024; ++i) {
        const float a = one();
        all.push_back({word_of(a), word_of(one()), 0, 0});
    }
    return all;
}

// For every exponent of a half and some beyond: numbers at, near and between halves.
std::vector<Texel> beside_halves() {
    RandomGenerator random{842};
    const auto one = [&] {
        const double mantissa = 1.0 + random.below(2048) / 2048.0 + 0x1p-20 * (random.below(3) - 1);
        const auto value = static_cast<float>(std::ldexp(mantissa, random.below(46) - 28));
        return random.below(2) == 0 ? value : -value;
    };
    std::vector<Texel> all;
    for (int i = 0; i < 1024; ++i) {
        const float a = one();
        all.push_back({word_of(a), word_of(one()), 0, 0});
    }
    return all;
}

using Code = std::uint32_t (*)(float);

Operation operation(std::string name, std::string question, const std::string& function, std::vector<Texel> inputs) {
    Operation o{.name = std::move(name), .question = std::move(question), .inputs = std::move(inputs)};
    o.result = ResultKind::words;
    o.corners = whole_picture();
    o.programs = one_pass("result = uvec4(" + function + "(vec2(F(given.x), F(given.y))), 0u, 0u, 0u);");
    o.programs.front().fragment.insert(0, packing);
    return o;
}

void add(Operation& o, std::string name, Code code) {
    o.hypotheses.push_back({std::move(name), [code](const Texel& given) {
                                return one_word((code(float_of(given[0])) & 0xffffu) | code(float_of(given[1])) << 16);
                            }});
}

enum class Step : std::uint8_t { even, up, away, cut };

template <int greatest, Step step, bool is_exact = false>
std::uint32_t scaled(float value) {
    const float clamped = std::clamp(value, greatest == 32767 ? -1.0f : 0.0f, 1.0f);
    const double product = is_exact ? double{clamped} * greatest : double{clamped * greatest};
    const double code = step == Step::even   ? std::nearbyint(product)
                        : step == Step::up   ? std::floor(product + 0.5)
                        : step == Step::away ? std::round(product)
                                             : std::trunc(product);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(code));
}

template <pipeline::HalfRounding rounding>
std::uint32_t half_code(float value) {
    return pipeline::to_half<rounding>(value);
}
// A float's half, with denormals flushed to 0.
template <pipeline::HalfRounding rounding>
std::uint32_t normal_half_code(float value) {
    const std::uint32_t code = half_code<rounding>(value);
    return (code & 0x7c00u) == 0 ? code & 0x8000u : code;
}

// Conversion by shifts: bits shifted out of a denormal are ignored by the rounding, and numbers from 65,536 on have the
// exponent 31 with any mantissa, until those from 131,008 on are all ones.
std::uint32_t half_code_by_shifts(float value) {
    const std::uint32_t word = word_of(value), size = word & 0x7fffffffu, places = 113u - (size >> 23);
    const bool is_normal = size > 0x38800000u;
    const std::uint32_t denormal = places < 24 ? ((size & 0x7fffffu) | 0x800000u) >> places : 0;
    const std::uint32_t base = is_normal ? size : denormal, rebias = is_normal ? 0xc8000000u : 0;
    const std::uint32_t code = (base + rebias + 0xfffu + (base >> 13 & 1u)) >> 13;
    return (word >> 31 << 15) | code | (size > 0x47ffefffu ? 0x7fffu : 0);
}

}  // namespace

void add_packing(std::vector<Operation>& list) {
    constexpr int most = 65535, most_signed = 32767;
    Operation unorm =
        operation("shader.pack-unorm", "how does packUnorm2x16 round?", "packUnorm2x16", beside_codes(most, false));
    add(unorm, "nearest even of the binary32 product", scaled<most, Step::even>);
    add(unorm, "a half up of the binary32 product", scaled<most, Step::up>);
    add(unorm, "cut", scaled<most, Step::cut>);
    add(unorm, "nearest of the exact product", scaled<most, Step::even, true>);
    list.push_back(std::move(unorm));
    Operation snorm = operation("shader.pack-snorm", "how does packSnorm2x16 round?", "packSnorm2x16",
                                beside_codes(most_signed, true));
    add(snorm, "nearest even of the binary32 product", scaled<most_signed, Step::even>);
    add(snorm, "a half up of the binary32 product", scaled<most_signed, Step::up>);
    add(snorm, "a half away from 0 of the binary32 product", scaled<most_signed, Step::away>);
    add(snorm, "toward 0", scaled<most_signed, Step::cut>);
    add(snorm, "nearest of the exact product", scaled<most_signed, Step::even, true>);
    list.push_back(std::move(snorm));
    Operation half = operation("shader.pack-half", "how does packHalf2x16 round?", "packHalf2x16", beside_halves());
    add(half, "nearest even", half_code<pipeline::HalfRounding::nearest_even>);
    add(half, "toward 0", half_code<pipeline::HalfRounding::toward_zero>);
    add(half, "nearest even, denormals are 0", normal_half_code<pipeline::HalfRounding::nearest_even>);
    add(half, "nearest even by shifts, infinity is not made", half_code_by_shifts);
    list.push_back(std::move(half));
}

}  // namespace strata::probe
