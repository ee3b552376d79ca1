// tools/probe/operations_conversions.cpp - floats that become integers, halves and sRGB bytes.
#include <cmath>

#include "pipeline/formats/half.h"
#include "scenes/numbers/srgb_encode.h"
#include "tools/probe/operation_numbers.h"

namespace strata::probe {

namespace {

constexpr double below_int = -2147483648.0, above_int = 2147483648.0;

// Numbers of every size and sign, the ends of the integers' range, infinities and NaN.
std::vector<Words> floats_of_all_sizes() {
    std::vector<Words> inputs;
    Dice dice{21};
    for (int i = 0; i < 512; ++i) {
        const auto exponent = static_cast<std::uint32_t>(127 - 2 + dice.below(40));
        inputs.push_back({(dice.next() & 0x807fffffu) | exponent << 23, 0, 0, 0});
    }
    for (const std::uint32_t word :
         {0u, 0x80000000u, 0x4effffffu, 0x4f000000u, 0xcf000000u, 0xcf000001u, 0x4f7fffffu, 0x4f800000u, 0x7f800000u,
          0xff800000u, 0x7fc00000u, 0xffc00000u, 0xbf000000u, 0xbf800000u})
        inputs.push_back({word, 0, 0, 0});
    return inputs;
}

std::uint32_t cut(double v) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(v)); }

// v as an int, if it is one; else what `beyond` gives of it.
template <class Beyond>
Hypothesis int_rule(const char* name, Beyond&& beyond) {
    return rule(name, [beyond](const Words& a) {
        const double v = double{as_float(a[0])}, whole = std::trunc(v);
        return whole >= below_int && whole < above_int ? cut(whole) : beyond(v);
    });
}

Operation to_integer() {
    return {.name = "float-to-int",
            .asks = "what int(x) makes of NaN and of what no int holds",
            .body =
                "highp uvec4 operation(highp uvec4 a) {\n"
                "    return uvec4(uint(int(uintBitsToFloat(a.x))), 0u, 0u, 0u);\n}\n",
            .inputs = floats_of_all_sizes(),
            .hypotheses = {
                int_rule("the nearest int, NaN is 0",
                         [](double v) { return std::isnan(v) ? 0u
                                               : v < 0       ? 0x80000000u
                                                             : 0x7fffffffu; }),
                int_rule("-2^31 for all of them", [](double) { return 0x80000000u; }),
                int_rule("the nearest int, NaN is -2^31", [](double v) { return v > 0 ? 0x7fffffffu : 0x80000000u; })}};
}

// Every half's neighbourhood: the middle between two of them and a unit beside it.
std::vector<Words> beside_halves() {
    std::vector<Words> inputs;
    for (std::uint32_t half = 0x0001; half < 0x7c00; half += 61) {
        const std::uint32_t middle =
            as_word(0.5f * (pipeline::half_to_float(static_cast<std::uint16_t>(half)) +
                            pipeline::half_to_float(static_cast<std::uint16_t>(half + (half < 0x7bff ? 1 : 0)))));
        for (const std::uint32_t word : {middle - 1, middle, middle + 1})
            inputs.push_back({word, word | 0x80000000u, 0, 0});
    }
    return inputs;
}

Operation to_half() {
    const auto packed = [](pipeline::HalfRounding rounding) {
        return [rounding](const Words& a) {
            const std::uint32_t low = pipeline::to_half(as_float(a[0]), rounding);
            return low | std::uint32_t{pipeline::to_half(as_float(a[1]), rounding)} << 16;
        };
    };
    return {.name = "pack-half",
            .asks = "how packHalf2x16 rounds",
            .body =
                "highp uvec4 operation(highp uvec4 a) {\n"
                "    return uvec4(packHalf2x16(uintBitsToFloat(a.xy)), 0u, 0u, 0u);\n}\n",
            .inputs = beside_halves(),
            .hypotheses = {rule("to the nearest, ties to even", packed(pipeline::HalfRounding::nearest_even)),
                           rule("toward zero", packed(pipeline::HalfRounding::toward_zero))}};
}

// Linear values at which the nearest code changes, and their neighbours.
std::vector<Words> between_codes() {
    std::vector<Words> inputs;
    for (int code = 0; code < 255; ++code) {
        std::uint32_t low = 0, high = as_word(1.0f);  // the least float that becomes more than `code`
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            if (scenes::encode_srgb8(as_float(middle)) > code)
                high = middle;
            else
                low = middle + 1;
        }
        const std::uint32_t step = low / 4096 / 16 + 1;
        for (const std::uint32_t word : {low - 1, low, low - step, low + step})
            inputs.push_back({word, word, word, as_word(1.0f)});
    }
    return inputs;
}

Operation to_srgb() {
    return {.name = "store-srgb",
            .asks = "the bytes of an sRGB target",
            .body = "highp uvec4 operation(highp uvec4 a) { return a; }\n",
            .inputs = between_codes(),
            .lanes = 3,
            .into_srgb = true,
            .hypotheses = {{"the nearest code of the exact curve", [](const Words& a) {
                                const auto code = [&](std::size_t c) {
                                    return std::uint32_t{scenes::encode_srgb8(as_float(a[c]))};
                                };
                                return Words{code(0), code(1), code(2), 255};
                            }}}};
}

}  // namespace

void add_conversions(std::vector<Operation>& all) {
    all.push_back(to_integer());
    all.push_back(to_half());
    all.push_back(to_srgb());
}

}  // namespace strata::probe
