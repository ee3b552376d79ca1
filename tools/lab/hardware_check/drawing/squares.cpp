#include "tools/lab/hardware_check/drawing/squares.h"

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"

namespace strata::hardware_check {
namespace {

constexpr float square_side = 100, first_left = 120, first_top = 140, upper_z = 10, lower_z = 0;

// The two transforms from the host's camera to the window.
struct Projection {
    HostCamera camera = default_camera(65535.0f);
    CompositeMatrix all = columns_of(camera.composite), view = columns_of(look_at({0, 0, -7}, {0, 0, 0})),
                    to_window = columns_of(perspective_to_window(65535.0f));
    float fixed_offset = 0;

    [[nodiscard]] HostVector by_program(const HostVector& world) const {
        return chip_quotient(chip_product(to_window, chip_product(view, world)));
    }
    [[nodiscard]] HostVector by_fixed(const HostVector& world) const {
        return chip_window_point(all, world, fixed_offset);
    }
};
using Way = HostVector (Projection::*)(const HostVector& world) const;

// Adds a box of the window, whose corners are un-projected and then projected by `way`.
void add_projected(TriangleSoup& soup, const Projection& projection, Way way, const Box& b, Argb color, float z_shift) {
    const auto corner = [&](float x, float y, float z) {
        const HostVector window = (projection.*way)(unprojected(projection.camera, x, y, z + z_shift));
        return at(window[0], window[1], color);
    };
    add_quad(soup, {corner(b.left, b.top, upper_z), corner(b.right, b.top, upper_z), corner(b.right, b.bottom, lower_z),
                    corner(b.left, b.bottom, lower_z)});
}

// True if the fixed-function pipeline draws square `i` of eight_squares().
constexpr bool is_fixed[8] = {false, true, false, true, true, false, true, false};

// The squares of eight_squares() drawn by one of the two pipelines.
TriangleSoup half_of(const Projection& projection, float shift, bool fixed, Argb color) {
    TriangleSoup half;
    for (int i = 0; i < 8; ++i) {
        if (is_fixed[i] != fixed) continue;
        const float x = first_left + square_side * static_cast<float>(i % 4) + shift,
                    y = first_top + square_side * static_cast<float>(i / 4) + shift;
        add_projected(half, projection, fixed ? &Projection::by_fixed : &Projection::by_program,
                      {x, y, x + square_side, y + square_side}, color, 0);
    }
    return half;
}

}  // namespace

TriangleSoup eight_squares(float shift, Argb color) {
    TriangleSoup soup;
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 4; ++column) {
            const float x = first_left + square_side * static_cast<float>(column),
                        y = first_top + square_side * static_cast<float>(row);
            add_box(soup, {x + shift, y + shift, x + shift + square_side, y + shift + square_side}, color);
        }
    return soup;
}

void draw_mixed_squares(pipeline::Surface& surface, const MixedSquares& squares) {
    Projection projection;
    projection.fixed_offset = squares.fixed_offset;
    TriangleSoup background;
    add_projected(background, projection, &Projection::by_program, {120, 140, 520, 340}, 0xffe0e0e0, 0.0001f);
    surface.draw({}, std::move(background));
    surface.draw({}, half_of(projection, squares.shift, false, squares.by_program));
    surface.draw({}, half_of(projection, squares.shift, true, squares.by_fixed));
}

}  // namespace strata::hardware_check
