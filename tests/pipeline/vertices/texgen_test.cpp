// Tests generated texture coordinates against planes and matrices in rational arithmetic.
#include "pipeline/vertices/texgen.h"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "pipeline/vertices/matrix.h"
#include "tests/pipeline/addressing_model.h"

using namespace strata::pipeline;
using model::Rational;

namespace {

// A small fraction, so that many products of it are exact.
double small(Random& random) { return (static_cast<int>(below(random, 65)) - 32) / 8.0; }

Plane4 any_plane(Random& random) { return {small(random), small(random), small(random), small(random)}; }

Matrix any_matrix(Random& random) {
    std::array<double, 16> m{};
    for (double& entry : m) entry = small(random);
    return strata::matrix_of(m);
}

// Quarter turns, powers of two and translations: its inverse is exact.
Matrix any_modelview(Random& random) {
    Matrix turn(0.0);
    const std::size_t first = below(random, 3);
    for (std::size_t c = 0; c < 3; ++c) turn[c][(c + first) % 3] = one_in(random, 2) ? 1 : -1;
    turn[3][3] = 1;
    const double k = one_in(random, 2) ? 2.0 : 0.25;
    return product(product(translation(small(random), small(random), small(random)), turn), scaling(k, k, 2 * k));
}

Rational dot(const std::array<Rational, 4>& a, const std::array<Rational, 4>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}
std::array<Rational, 4> row(const Matrix& m, std::size_t r) {
    return {Rational{m[0][r]}, Rational{m[1][r]}, Rational{m[2][r]}, Rational{m[3][r]}};
}
std::array<Rational, 4> times(const Matrix& m, const std::array<Rational, 4>& v) {
    return {dot(row(m, 0), v), dot(row(m, 1), v), dot(row(m, 2), v), dot(row(m, 3), v)};
}
std::array<Rational, 4> exact(const Plane4& p) {
    return {Rational{p[0]}, Rational{p[1]}, Rational{p[2]}, Rational{p[3]}};
}

}  // namespace

TEST_CASE("generated coordinates are planes over object or eye space multiplied by the texture matrix", "[slow]") {
    Random random{301};
    Tally tally;
    for (int round = 0; round < 3000; ++round) {
        const Matrix view = any_modelview(random), model_matrix = any_modelview(random);
        CoordinateUnits units{};
        const std::size_t u = below(random, 4);
        units[u].enabled = true;
        units[u].matrix = one_in(random, 3) ? identity : any_matrix(random);
        for (TexGen& gen : units[u].gen) gen = {any_of(random, TexGenMode::eye_linear), any_plane(random)};
        const Vec3 p{static_cast<float>(small(random)), static_cast<float>(small(random)),
                     static_cast<float>(small(random))};
        const Vec2 st{static_cast<float>(small(random)), static_cast<float>(small(random))};
        const UnitCoordinates found = VertexCoordinates{units, {.view = view}, model_matrix}.at(p, st);

        const std::array<Rational, 4> object{Rational{p[0]}, Rational{p[1]}, Rational{p[2]}, Rational{1}};
        const auto eye = times(view, times(model_matrix, object));
        const Rational given[4]{u == 0 ? Rational{st[0]} : 0, u == 0 ? Rational{st[1]} : 0, 0, 1};
        std::array<Rational, 4> coordinates;
        for (std::size_t c = 0; c < 4; ++c) {
            const TexGen& gen = units[u].gen[c];
            coordinates[c] = gen.mode == TexGenMode::off             ? given[c]
                             : gen.mode == TexGenMode::object_linear ? dot(exact(gen.plane), object)
                                                                     : dot(exact(gen.plane), eye);
        }
        const auto expected = times(units[u].matrix, coordinates);
        for (std::size_t c = 0; c < 4; ++c)
            tally.expect(Rational{found[u][c]} == expected[c],
                         [&] { return fmt::format("round {}, unit {}, component {}: {}", round, u, c, found[u][c]); });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE(
    "an eye plane has in eye space the values that it had in the space of the modelview matrix when it was specified") {
    Random random{302};
    Tally tally;
    for (int round = 0; round < 500; ++round) {
        const Matrix modelview = any_modelview(random);
        const Plane4 plane = any_plane(random), eye = eye_plane(plane, modelview);
        const std::array<Rational, 4> v{Rational{small(random)}, Rational{small(random)}, Rational{small(random)}, 1};
        tally.expect(dot(exact(plane), v) == dot(exact(eye), times(modelview, v)),
                     [&] { return fmt::format("round {}", round); });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
    CHECK_THROWS_AS(eye_plane({1, 0, 0, 0}, Matrix(0.0)), std::logic_error);
    CHECK(eye_position()[2].plane == Plane4{0, 0, 1, 0});
}

TEST_CASE("a coordinate is rounded to binary32 after every operation and its matrix once") {
    CoordinateUnits units{};
    units[1] = {.enabled = true, .gen = eye_position(), .matrix = scaling(1 + 0x1p-30, 1, 1)};
    const Vec3 p{1 + 0x1p-23f, 0x1p-24f, 0x1p-24f};
    CHECK(VertexCoordinates{units, {}, identity}.at(p, {})[1][0] == p[0]);  // 1 + 2^-30 is 1 in binary32
    units[1].matrix[1][0] = 1;  // s = x + y + z: each half unit in the last place is lost, though their sum would count
    units[1].matrix[2][0] = 1;
    const Vec3 halves{1, 0x1p-24f, 0x1p-24f};
    CHECK(VertexCoordinates{units, {}, identity}.at(halves, {})[1][0] == 1.0f);
}

TEST_CASE("depth units multiply s t r after the texture matrix and leave q unchanged") {
    Random random{303};
    CoordinateUnits plain{};
    plain[2] = {.enabled = true, .gen = eye_position(), .matrix = any_matrix(random)};
    CoordinateUnits scaled = plain;
    scaled[2].depth_units = {2, 4, 8};
    const Vec3 p{0.5f, 3, -2};
    const auto a = VertexCoordinates{plain, {}, identity}.at(p, {}),
               b = VertexCoordinates{scaled, {}, identity}.at(p, {});
    CHECK(b[2] == std::array{2 * a[2][0], 4 * a[2][1], 8 * a[2][2], a[2][3]});
}
