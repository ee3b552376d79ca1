// Tests the lighting unit against the same sums in binary64, within the error of 14-bit numbers, and its flags against
// the table of pipeline/reference/fog-and-lighting.md 5.4.
#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/lighting/lighting_unit.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::rasterizer;
using namespace strata::pipeline;

using Double3 = std::array<double, 3>;

[[nodiscard]] Double3 wide(const Three& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] double dot_of(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
[[nodiscard]] Double3 unit_of(const Double3& v) {
    const double length = std::sqrt(dot_of(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}
[[nodiscard]] Double3 minus(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct Sums {
    Double3 primary, secondary{};
};

[[nodiscard]] double model_specular(const LightingRegisters& r, const LightRegisters& light, const Double3& normal,
                                    const Double3& direction, const Double3& position, double attenuation) {
    const auto& p = r.specular_params;
    double above = 0, below = 1;
    if (light.kind == LightKind::infinite && !r.has_local_eye) {
        const double s = dot_of(normal, wide(light.half_vector));
        above = s + double{p[0]};
        below = s * double{p[1]} + double{p[2]};
    } else {
        Double3 half = direction;
        const Double3 eye = unit_of({-position[0], -position[1], -position[2]});
        for (std::size_t i = 0; r.has_local_eye && i < 3; ++i) half[i] += eye[i];
        const double length = dot_of(half, half), s = std::max(dot_of(normal, half), 0.0);
        above = s * s + length * double{p[3]};
        below = s * s * double{p[4]} + length * double{p[5]};
    }
    return above < 0 ? 0 : above * attenuation / below;
}

[[nodiscard]] Sums model_lighting(const LightingRegisters& r, const UnlitVertex& v) {
    const Double3 position = wide(v.position), normal = wide(v.normal);
    Sums sums{wide(r.scene_ambient)};
    for (const LightRegisters& light : r.light) {
        if (light.kind == LightKind::off) continue;
        Double3 direction = wide(light.direction);
        double attenuation = 1;
        if (light.kind != LightKind::infinite) {
            const Double3 to = minus(wide(light.position), position);
            const double d = std::sqrt(dot_of(to, to));
            if (d > double{light.range}) continue;
            direction = unit_of(to);
            attenuation = 1 / (double{light.attenuation[0]} + double{light.attenuation[1]} * d +
                               double{light.attenuation[2]} * d * d);
        }
        if (light.kind == LightKind::spot) {
            const auto& [x, y, z, w] = light.spot_direction;
            const double c = std::clamp(dot_of(direction, {x, y, z}) + double{w}, 0.0, 1.0);
            const auto& f = light.spot_falloff;
            attenuation *= std::min(1.0, (c + double{f[0]}) / (c * double{f[1]} + double{f[2]}));
        }
        const double cosine = dot_of(normal, direction);
        const double shine = cosine < 0 ? 0 : model_specular(r, light, normal, direction, position, attenuation);
        for (std::size_t c = 0; c < 3; ++c) {
            sums.primary[c] +=
                attenuation * double{light.ambient[c]} + std::max(cosine, 0.0) * attenuation * double{light.diffuse[c]};
            (r.separates_specular ? sums.secondary : sums.primary)[c] += shine * double{light.specular[c]};
        }
    }
    return sums;
}

[[nodiscard]] Three random_three(Random& random, float low, float high) {
    return {random_float(random, low, high), random_float(random, low, high), random_float(random, low, high)};
}
[[nodiscard]] Three random_unit(Random& random) {
    const Double3 u = unit_of(wide(random_three(random, -1, 1)));
    return {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])};
}

[[nodiscard]] LightRegisters random_light(Random& random) {
    LightRegisters light;
    light.kind = static_cast<LightKind>(random_int(random, 1, 3));
    light.ambient = random_three(random, 0, 0.1f);
    light.diffuse = random_three(random, 0, 0.3f);
    light.specular = random_three(random, 0, 0.3f);
    light.direction = random_unit(random);
    light.half_vector = random_unit(random);
    light.position = random_three(random, -5, 5);
    light.range = random_float(random, 3, 12);
    light.attenuation = {random_float(random, 0.5f, 1), random_float(random, 0, 0.3f), random_float(random, 0, 0.1f)};
    const Three axis = random_unit(random);
    light.spot_direction = {2 * axis[0], 2 * axis[1], 2 * axis[2], -0.5f};
    light.spot_falloff = {-0.170208f, -0.855843f, 1.685635f};
    return light;
}

}  // namespace

TEST_CASE("lit colours are those of exact sums within a code, but for cosines and distances next to a limit") {
    Random random{341};
    std::size_t far = 0, checked = 0, bright = 0;
    for (int k = 0; k < 4000; ++k) {
        LightingRegisters r;
        r.is_enabled = r.has_specular = true;
        r.separates_specular = k % 2 == 0;
        r.has_local_eye = k % 3 == 0;
        r.scene_ambient = random_three(random, 0, 0.1f);
        r.specular_params = {-0.421539f, -1.70592f, 2.28438f, -0.170208f, -0.855842f, 1.68563f};
        for (std::size_t i = 0; i < static_cast<std::size_t>(k % 3 + 1); ++i) r.light[i] = random_light(random);
        UnlitVertex v;
        v.position = random_three(random, -3, 3);
        v.normal = random_unit(random);
        const LitColors lit = light_vertex(r, v);
        const Sums sums = model_lighting(r, v);
        for (std::size_t c = 0; c < 3; ++c) {
            const double primary = std::clamp(sums.primary[c], 0.0, 1.0),
                         secondary = std::clamp(sums.secondary[c], 0.0, 1.0);
            far += std::fabs(double{lit.primary[c]} - primary) > 1.6 / 255 ? 1 : 0;
            far += std::fabs(double{lit.secondary[c]} - secondary) > 1.6 / 255 ? 1 : 0;
            bright += primary > 0.2 ? 1 : 0;
            checked += 2;
        }
    }
    INFO(far << " of " << checked);
    CHECK(far < checked / 200);
    CHECK(bright > checked / 20);
}

TEST_CASE("beyond its range a light gives nothing, and at its range all") {
    LightingRegisters r;
    r.is_enabled = true;
    r.light[0].kind = LightKind::local;
    r.light[0].ambient = {0.5f, 0.5f, 0.5f};
    r.light[0].position = {0, 0, 4};
    const UnlitVertex v{{0, 0, 0}, {0, 0, 1}, {}, {}};
    r.light[0].range = 4;
    // The reciprocal of the attenuation 1 is 8191 / 8192.
    CHECK(light_vertex(r, v).primary[0] == 127.0f / 255.0f);
    r.light[0].range = 3.999f;
    CHECK(light_vertex(r, v).primary[0] == 0.0f);
}

TEST_CASE("a surface turned away has neither diffuse nor specular light, but ambient light") {
    LightingRegisters r;
    r.is_enabled = r.has_specular = true;
    r.light[0].kind = LightKind::infinite;
    r.light[0].direction = r.light[0].half_vector = {0, 0, 1};
    r.light[0].diffuse = r.light[0].specular = {1, 1, 1};
    r.light[0].ambient = {0, 0.25f, 0};
    r.specular_params = {0, -0.494592f, 1.49459f, 0, -0.494592f, 1.49459f};
    const LitColors away = light_vertex(r, {{}, {0, 0, -1}, {}, {}}), toward = light_vertex(r, {{}, {0, 0, 1}, {}, {}});
    CHECK(away.primary[0] == 0.0f);
    CHECK(away.primary[1] == 64.0f / 255.0f);
    CHECK(toward.primary[0] == 1.0f);
}

TEST_CASE("colours of the vertex take the place of scene ambient, or are factors of the lights") {
    const UnlitVertex v{{}, {0, 0, 1}, {0.5f, 0.25f, 1, 0.5f}, {0.25f, 1, 0.5f, 0.125f}};
    LightingRegisters r;
    r.is_enabled = true;
    r.scene_ambient = {0.125f, 0.125f, 0.125f};
    r.material_emission = {0.5f, 0.5f, 0.5f};
    const auto byte = [](double value) { return static_cast<float>(std::floor(value * 255 + 0.5)) / 255.0f; };
    r.emission = MaterialSource::vertex_diffuse;
    CHECK(light_vertex(r, v).primary[0] == byte(0.125 + 0.5 * 0.5));
    r.ambient = MaterialSource::vertex_diffuse;
    CHECK(light_vertex(r, v).primary[0] == byte(0.5 + 0.5 * 0.5));
    r.emission = MaterialSource::constant;
    CHECK(light_vertex(r, v).primary[0] == byte(0.125 + 0.5 * 0.5));
    r.material_emission = {};
    r.light[0].kind = LightKind::infinite;
    r.light[0].direction = {0, 0, 1};
    r.light[0].diffuse = {0.5f, 0.5f, 0.5f};
    r.diffuse = MaterialSource::vertex_specular;
    CHECK(light_vertex(r, v).primary[2] == byte(0.125 + 0.5 * 0.5));
}

TEST_CASE("the secondary colour and the alphas follow the flags") {
    const UnlitVertex v{{}, {0, 0, 1}, {0.5f, 0.25f, 1, 0.5f}, {0.25f, 1, 0.5f, 0.125f}};
    LightingRegisters r;
    r.material_alpha = 0.75f;
    using Four = std::array<float, 4>;
    CHECK(light_vertex(r, v).primary == Four{128 / 255.0f, 64 / 255.0f, 1, 128 / 255.0f});
    CHECK(light_vertex(r, v).secondary == Four{0, 0, 0, 1});
    r.has_specular = true;
    CHECK(light_vertex(r, v).secondary == Four{64 / 255.0f, 1, 128 / 255.0f, 1});
    r.has_specular_alpha = true;
    CHECK(light_vertex(r, v).secondary[3] == 32 / 255.0f);
    r.is_enabled = true;
    CHECK(light_vertex(r, v).primary == Four{0, 0, 0, 191 / 255.0f});
    CHECK(light_vertex(r, v).secondary == Four{64 / 255.0f, 1, 128 / 255.0f, 32 / 255.0f});
    r.separates_specular = true;
    CHECK(light_vertex(r, v).secondary == Four{0, 0, 0, 32 / 255.0f});
}
