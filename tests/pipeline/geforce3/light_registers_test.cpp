// Tests the lighting registers for a scene's lights: quotients at the places that define them, and vertices lit by them
// against OpenGL's light. pipeline/reference/lighting.md 4.
#include "pipeline/lighting/light_registers.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/vertices/vertex_light.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::pipeline;
using rasterizer::Random;
using rasterizer::random_float;

[[nodiscard]] double quotient(const Three& k, double s) {
    return (s + double{k[0]}) / (s * double{k[1]} + double{k[2]});
}

[[nodiscard]] double falloff(const LightRegisters& light, double cosine) {
    const double length =
        std::hypot(double{light.spot_direction[0]}, double{light.spot_direction[1]}, double{light.spot_direction[2]});
    const double x = std::clamp(cosine * length + double{light.spot_direction[3]}, 0.0, 1.0);
    const double under = x * double{light.spot_falloff[1]} + double{light.spot_falloff[2]};
    return x == 0 ? 0 : std::min(1.0, (x + double{light.spot_falloff[0]}) / under);
}

[[nodiscard]] VertexLight light_of(const Lighting& lighting, const View& view, const Matrix& model) {
    return {frame_lights(&lighting, view), view, model};
}

[[nodiscard]] LightRegisters spot(float cutoff, float exponent) {
    const Lighting lighting{
        {{.type = LightType::spot, .direction = {0, 0, -2}, .cutoff = cutoff, .exponent = exponent}}, {}};
    return light_registers(in_eye_space(lighting, identity)).light[0];
}

}  // namespace

TEST_CASE("a power's quotient is 1, a half and a quarter where the power is, and never far from it") {
    for (const float n : {0.25f, 1.0f, 2.0f, 10.0f, 32.0f, 128.0f}) {
        const Three k = power_quotient(n);
        INFO("power " << n);
        CHECK(quotient(k, 1) == Approx(1).epsilon(1e-5));
        CHECK(quotient(k, std::pow(0.5, 1.0 / double{n})) == Approx(0.5).epsilon(1e-3));
        CHECK(quotient(k, std::pow(0.25, 1.0 / double{n})) == Approx(0.25).epsilon(1e-3));
        double worst = 0;
        for (double s = 0; s <= 1; s += 0x1p-10)
            worst = std::max(worst, std::fabs(std::max(quotient(k, s), 0.0) - std::pow(s, double{n})));
        CHECK(worst < (n < 1 ? 0.23 : 0.07));
    }
    CHECK(power_quotient(0) == Three{0, 1, 0});
}

TEST_CASE("a spot is full on its axis, OpenGL's in the middle, and dark from its cutoff on") {
    constexpr double degree = M_PI / 180;
    for (const float exponent : {0.0f, 1.0f, 16.0f}) {
        const LightRegisters light = spot(20, exponent);
        const double edge = 1 - std::cos(20 * degree);
        INFO("exponent " << exponent);
        CHECK(falloff(light, 1) == Approx(1).epsilon(1e-5));
        CHECK(falloff(light, 1 - edge / 2) == Approx(std::pow(1 - edge / 2, double{exponent})).epsilon(1e-5));
        CHECK(falloff(light, std::cos(20.1 * degree)) == 0);
        CHECK(falloff(light, 0.25) == 0);
    }
    CHECK(falloff(spot(20, 0), std::cos(19.9 * degree)) == Approx(1).epsilon(1e-5));
    CHECK(falloff(spot(1e-30f, 0), 1) == 1);
    // 1/16 of the power 64 is at 16.8 degrees, inside the cone of 80.
    CHECK(falloff(spot(80, 64), std::cos(15 * degree)) > 0);
    CHECK(falloff(spot(80, 64), std::cos(17 * degree)) == 0);
}

TEST_CASE("diffuse light by the registers is OpenGL's within two codes") {
    Random random{60};
    std::size_t far = 0, checked = 0, bright = 0;
    for (int k = 0; k < 3000; ++k) {
        const auto part = [&](float low, float high) { return random_float(random, low, high); };
        const auto vec = [&](float low, float high) { return Vec3{part(low, high), part(low, high), part(low, high)}; };
        Lighting lighting{{}, {.ambient = vec(0, 0.2f), .emission = vec(0, 0.1f)}};
        for (int i = 0; i < 3; ++i)
            lighting.lights.push_back({.type = i == 0 ? LightType::directional : LightType::point,
                                       .ambient = vec(0, 0.1f),
                                       .diffuse = vec(0, 0.5f),
                                       .position = vec(-4, 4),
                                       .direction = vec(-1, 1),
                                       .attenuation = {1, part(0, 0.3f), part(0, 0.1f)}});
        const Vec3 position = vec(-1, 1), normal = vec(-1, 1);
        const Rgba color{part(0, 1), part(0, 1), part(0, 1), 1};
        const auto lit = [&](LightingRule rule) {
            lighting.rule = rule;
            return light_of(lighting, {}, identity)(position, 1, normal, color, color).front.primary;
        };
        const Three single = lit(LightingRule::single), chip = lit(LightingRule::float22);
        for (std::size_t c = 0; c < 3; ++c) {
            far += std::fabs(double{single[c]} - double{chip[c]}) > 2.0 / 255 ? 1 : 0;
            bright += single[c] > 0.1f ? 1 : 0;
            ++checked;
        }
    }
    INFO(far << " of " << checked);
    CHECK(far < checked / 200);
    CHECK(bright > checked / 4);
}
