#include "tools/hardware_check/squares.h"

namespace strata::hardware_check {
namespace {

// Six vertices a square.
constexpr std::size_t vertices_a_square = 6;

// Those squares of eight_squares() that one of the two pipelines draws.
TriangleSoup half_of(const TriangleSoup& squares, bool fixed, float offset) {
    constexpr bool is_fixed[8] = {false, true, false, true, true, false, true, false};
    TriangleSoup half;
    for (std::size_t i = 0; i < squares.vertices.size(); i += 3) {
        if (is_fixed[i / vertices_a_square] != fixed) continue;
        const auto moved = [&](std::size_t k) {
            ClipVertex v = squares.vertices[i + k];
            v.x += offset;
            v.y += offset;
            return v;
        };
        add_triangle(half, moved(0), moved(1), moved(2));
    }
    return half;
}

}  // namespace

TriangleSoup eight_squares(float shift, Argb color) {
    TriangleSoup soup;
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 4; ++column) {
            const float x = 120.0f + 100.0f * static_cast<float>(column), y = 140.0f + 100.0f * static_cast<float>(row);
            add_box(soup, {x + shift, y + shift, x + shift + 100, y + shift + 100}, color);
        }
    return soup;
}

void draw_mixed_squares(pipeline::Surface& surface, const MixedSquares& squares) {
    surface.draw({}, box({120, 140, 520, 340}, 0xffe0e0e0));
    surface.draw({}, half_of(eight_squares(squares.shift, squares.by_program), false, 0));
    surface.draw({}, half_of(eight_squares(squares.shift, squares.by_fixed), true, squares.fixed_offset));
}

}  // namespace strata::hardware_check
