// Tests OpenGL's light of vertices against its equations in binary64 with a bound of the rounding errors, and by what
// must hold of any lights: turned scenes, sides, mirrors. GL 2.1 2.14.1; pipeline/reference/lighting.md 2 and 3.
#include "pipeline/vertices/vertex_light.h"

#include <catch2/catch.hpp>
#include <optional>

#include "pipeline/vertices/matrix.h"
#include "tests/pipeline/lighting/bounded.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::pipeline;
using namespace strata::testing;
using rasterizer::Random;
using rasterizer::random_float;
using rasterizer::random_int;

using Vector = std::array<Bounded, 3>;

[[nodiscard]] Bounded exactly(double v) { return {v, 0}; }
[[nodiscard]] Vector vector_of(const Vec3& v) { return {exactly(v.x), exactly(v.y), exactly(v.z)}; }
[[nodiscard]] Bounded dot(const Vector& a, const Vector& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }
[[nodiscard]] Vector divided(const Vector& v, const Bounded& by) { return {v[0] / by, v[1] / by, v[2] / by}; }
[[nodiscard]] Vector unit(const Vector& v) { return divided(v, root(dot(v, v))); }
[[nodiscard]] Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
[[nodiscard]] Vector negative(const Vector& v) { return {-v[0], -v[1], -v[2]}; }

// The upper 3 x 3 of a matrix times a vector, as reals.
[[nodiscard]] std::array<double, 3> turned(const Matrix& m, const Vec3& v) {
    std::array<double, 3> out{};
    for (std::size_t r = 0; r < 3; ++r) out[r] = m[0][r] * double{v.x} + m[1][r] * double{v.y} + m[2][r] * double{v.z};
    return out;
}
[[nodiscard]] Vector once_each(const std::array<double, 3>& v) { return {once(v[0]), once(v[1]), once(v[2])}; }
[[nodiscard]] Vector unit_once(const std::array<double, 3>& v, double sign) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * sign;
    return once_each({v[0] / length, v[1] / length, v[2] / length});
}

// What the equations ask of a vertex: its place and normal in eye space.
struct EyeVertex {
    Vector position, normal;
};
[[nodiscard]] EyeVertex eye_vertex(const Matrix& to_eye, const Vec3& position, const Vec3& normal) {
    EyeVertex eye;
    const auto cofactors = cofactors_of(to_eye);
    const double sign = linear_determinant(to_eye) < 0 ? -1 : 1;
    const Vector n = vector_of(normal), p = vector_of(position);
    Vector world{};
    for (std::size_t r = 0; r < 3; ++r) {
        const auto c = [&](std::size_t k) { return once(sign * cofactors[3 * k + r]); };
        world[r] = (c(0) * n[0] + c(1) * n[1]) + c(2) * n[2];
        const auto m = [&](std::size_t k) { return once(to_eye[k][r]); };
        eye.position[r] = ((m(0) * p[0] + m(1) * p[1]) + m(2) * p[2]) + m(3);
    }
    eye.normal = unit(world);
    return eye;
}

struct Face {
    Vector primary, secondary;
};

// Equation 2.2 to 2.5; empty where a rounding error may decide on a side, the range or the cone.
[[nodiscard]] std::optional<Face> face_of(const Lighting& lighting, const Matrix& view, const Vector& position,
                                          const Vector& normal, const Vec3& color) {
    const LightModel& model = lighting.model;
    Face face;
    for (std::size_t c = 0; c < 3; ++c)
        face.primary[c] = exactly(model.emission[c]) + exactly(model.ambient[c]) * exactly(color[c]);
    for (const Light& light : lighting.lights) {
        Vector toward = unit_once(turned(view, light.direction), -1);
        Bounded factor = exactly(1);
        if (light.type != LightType::directional) {
            std::array<double, 3> place = turned(view, light.position);
            for (std::size_t r = 0; r < 3; ++r) place[r] += view[3][r];
            const Vector to = minus(once_each(place), position);
            const Bounded squared = dot(to, to), distance = root(squared);
            if (!is_clear_of(distance, light.range) || distance.value < 0.25) return std::nullopt;
            if (distance.value > light.range) continue;
            toward = divided(to, distance);
            factor = exactly(1) / ((exactly(light.attenuation.x) + exactly(light.attenuation.y) * distance) +
                                   exactly(light.attenuation.z) * squared);
        }
        if (light.type == LightType::spot) {
            const Bounded cosine = -dot(toward, unit_once(turned(view, light.direction), 1));
            const double limit = std::cos(double{light.cutoff} * M_PI / 180);
            if (!is_clear_of({cosine.value, cosine.error + 0x1p-24}, limit)) return std::nullopt;
            factor = factor * (cosine.value < limit ? exactly(0) : raised(cosine, light.exponent));
        }
        const Bounded cosine = dot(normal, toward);
        if (!is_clear_of(cosine, 0)) return std::nullopt;
        Bounded highlight = exactly(0);
        if (cosine.value > 0) {
            const Vector eye = model.has_local_viewer ? unit(negative(position)) : vector_of({0, 0, 1});
            const Vector half{toward[0] + eye[0], toward[1] + eye[1], toward[2] + eye[2]};
            if (dot(half, half).value < 0.01) return std::nullopt;
            highlight = raised(at_least(dot(normal, unit(half)), 0), model.shininess);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const Bounded own = exactly(color[c]);
            const Bounded diffuse =
                exactly(light.ambient[c]) * own + at_least(cosine, 0) * (exactly(light.diffuse[c]) * own);
            const Bounded specular = highlight * (exactly(light.specular[c]) * exactly(model.specular[c]));
            if (model.separates_specular) {
                face.primary[c] = face.primary[c] + factor * diffuse;
                face.secondary[c] = face.secondary[c] + factor * specular;
            } else {
                face.primary[c] = face.primary[c] + factor * (diffuse + specular);
            }
        }
    }
    return face;
}

