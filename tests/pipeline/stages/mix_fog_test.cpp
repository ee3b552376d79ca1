// Tests OpenGL's fog: the exponential against 50 decimals, factors and mixes against the formulas of GL 2.1 3.10 with
// every operation rounded in rationals, and NV2A's registers against the same factor.
#include "pipeline/stages/mix_fog.h"

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <catch2/catch.hpp>
#include <memory>

#include "pipeline/device/profile.h"
#include "pipeline/lighting/fog_unit.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::rasterizer;
using pipeline::Fog;
using pipeline::FogMode;
using pipeline::FogRule;
using Decimal50 = boost::multiprecision::cpp_dec_float_50;

[[nodiscard]] Rational as_rational(const Decimal50& v) {
    const Integer scaled = Decimal50{v * pow(Decimal50{2}, 200)}.convert_to<Integer>();
    return Rational{scaled} * power(-200);
}

// Nearest binary32 of exp(-x).
[[nodiscard]] float model_exp(double x) { return nearest_float(as_rational(exp(-Decimal50{x}))); }

[[nodiscard]] float model_factor_of(const Fog& fog, float c) {
    Rounded f;
    const Rounded product = Rounded{fog.density} * Rounded{c};
    switch (fog.mode) {
        case FogMode::linear: f = (Rounded{fog.end} - Rounded{c}) / (Rounded{fog.end} - Rounded{fog.start}); break;
        case FogMode::exp: f.v = model_exp(double{product.v}); break;
        case FogMode::exp2: f.v = model_exp(double{product.v} * double{product.v}); break;
    }
    return f.v < 0 ? 0 : f.v > 1 ? 1 : f.v;
}

}  // namespace

TEST_CASE("the exponential is the nearest binary32, for numbers over its whole range") {
    Random random{331};
    std::size_t wrong = 0;
    for (int k = 0; k < 20000; ++k) {
        const double x = double{random_float(random, 0, k % 2 == 0 ? 90.0f : 2.0f)};
        wrong += pipeline::exp_of_negative(x) != model_exp(x) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(pipeline::exp_of_negative(0) == 1.0f);
    CHECK(pipeline::exp_of_negative(1e300) == 0.0f);
    CHECK(pipeline::exp_of_negative(104) == 0.0f);
}

TEST_CASE("the fog factor is OpenGL's, each operation rounded once") {
    Random random{332};
    std::size_t wrong = 0;
    for (int k = 0; k < 6000; ++k) {
        const Fog fog{.mode = static_cast<FogMode>(k % 3),
                      .start = random_float(random, 0, 5),
                      .end = random_float(random, 6, 20),
                      .density = random_float(random, 0, 1),
                      .color = {}};
        const float c = random_float(random, 0, 25);
        wrong += pipeline::fog_factor(fog, c) != model_factor_of(fog, c) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a fogged colour is f C + (1 - f) Cf, and alpha stays") {
    Random random{333};
    const Fog fog{.mode = FogMode::exp, .start = 0, .end = 1, .density = 0.25f, .color = {0.5f, 0.25f, 0.75f, 0.1f}};
    const auto batch = std::make_unique<FragmentBatch>();
    batch->count = batch_capacity;
    for (std::size_t i = 0; i < batch_capacity; ++i) {
        batch->fog[i] = random_float(random, 0, 12);
        for (auto& channel : batch->color) channel[i] = random_float(random, 0, 1);
    }
    const FragmentBatch before = *batch;
    pipeline::mix_fog(fog, FogRule::single, *batch);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < batch_capacity; ++i) {
        const Rounded f{model_factor_of(fog, before.fog[i])};
        for (std::size_t c = 0; c < 3; ++c) {
            const Rounded mixed = f * Rounded{before.color[c][i]} + (Rounded{1} - f) * Rounded{fog.color[c]};
            wrong += mixed.v != batch->color[c][i] ? 1 : 0;
        }
        wrong += before.color[3][i] != batch->color[3][i] ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("by bytes the mix is the integer nearest to the exact one, and the factor within two of OpenGL's") {
    Random random{334};
    const auto batch = std::make_unique<FragmentBatch>();
    std::size_t wrong = 0, far = 0;
    for (int k = 0; k < 3; ++k) {
        const Fog fog{
            .mode = static_cast<FogMode>(k), .start = 1, .end = 9, .density = 0.3f, .color = {51.0f / 255, 1, 0, 1}};
        const pipeline::FogRegisters registers = pipeline::fog_registers(fog);
        batch->count = batch_capacity;
        std::array<std::array<int, 3>, batch_capacity> code{};
        for (std::size_t i = 0; i < batch_capacity; ++i) {
            const float distance = random_float(random, 0, 10);
            batch->fog[i] = pipeline::vertex_fog(fog, FogRule::bytes, distance);
            const double f = double{model_factor_of(fog, distance)} * 255;
            far += std::fabs(f - pipeline::fog_factor(registers, batch->fog[i])) > 2 ? 1 : 0;
            for (std::size_t c = 0; c < 3; ++c) {
                code[i][c] = random_int(random, 0, 255);
                batch->color[c][i] = static_cast<float>(code[i][c]) / 255.0f;
            }
        }
        pipeline::mix_fog(fog, FogRule::bytes, *batch);
        constexpr std::array fog_code{51, 255, 0};
        for (std::size_t i = 0; i < batch_capacity; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const int f = pipeline::fog_factor(registers, batch->fog[i]);
                const Rational exact{f * code[i][c] + (255 - f) * fog_code[c], 255};
                const Integer nearest = floor(exact + Rational{1, 2});
                wrong += batch->color[c][i] != nearest_float(Rational{nearest, 255}) ? 1 : 0;
            }
    }
    CHECK(wrong == 0);
    CHECK(far == 0);
}
