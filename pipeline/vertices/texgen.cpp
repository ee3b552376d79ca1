// pipeline/vertices/texgen.cpp - generates and transforms texture coordinates (texgen.h).
#include "pipeline/vertices/texgen.h"

#include <stdexcept>

#include "pipeline/vertices/matrix.h"

namespace strata::pipeline {
namespace {

using Rows = std::array<float, 16>;

float row(const Rows& m, std::size_t r, const std::array<float, 4>& p) noexcept {
    return ((m[r] * p[0] + m[4 + r] * p[1]) + m[8 + r] * p[2]) + m[12 + r] * p[3];
}

// The matrix whose rows are the planes of a unit, applied to object coordinates.
Matrix planes_of(const CoordinateUnit& unit, const Matrix& modelview) {
    // Only eye planes are multiplied by the modelview: the rows of the other kind are 0 in each matrix.
    Matrix object(0.0), eye(0.0);
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c)
            (unit.gen[r].mode == TexGenMode::eye_linear ? eye : object)[c][r] = unit.gen[r].plane[c];
    const Matrix seen = product(eye, modelview);
    Matrix rows;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 4; ++r)
            rows[c][r] = (unit.gen[r].mode == TexGenMode::eye_linear ? seen : object)[c][r];
    return rows;
}

// Applied after the product, as quotient_rows.h scales its row r: the same bits from the same matrices.
Matrix in_depth_units(const CoordinateUnit& unit, Matrix m) {
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 3; ++r) m[c][r] *= unit.depth_units[r];
    return m;
}

// (-1)^(r + c) times the determinant without row r and column c; three rows in cyclic order are an even permutation.
double cofactor(const Matrix& m, std::size_t r, std::size_t c) {
    const auto a = [&](std::size_t row, std::size_t column) { return m[(c + column) % 4][(r + row) % 4]; };
    const double minor = a(1, 1) * (a(2, 2) * a(3, 3) - a(2, 3) * a(3, 2)) -
                         a(1, 2) * (a(2, 1) * a(3, 3) - a(2, 3) * a(3, 1)) +
                         a(1, 3) * (a(2, 1) * a(3, 2) - a(2, 2) * a(3, 1));
    return (r + c) % 2 == 0 ? minor : -minor;
}

}  // namespace

// plane M^-1, M^-1 = adjugate / determinant.
Plane4 eye_plane(const Plane4& plane, const Matrix& modelview) {
    double determinant = 0;
    for (std::size_t c = 0; c < 4; ++c) determinant += modelview[c][0] * cofactor(modelview, 0, c);
    if (determinant == 0) throw std::logic_error("an eye plane under a singular modelview matrix");
    Plane4 solution{};
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t r = 0; r < 4; ++r) solution[c] += plane[r] * cofactor(modelview, c, r);
        solution[c] /= determinant;
    }
    return solution;
}

std::array<TexGen, 4> eye_position() {
    std::array<TexGen, 4> gen;
    for (std::size_t c = 0; c < 4; ++c) gen[c] = {TexGenMode::eye_linear, eye_plane(identity_planes[c], identity)};
    return gen;
}

VertexCoordinates::VertexCoordinates(const CoordinateUnits& units, const View& view, const Matrix& model) {
    const Matrix modelview = product(view.view, model);
    for (const CoordinateUnit& unit : units) {
        std::array<bool, 4> generated{};
        for (std::size_t c = 0; c < 4; ++c) generated[c] = unit.gen[c].mode != TexGenMode::off;
        const bool all = generated == std::array{true, true, true, true};
        const Matrix planes = planes_of(unit, modelview), texture = in_depth_units(unit, unit.matrix);
        const Matrix whole = all ? in_depth_units(unit, product(unit.matrix, planes)) : planes;
        units_.push_back({unit.enabled, all, generated,
                          VertexTransform{view.vertex_path, whole, all ? texture : identity, planes},
                          to_binary32(texture)});
    }
}

UnitCoordinates VertexCoordinates::at(const Vec3& position, const Vec2& texcoord) const {
    UnitCoordinates all{};
    for (std::size_t u = 0; u < units_.size(); ++u) {
        const Unit& unit = units_[u];
        if (!unit.enabled) continue;
        const std::array<float, 4> generated = unit.of_position(position);
        // of_position already includes the texture matrix.
        if (unit.all_generated) {
            all[u] = generated;
            continue;
        }
        std::array<float, 4> coordinates{u == 0 ? texcoord[0] : 0.0f, u == 0 ? texcoord[1] : 0.0f, 0.0f, 1.0f};
        for (std::size_t c = 0; c < 4; ++c)
            if (unit.generated[c]) coordinates[c] = generated[c];
        for (std::size_t c = 0; c < 4; ++c) all[u][c] = row(unit.of_coordinates, c, coordinates);
    }
    return all;
}

}  // namespace strata::pipeline
