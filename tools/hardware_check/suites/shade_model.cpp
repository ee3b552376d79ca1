// Suite Shade_model: Prog_<primitive>_<Smooth|Flat>_<First|Last>: how primitives become triangles, and which vertex
// colours a flat one. chip-fragment.md 3.3. Lit, textured and W_ pictures are not modelled.
#include <vector>

#include "tools/hardware_check/fixed_pipeline.h"
#include "tools/hardware_check/names.h"
#include "tools/hardware_check/shapes.h"
#include "tools/hardware_check/suite.h"

namespace strata::hardware_check {
namespace {

// World units: the rectangle that all shapes fill, and w of every vertex.
constexpr double left = -2.75, right = 2.75, top = 1.75, bottom = -1.75, eye_distance = 7.1;
using Point = std::array<double, 2>;

// Three vertices, and which of them colours the triangle when the shading is flat: [0] First, [1] Last.
struct Triangle {
    std::array<std::size_t, 3> corner;
    std::array<std::size_t, 2> provoking;
};

// A primitive of the names, its points in submission order, and the triangles that the chip makes
// of it.
struct Primitive {
    std::string_view name;
    std::vector<Point> points;
    std::vector<Triangle> triangles;
};

// The triangles (0, k, k+1) of a fan or polygon. A flat polygon takes vertex 0's colour in both
// modes; a fan's triangle takes k's (First) or k+1's (Last).
std::vector<Triangle> fan(std::size_t vertices, bool is_polygon) {
    std::vector<Triangle> all;
    for (std::size_t k = 1; k + 1 < vertices; ++k)
        all.push_back({{0, k, k + 1}, is_polygon ? std::array<std::size_t, 2>{0, 0} : std::array{k, k + 1}});
    return all;
}

// Triangle i of a strip is (i, i+1, i+2); odd ones exchange the first two, so that all face alike.
// Flat colour: vertex i (First) or i+2 (Last).
std::vector<Triangle> strip(std::size_t vertices) {
    std::vector<Triangle> all;
    for (std::size_t i = 0; i + 2 < vertices; ++i)
        all.push_back({i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2}, {i, i + 2}});
    return all;
}

// The table of chip-fragment.md 3.3. Quads and their strips take the colour of their last vertex in
// both modes.
std::vector<Primitive> primitives() {
    return {{"Tri",
             {{left, top},
              {0, top},
              {left, 0},
              {right, top},
              {0.1, bottom},
              {0.25, 0},
              {-0.4, bottom},
              {-1.4, -1.4},
              {0, 0}},
             {{{0, 1, 2}, {0, 2}}, {{3, 4, 5}, {3, 5}}, {{6, 7, 8}, {6, 8}}}},
            {"TriStrip",
             {{left, 0}, {-2.25, top}, {-2, bottom}, {-1.3, 1.6}, {0, -1.5}, {0.4, 1}, {1.4, -0.6}, {right, top}},
             strip(8)},
            {"TriFan",
             {{0, -0.75}, {-2.25, bottom}, {-2, top}, {-0.6, 0.65}, {0, 1.5}, {0.4, 1}, {2.4, 0.6}, {right, bottom}},
             fan(8, false)},
            {"Quad",
             {{left, top},
              {-0.4, top},
              {-0.4, bottom},
              {left, bottom},
              {0.15, top},
              {right, top},
              {right, bottom},
              {0, bottom}},
             {{{0, 1, 2}, {3, 3}}, {{0, 2, 3}, {3, 3}}, {{4, 5, 6}, {7, 7}}, {{4, 6, 7}, {7, 7}}}},
            {"QuadStrip",
             {{left, bottom}, {left, top}, {0, -1.35}, {0, 1}, {right, bottom}, {right, top}},
             {{{0, 1, 2}, {3, 3}}, {{2, 1, 3}, {3, 3}}, {{2, 3, 4}, {5, 5}}, {{4, 3, 5}, {5, 5}}}},
            {"Poly", {{left, bottom}, {-1.4, 1.1}, {-0.3, top}, {2, 0.3}, {right, -1.5}}, fan(5, true)}};
}

// By vertex index in submission order.
constexpr Argb vertex_colors[] = {0xff0000ff, 0xff00ff00, 0xffff0000, 0xffcccccc, 0xffcc33ff, 0xff33ccff, 0xff33ffcc,
                                  0xffccff33, 0xffffcc33, 0xffff33cc, 0xff111199, 0xff119911, 0xff991111, 0xff666666};

// A point in the window, w = 7.1. The chip's vertex arithmetic cuts: a value that is exactly on a
// step of 1/16 pixel comes out below it (x = 0 at 319.9375), so the next smaller binary32 stands
// for it here.
ClipVertex window_vertex(const Point& p, Argb color) {
    constexpr double scale = 240.0 * cotangent / eye_distance;
    const auto cut = [](double v) { return next_below(static_cast<float>(v)); };
    return at(cut(320.0 + p[0] * scale), cut(240.0 - p[1] * scale), 0, to_float(color),
              static_cast<float>(eye_distance));
}

// `provoking` picks the mode of a flat shape: 0 First, 1 Last. A smooth one takes every corner's
// own colour.
TriangleSoup shaded(const Primitive& primitive, bool flat, std::size_t provoking) {
    TriangleSoup soup;
    for (const Triangle& t : primitive.triangles) {
        const auto vertex = [&](std::size_t k) {
            return window_vertex(primitive.points[t.corner[k]],
                                 vertex_colors[flat ? t.provoking[provoking] : t.corner[k]]);
        };
        add_triangle(soup, vertex(0), vertex(1), vertex(2));
    }
    return soup;
}

}  // namespace

Drawing draw_shade_model(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool by_program = take(name, "Prog_");
    if (!by_program) {
        for (const std::string_view prefix : {"Fixed", "ProgTex", "ProgLM", "W_"})
            if (name.starts_with(prefix)) return {std::nullopt, "lit, textured and W_ pictures are not described"};
        return unknown_name;
    }
    const std::string_view kind = take_until(name, "_"), shading = take_until(name, "_");
    if ((shading != "Smooth" && shading != "Flat") || (name != "First" && name != "Last")) return unknown_name;
    for (const Primitive& primitive : primitives()) {
        if (primitive.name != kind) continue;
        pipeline::Surface surface{profile, {}};
        surface.clear_color(unpack(0xff2c302e));
        const bool flat = shading == "Flat";
        surface.draw({.cull = rasterizer::CullFace::back, .front_face = rasterizer::FrontFace::clockwise},
                     shaded(primitive, flat, name == "First" ? 0 : 1));
        // Flat pictures are equal. Of smooth ones at most one pixel is one unit off, where 256
        // times a weight lies next to an integer (chip-fragment.md 3.3); two may be.
        return {Picture{.image = surface.color(), .bound = flat ? Bound{} : Bound{2, 1}}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
