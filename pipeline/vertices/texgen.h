// pipeline/vertices/texgen.h - texture coordinates of a vertex: generated or given, then transformed by a texture
// matrix.
//
// Rule     A generated coordinate is plane . position, in object or eye space; an eye plane is multiplied by the
//          inverse of the modelview in force when it is specified. Coordinates that are not generated are the vertex's
//          own: s and t of its mesh in unit 0, else 0, and r = 0, q = 1. Then the texture matrix is applied. Planes,
//          texture matrix and modelview are multiplied in binary64 and rounded once to binary32 (assumed: drivers may
//          do so); positions are transformed by the view's vertex path, like those to clip space (vertex_transform.h).
// Source   GL 1.2.1 2.10.2 and 2.10.4; pipeline/reference/vertices.md 4.
// Tests    tests/pipeline/vertices/texgen_test.cpp, tests/peeling/listing2_test.cpp
#pragma once
#include <array>
#include <vector>

#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/vertex_transform.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// The texture unit whose coordinates address a light's map, and the mask of these coordinates.
inline constexpr std::size_t shadow_unit = 3;
inline constexpr rasterizer::UnitMask shadow_coordinates = 0xf << (4 * shadow_unit);

// Whether a coordinate is generated, and in which space: GL's OBJECT_LINEAR and EYE_LINEAR.
enum class TexGenMode : std::uint8_t { off, object_linear, eye_linear };

using Plane4 = Vec4d;
inline constexpr std::array<Plane4, 4> identity_planes{Plane4{1, 0, 0, 0}, Plane4{0, 1, 0, 0}, Plane4{0, 0, 1, 0},
                                                       Plane4{0, 0, 0, 1}};

struct TexGen {
    TexGenMode mode = TexGenMode::off;
    // For eye_linear the result of `eye_plane`, for object_linear the plane itself.
    Plane4 plane{};
    friend bool operator==(const TexGen&, const TexGen&) = default;
};

// How a texture unit's coordinates s, t, r, q are computed: generation, texture matrix, then the factors below.
struct CoordinateUnit {
    // Some stage reads this unit; disabled units are not computed.
    bool enabled = false;
    std::array<TexGen, 4> gen{};
    Matrix matrix = identity;
    // Factors of s, t and r after the texture matrix: 2^n - 1 if a quotient by q, or by another unit, is to be in the
    // units of a depth buffer. OpenGL has no such factors: GeForce3's driver scales the rows, and so does this.
    Vec3d depth_units{1, 1, 1};
    friend bool operator==(const CoordinateUnit&, const CoordinateUnit&) = default;
};
using CoordinateUnits = std::array<CoordinateUnit, rasterizer::texture_units>;
using UnitCoordinates = std::array<std::array<float, 4>, rasterizer::texture_units>;  // s t r q of each

// glTexGendv(EYE_PLANE) under `modelview`: plane times its inverse. Throws std::logic_error for a singular matrix.
[[nodiscard]] Plane4 eye_plane(const Plane4& plane, const Matrix& modelview);

// All four coordinates EYE_LINEAR with identity planes, specified under the identity: s t r q are the eye position.
[[nodiscard]] std::array<TexGen, 4> eye_position();

// glTranslate and glScale as matrices, for composing texture matrices.
[[nodiscard]] constexpr Matrix translation(double x, double y, double z) noexcept {
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}
[[nodiscard]] constexpr Matrix scaling(double x, double y, double z) noexcept {
    return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1};
}

// The coordinates of one mesh's vertices.
class VertexCoordinates {
  public:
    VertexCoordinates(const CoordinateUnits& units, const View& view, const Matrix& model);
    [[nodiscard]] UnitCoordinates at(const Vec3& position, const Vec2& texcoord) const;

  private:
    struct Unit {
        bool enabled = false, all_generated = false;
        std::array<bool, 4> generated{};
        // matrix . planes . modelview if all four are generated, else planes . modelview.
        VertexTransform of_position;
        // The texture matrix, for a unit with some given coordinate.
        std::array<float, 16> of_coordinates{};
    };
    std::vector<Unit> units_;
};

}  // namespace strata::pipeline