[[nodiscard]] Vec3 random_vec(Random& random, float low, float high) {
    return {random_float(random, low, high), random_float(random, low, high), random_float(random, low, high)};
}

[[nodiscard]] Light random_light(Random& random) {
    return {
        .type = static_cast<LightType>(random_int(random, 0, 2)),
        .ambient = random_vec(random, 0, 0.1f),
        .diffuse = random_vec(random, 0, 0.5f),
        .specular = random_vec(random, 0, 0.5f),
        .position = random_vec(random, -4, 4),
        .direction = random_vec(random, -1, 1),
        .attenuation = {random_float(random, 0.5f, 1), random_float(random, 0, 0.3f), random_float(random, 0, 0.1f)},
        .range = random_float(random, 4, 12),
        .cutoff = random_float(random, 10, 90),
        .exponent = static_cast<float>(random_int(random, 0, 16))};
}

[[nodiscard]] LightModel random_model(Random& random) {
    const auto flags = random_int(random, 0, 7);
    return {.ambient = random_vec(random, 0, 0.2f),
            .has_local_viewer = (flags & 1) != 0,
            .is_two_sided = (flags & 2) != 0,
            .separates_specular = (flags & 4) != 0,
            .specular = random_vec(random, 0, 1),
            .emission = random_vec(random, 0, 0.1f),
            .shininess = random_float(random, 0, 64)};
}

// A turn by a random quaternion, a scale and a move.
[[nodiscard]] Matrix random_placement(Random& random, double scale) {
    double q[4], length = 0;
    for (double& part : q) part = double{random_float(random, -1, 1)}, length += part * part;
    for (double& part : q) part /= std::sqrt(length);
    const auto [x, y, z, w] = q;
    const double s = scale;
    const auto place = [&] { return double{random_float(random, -2, 2)}; };
    return {s * (1 - 2 * (y * y + z * z)),
            s * 2 * (x * y + z * w),
            s * 2 * (x * z - y * w),
            0,
            s * 2 * (x * y - z * w),
            s * (1 - 2 * (x * x + z * z)),
            s * 2 * (y * z + x * w),
            0,
            s * 2 * (x * z + y * w),
            s * 2 * (y * z - x * w),
            s * (1 - 2 * (x * x + y * y)),
            0,
            place(),
            place(),
            place(),
            1};
}

[[nodiscard]] VertexLight light_of(const Lighting& lighting, const View& view, const Matrix& model) {
    return {frame_lights(&lighting, view), view, model};
}

[[nodiscard]] Rgba opaque(const Vec3& color) { return {color.r, color.g, color.b, 1}; }

struct Counts {
    std::size_t wrong = 0, checked = 0, bright = 0;
    double worst_error = 0;
};
void compare(const Three& found, const Vector& expected, Counts& counts) {
    for (std::size_t c = 0; c < 3; ++c) {
        const double value = std::clamp(expected[c].value, 0.0, 1.0);
        counts.wrong += std::fabs(double{found[c]} - value) > expected[c].error ? 1 : 0;
        counts.worst_error = std::max(counts.worst_error, std::fabs(double{found[c]} - value));
        counts.bright += value > 0.1 && value < 1 ? 1 : 0;
        ++counts.checked;
    }
}

}  // namespace

