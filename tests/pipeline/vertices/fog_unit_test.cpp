// Tests the fog of NV2A: factors against rationals and the formulas of pipeline/reference/fog-and-lighting.md 2, tables
// against powers of two by long multiplication, and special values against the list there.
#include "pipeline/lighting/fog_unit.h"

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::rasterizer;
using pipeline::FogFunction;
using pipeline::FogRegisters;
using Decimal = boost::multiprecision::cpp_dec_float_50;

constexpr FogFunction functions[] = {FogFunction::linear,  FogFunction::linear_abs, FogFunction::exp,
                                     FogFunction::exp_abs, FogFunction::exp2,       FogFunction::exp2_abs};

[[nodiscard]] std::int32_t model_byte(const Decimal& v) { return (255 * v + Decimal{0.5}).convert_to<std::int32_t>(); }

[[nodiscard]] std::array<std::int32_t, 33> model_table(bool is_square) {
    std::array<std::int32_t, 33> table{};
    for (int k = 0; k < 33; ++k) {
        const Decimal x = is_square ? Decimal{8} * k * k / 1024 : Decimal{k} / 4;
        table[static_cast<std::size_t>(k)] = model_byte(pow(Decimal{2}, -x));
    }
    return table;
}

// The formulas in rationals; v is finite.
[[nodiscard]] std::int32_t model_factor(const FogRegisters& fog, float v) {
    const bool is_square = fog.function == FogFunction::exp2 || fog.function == FogFunction::exp2_abs;
    if (pipeline::is_linear(fog.function)) {
        Rational x{v};
        if (fog.function == FogFunction::linear_abs) x = abs(x);
        const Rational f = Rational{fog.bias} + Rational{fog.multiplier} * x - 1;
        const Integer code = floor(std::min<Rational>(std::max<Rational>(f, 0), 1) * 4096);
        return ((code - code / 256) / 16).convert_to<std::int32_t>();
    }
    Integer p = -floor((Rational{v} - Rational{3, 2}) * 4096);
    if (fog.function == FogFunction::exp && p <= 0) return 255;
    if (p < 0) p = -p;
    if (p >= 2048) return 0;
    static const auto tables = std::array{model_table(false), model_table(true)};
    const auto& t = tables[is_square ? 1 : 0];
    const int step = p.convert_to<int>(), k = step / 64, r = step % 64;
    return (t[static_cast<std::size_t>(k)] * (64 - r) + t[static_cast<std::size_t>(k) + 1] * r + 32) / 64;
}

}  // namespace

TEST_CASE("the fog tables are the powers of two rounded to bytes") {
    CHECK(pipeline::fog_table::exp == model_table(false));
    CHECK(pipeline::fog_table::exp2 == model_table(true));
}

TEST_CASE("the fog factor follows its formula at every step of the tables and at random values") {
    Random random{321};
    std::size_t wrong = 0;
    std::array<bool, 256> seen{};
    for (const FogFunction function : functions) {
        const FogRegisters fog{function, 1.25f, -0.75f, {}};
        const auto check = [&](float v) {
            const std::int32_t factor = fog_factor(fog, v);
            wrong += factor != model_factor(fog, v) ? 1 : 0;
            seen[static_cast<std::size_t>(factor)] = true;
        };
        for (int step = -2100; step <= 2100; ++step)
            for (const float nudge : {-0x1p-20f, 0.0f, 0x1p-20f})
                check(1.5f + static_cast<float>(step) * 0x1p-12f + nudge);
        for (int k = 0; k < 5000; ++k) check(random_float(random, -4, 4));
        for (const float v : {-1e30f, 1e30f, -0.0f, 0x1p-126f, pipeline::float22::largest}) check(v);
    }
    CHECK(wrong == 0);
    CHECK(std::ranges::count(seen, true) > 250);
}

TEST_CASE("the value of a vertex is the rounded coordinate, or a dot product of 22-bit floats") {
    namespace f22 = pipeline::float22;
    CHECK(pipeline::vertex_fog({FogFunction::linear, 0, 0, {}}, 1.00006103515625f) == 1.0001220703125f);
    // Not up to 1: this is 0.99999833, and eight ones stay.
    CHECK(pipeline::vertex_fog({FogFunction::linear, 0, 0, {}}, 0x1.ffffc8p-1f) == 0x1.fff8p-1f);
    // 1.5 + (-1/16) (1 + 2^-13): the product has 14 bits, of which the sum keeps those above 2^-18, and then 2^-13.
    CHECK(pipeline::vertex_fog({FogFunction::exp, 1.5f, -0.0625f, {}}, 1.0001220703125f) ==
          f22::sum<2>({1.5f, -0.0625f * 1.0001220703125f}));
    CHECK(pipeline::vertex_fog({FogFunction::exp, 1.5f, -0.0625f, {}}, 1.0f) == 1.4375f);
}

TEST_CASE("infinite fog coordinates and NaN have the factors that the chip shows") {
    constexpr float inf = pipeline::float22::infinity, nan = pipeline::float22::not_a_number;
    for (const FogFunction function : functions)
        for (const float coordinate : {inf, -inf, nan})
            for (const float multiplier : {1.0f, -1000.0f}) {
                const FogRegisters fog{function, -1.0f, multiplier, {}};
                const bool is_clear = pipeline::is_linear(function) || function == FogFunction::exp;
                CHECK(fog_factor(fog, vertex_fog(fog, coordinate)) == (is_clear ? 255 : 0));
            }
    // Infinity times 0 is 0: the bias alone remains.
    const FogRegisters none{FogFunction::exp2, 1.5f, 0.0f, {}};
    CHECK(fog_factor(none, vertex_fog(none, inf)) == 255);
    CHECK(fog_factor(none, vertex_fog(none, nan)) == 0);
}
