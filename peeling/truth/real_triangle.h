// peeling/truth/real_triangle.h - a triangle with unsnapped corners: the pixel centres that it covers, and its values
// there.
//
// Rule     A centre is inside as edge.h says, top-left rule, decided by the exact sign of the edge function of the
//          binary64 corners. With b the screen-space weights of the corners, depth is the sum of b z, and an attribute
//          u is the sum of b u / w divided by the sum of b / w.
// Numbers  An edge is always evaluated from its lexicographically smaller end, so the two triangles that share it get
//          values that differ only in sign. A value larger than 2^-50 times its two products has the right sign (their
//          error is below 4 2^-53 of them); otherwise the six products of the expanded determinant are summed without
//          rounding.
// Tests    tests/peeling/truth/truth_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::peeling {

struct RealCorner {
    double x = 0, y = 0;  // pixels, y down
    double z = 0;         // 0 to 1
    double inverse_w = 1;
    std::array<double, rasterizer::attribute_count> value{};  // r g b a s t
};

struct RealWeights {
    std::array<double, 3> b{};
    bool is_inside = false;
};

class RealTriangle {
  public:
    RealTriangle(const std::array<RealCorner, 3>& corner, std::uint32_t primitive, std::uint32_t material) noexcept;

    // The sign of twice the area: positive is clockwise with y down; a triangle of area 0 covers nothing.
    [[nodiscard]] int winding() const noexcept { return winding_; }
    [[nodiscard]] const std::array<RealCorner, 3>& corners() const noexcept { return corner_; }
    [[nodiscard]] std::uint32_t primitive() const noexcept { return primitive_; }
    [[nodiscard]] std::uint32_t material() const noexcept { return material_; }
    // The pixels of `within` that the triangle may cover.
    [[nodiscard]] rasterizer::Rect box(const rasterizer::Rect& within) const noexcept;

    // At the centre of a pixel.
    [[nodiscard]] RealWeights weights(int x, int y) const noexcept;
    [[nodiscard]] double depth(const RealWeights& weights) const noexcept;
    [[nodiscard]] std::array<double, rasterizer::attribute_count> values(const RealWeights& weights) const noexcept;

  private:
    std::array<RealCorner, 3> corner_;
    std::uint32_t primitive_, material_;
    int winding_;
};

}  // namespace strata::peeling
