// Suite Point_size: PointSmooth<On|Off>_<step>_<VS|FF>: points whose size register grows by `step`; Largest: sizes
// above 511 are ignored. POINT_SMOOTH changes texture coordinates alone, and there is no texture.
// rasterizer/reference/lines-and-points.md 5.
#include <cmath>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

constexpr int greatest_size = 511;

// The fixed-function pipeline adds the viewport's offset to un-projected points.
using Offset = float;

void draw_point(pipeline::Surface& surface, const ClipVertex& vertex, int size) {
    SplitDraw draw = split_draw(Topology::points, {vertex}, PolygonMode::fill);
    surface.draw({.point_size_px = static_cast<float>(size) / 8.0f}, std::move(draw.soup), draw.primitive);
}

// Sizes 0, step, 2 step ... from the upper left point on, in rows; the size stays where a value is ignored.
void draw_growing(pipeline::Surface& surface, int step, Offset offset) {
    const int right = step > 1 ? 64 : 40, down = step > 1 ? 64 : 30;
    int value = 0, size = 8;
    float red = 0.1f;
    for (int y = 100; y < picture_height; y += down, red += 0.1f) {
        float blue = 0.1f;
        for (int x = 20; x < picture_width; x += right, blue += 0.1f, value += step) {
            if (value <= greatest_size) size = value;
            draw_point(surface,
                       at(static_cast<float>(x) + offset, static_cast<float>(y) + offset, 0.5f,
                          {std::fmin(red, 1.0f), 0.65f, std::fmin(blue, 1.0f), 1.0f}),
                       size);
        }
    }
}

// Points of one pixel and of 511 / 8 in two rows, and rulers of 64 pixels around a point drawn with an ignored size.
void draw_largest(pipeline::Surface& surface, Offset offset) {
    constexpr float side = 64, gap = 2;
    const float x = std::floor((picture_width - side) / 3.0f), y = std::floor((picture_height - side) / 3.0f);
    for (const int row : {1, 2}) {
        const int size = row == 1 ? 8 : greatest_size;
        const float cy = y * static_cast<float>(row) + offset, cx = 2 * x + offset;
        draw_point(surface, at(x + offset, cy, 0xffbbbbbb), size);
        const float left = cx - side / 2, top = cy - side / 2;
        for (const Box& b : {Box{left, top, left + side, top + side}, Box{left - 2 * gap, top, left - gap, top + side},
                             Box{left, top - 2 * gap, left + side, top - gap}})
            surface.draw({}, box(b, 0xff00bb00));
        draw_point(surface, at(cx, cy, 0xffffffff), size);
    }
}

}  // namespace

Drawing draw_point_size(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool by_program = take_last(name, "_VS");
    if (!by_program && !take_last(name, "_FF")) return unknown_name;
    const Offset offset = by_program ? 0.0f : viewport_offset;
    pipeline::Surface surface{profile, {}};
    if (name == "LargestPointSize") {
        surface.clear_color(unpack(0xff444444));
        draw_largest(surface, offset);
        return {SuitePicture{.image = surface.color()}, {}};
    }
    if (name == "SmallestPointSize") return {std::nullopt, "the scene of the smallest sizes is not described"};
    if (!take(name, "PointSmoothOn_") && !take(name, "PointSmoothOff_")) return unknown_name;
    const auto step = to_number(name);
    if (!step || !(*step >= 1 && *step <= 16) || *step != std::floor(*step)) return unknown_name;
    surface.clear_color(unpack(0xff222322));
    draw_growing(surface, static_cast<int>(*step), offset);
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
