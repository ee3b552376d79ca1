// Suite Fog_carryover: FogCarryover, Carryover<primitive>: primitives with a fog coordinate, then one whose program
// does not write any and keeps the last one. pipeline/reference/fog-and-lighting.md 4.6.
#include <vector>

#include "tools/lab/hardware_check/drawing/fogged.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

constexpr Rgba red{1, 0, 0, 1};
constexpr Argb blue = 0xff0000ff, green = 0xff00ff00;

// Two triangles a row, one row a function.
SuitePicture six_functions(const pipeline::DeviceProfile& profile) {
    using enum FogFunction;
    struct Row {
        FogFunction function;
        float bias, coordinate;
    };
    constexpr Row rows[] = {{linear, 2, 0.6f},      {exp, 1.51f, 0.1f},     {exp2, 1.5f, 0.2f},
                            {exp_abs, 1.51f, 0.1f}, {exp2_abs, 1.5f, 0.2f}, {linear_abs, 2, 0.6f}};
    constexpr float width = 96, height = 42, gap = 8, left = (picture_width - 2 * width) / 3;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff201f20));
    float top = 62;
    for (const auto& [function, bias, coordinate] : rows) {
        FoggedSoup soup{{function, bias, -1, red}};
        for (const float x : {left, 2 * left})
            soup.add_triangle({at(x, top, blue), coordinate}, {at(x + width, top, blue), coordinate},
                              {at(x + width * 0.5f, top + height, blue), coordinate});
        soup.draw(surface, mix_with_fog());
        top += height + gap;
    }
    return {.image = surface.color()};
}

using Points = std::vector<std::array<float, 2>>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

struct CarriedShape {
    std::string_view name;
    Points points;
    Triangles triangles;
};

// In the rectangle from x = 8 to 312 and y = 0 to 64.
std::vector<CarriedShape> shapes() {
    constexpr float left = 8, right = 312, bottom = 64, cx = 160, cy = 32, quarter = 76, eighth = 16;
    return {{"Tris",
             {{left, 0},
              {cx - quarter, 0},
              {left, bottom},
              {left + quarter, bottom},
              {cx, 0},
              {right - quarter, bottom},
              {right, 0},
              {right, bottom},
              {cx + quarter, 0}},
             {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}},
            {"TriStrip",
             {{left, bottom},
              {left, 0},
              {cx, cy},
              {cx, 0},
              {right - quarter, cy - eighth},
              {right - quarter, 0},
              {right, cy + eighth}},
             {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {4, 5, 6}}},
            {"TriFan",
             {{cx, cy}, {left, cy + eighth}, {left + quarter, 0}, {cx + quarter, cy - eighth}, {right, bottom}},
             {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}},
            {"Quads",
             {{left, 0},
              {cx - quarter, 0},
              {cx - quarter, cy},
              {left, cy},
              {cx, 0},
              {right, 0},
              {right, cy},
              {cx, cy},
              {left, cy + eighth},
              {right, cy + eighth},
              {right, bottom},
              {left, bottom}},
             {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {8, 9, 10}, {8, 10, 11}}},
            {"QuadStrip",
             {{left, bottom}, {left, 0}, {cx, bottom - eighth}, {cx, eighth}, {right, bottom}, {right, 0}},
             {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}},
            {"Poly",
             {{cx - quarter, bottom}, {left, cy}, {left, 0}, {right, eighth}, {right - quarter, bottom - eighth}},
             {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}}};
}

// Four rows of the shape, each with a square beside it that keeps the coordinate. It is so dense a fog that no colour
// is seen.
SuitePicture four_rows(const pipeline::DeviceProfile& profile, const CarriedShape& shape) {
    constexpr float coordinate = 0.6f, side = 64, square_left = 448;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xffaaaaaa));
    FoggedSoup soup{{FogFunction::exp, 1.51f, -1, red}};
    for (float top = 64; top < 480; top += side + 40) {
        const auto vertex = [&](std::size_t k) {
            return FoggedVertex{at(shape.points[k][0], top + shape.points[k][1], green), coordinate};
        };
        const auto corner = [&](float x, float y) {
            return FoggedVertex{at(square_left + x, top + y, blue), coordinate};
        };
        for (const auto& [a, b, c] : shape.triangles) soup.add_triangle(vertex(a), vertex(b), vertex(c));
        soup.add_quad({corner(0, 0), corner(side, 0), corner(side, side), corner(0, side)});
    }
    soup.draw(surface, mix_with_fog());
    return {.image = surface.color()};
}

}  // namespace

Drawing draw_fog_carryover(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name == "FogCarryover") return {six_functions(profile), {}};
    if (!take(name, "Carryover")) return unknown_name;
    for (const std::string_view other : {"Points", "Lines", "LineLoop", "LineStrip"})
        if (name == other) return {std::nullopt, "lines and points with fog are not drawn"};
    for (const CarriedShape& shape : shapes())
        if (name == shape.name) return {four_rows(profile, shape), {}};
    return unknown_name;
}

}  // namespace strata::hardware_check