TEST_CASE("lit colours are those of OpenGL's equations within their rounding errors") {
    Random random{58};
    Counts counts;
    std::size_t left_out = 0;
    for (int k = 0; k < 6000; ++k) {
        Lighting lighting{{}, random_model(random)};
        for (int i = random_int(random, 1, 4); i > 0; --i) lighting.lights.push_back(random_light(random));
        const View view{.view = random_placement(random, 1)};
        Matrix model = random_placement(random, double{random_float(random, 0.25f, 2)});
        if (k % 3 == 0) model = product(model, {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        const Vec3 position = random_vec(random, -2, 2), normal = random_vec(random, -1, 1);
        const Vec3 front = random_vec(random, 0, 1), back = random_vec(random, 0, 1);
        const LitVertex lit = light_of(lighting, view, model)(position, 1, normal, opaque(front), opaque(back));
        const EyeVertex eye = eye_vertex(product(view.view, model), position, normal);
        const auto of_front = face_of(lighting, view.view, eye.position, eye.normal, front);
        const auto of_back = face_of(lighting, view.view, eye.position,
                                     lighting.model.is_two_sided ? negative(eye.normal) : eye.normal, back);
        if (!of_front || !of_back) {
            ++left_out;
            continue;
        }
        compare(lit.front.primary, of_front->primary, counts);
        compare(lit.front.secondary, of_front->secondary, counts);
        compare(lit.back.primary, of_back->primary, counts);
        compare(lit.back.secondary, of_back->secondary, counts);
    }
    INFO(counts.wrong << " of " << counts.checked << ", worst " << counts.worst_error << ", left out " << left_out);
    CHECK(counts.wrong == 0);
    CHECK(counts.worst_error > 0);
    CHECK(counts.bright > counts.checked / 4);
    CHECK(left_out < 900);
}

TEST_CASE("a scene and its lights turned together have the same colours") {
    Random random{59};
    double worst = 0;
    for (int k = 0; k < 500; ++k) {
        const Matrix turn = random_placement(random, 1), back = [&] {
            Matrix m = identity;  // the inverse of a rigid matrix
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t r = 0; r < 3; ++r) m[c][r] = turn[r][c];
            for (std::size_t r = 0; r < 3; ++r)
                m[3][r] = -(turn[r][0] * turn[3][0] + turn[r][1] * turn[3][1] + turn[r][2] * turn[3][2]);
            return m;
        }();
        const Lighting here{{{.type = LightType::point, .position = {1, 2, 3}, .attenuation = {0.5f, 0.1f, 0.1f}},
                             {.direction = {0.5f, -1, 0.25f}}},
                            {}};
        Lighting there = here;
        const auto move = [&](Vec3& v, bool is_place) {
            const auto t = turned(turn, v);
            for (std::size_t r = 0; r < 3; ++r) v[r] = static_cast<float>(t[r] + (is_place ? turn[3][r] : 0.0));
        };
        move(there.lights[0].position, true);
        move(there.lights[1].direction, false);
        const Vec3 position = random_vec(random, -1, 1), normal = random_vec(random, -1, 1);
        const Rgba color{0.25f, 0.5f, 0.3f, 1};
        const LitVertex a = light_of(here, {}, identity)(position, 1, normal, color, color);
        const LitVertex b = light_of(there, {.view = back}, turn)(position, 1, normal, color, color);
        for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::fabs(double{a.front.primary[c]} - double{b.front.primary[c]}));
    }
    // Places up to 8 in binary32 are 2^-21 off, and a colour changes by at most 4 per unit of place.
    CHECK(worst < 0x1p-17);
}

TEST_CASE("a light behind a surface leaves its ambient light, and the other side of a two-sided one is lit") {
    for (const LightingRule rule : {LightingRule::single, LightingRule::float22}) {
        Lighting lighting{{{.ambient = {0.25f, 0, 0}, .direction = {0, 0, 1}}}, {.ambient = {0, 0, 0}}, rule};
        const auto lit = [&](const Vec3& normal) {
            const Rgba white{1, 1, 1, 1};
            return light_of(lighting, {}, identity)({0, 0, 0}, 1, normal, white, white);
        };
        const float quarter = rule == LightingRule::single ? 0.25f : 64 / 255.0f;
        const LitVertex away = lit({0, 0, 1});
        CHECK(away.front.primary == Three{quarter, 0, 0});
        CHECK(away.back.primary == away.front.primary);
        lighting.model.is_two_sided = true;
        const LitVertex sides = lit({0, 0, 1});
        CHECK(sides.front.primary == away.front.primary);
        CHECK(sides.back.primary == lit({0, 0, -1}).front.primary);
        CHECK(sides.back.primary[1] == 1.0f);
    }
}

TEST_CASE("a mirrored model keeps its normals outside, and a vertex without a direction has ambient light alone") {
    for (const LightingRule rule : {LightingRule::single, LightingRule::float22}) {
        const Lighting lighting{{Light{}}, {}, rule};
        const Matrix mirror{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const Rgba gray{0.5f, 0.5f, 0.5f, 1};
        const VertexLight plain = light_of(lighting, {}, identity), mirrored = light_of(lighting, {}, mirror);
        CHECK(plain({}, 1, {0.6f, 0, 0.8f}, gray, gray).front.primary ==
              mirrored({}, 1, {-0.6f, 0, 0.8f}, gray, gray).front.primary);
        const Three ambient = plain({}, 1, {0, 0, 0}, gray, gray).front.primary;
        CHECK(std::fabs(ambient[0] - 0.1f) < 0.5 / 255 + 1e-6);
    }
}

TEST_CASE("a homogeneous place is lit where its quotient is") {
    const Lighting lighting{{{.type = LightType::point, .position = {0, 0, 2}, .attenuation = {0, 0, 1}}}, {}};
    const VertexLight light = light_of(lighting, {}, identity);
    const Rgba white{1, 1, 1, 1};
    CHECK(light({2, 2, -2}, 2, {0, 0, 1}, white, white).front.primary ==
          light({1, 1, -1}, 1, {0, 0, 1}, white, white).front.primary);
}
