// Suite Shade_model: [W_]<Prog|ProgLM|ProgTex|Fixed|FixedTex>_<primitive>_<Smooth|Flat>_<First|Last>: how primitives
// are split into triangles, and the provoking vertex of flat shading; lit by the fixed-function pipeline, textured, and
// with a different w at each vertex. pipeline/reference/chip-fragment.md 3.3,
// rasterizer/reference/chip-geometry.md 5.8.
#include <bit>
#include <vector>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

// World units: the rectangle that all shapes fill, its z, and the distance of the eye from z = 0.
constexpr double left = -2.75, right = 2.75, top = 1.75, bottom = -1.75, depth = 0.1, eye_distance = 7;
using Point = std::array<double, 2>;

struct ShadedPrimitive {
    std::string_view name;
    Topology topology;
    std::vector<Point> points;                  // in submission order
    std::vector<std::array<float, 2>> texture;  // s, t of the points
};

// The vertex whose colour a flat triangle has: [0] First, [1] Last. Quads and quad strips have that of their last
// vertex in both modes, polygons that of vertex 0.
std::array<std::uint32_t, 2> provoking_vertices(Topology topology, std::uint32_t triangle) {
    switch (topology) {
        case Topology::triangle_strip: return {triangle, triangle + 2};
        case Topology::triangle_fan: return {triangle + 1, triangle + 2};
        case Topology::quads: return {triangle / 2 * 4 + 3, triangle / 2 * 4 + 3};
        case Topology::quad_strip: return {triangle / 2 * 2 + 3, triangle / 2 * 2 + 3};
        case Topology::polygon: return {0, 0};
        default: return {3 * triangle, 3 * triangle + 2};
    }
}

// The table of pipeline/reference/chip-fragment.md 3.3.
std::vector<ShadedPrimitive> primitives() {
    return {{"Tri",
             Topology::triangles,
             {{left, top},
              {0, top},
              {left, 0},
              {right, top},
              {0.1, bottom},
              {0.25, 0},
              {-0.4, bottom},
              {-1.4, -1.4},
              {0, 0}},
             {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {.1f, 1}, {.25f, .5f}, {.5f, 1}, {.2f, .5f}, {1, 0}}},
            {"TriStrip",
             Topology::triangle_strip,
             {{left, 0}, {-2.25, top}, {-2, bottom}, {-1.3, 1.6}, {0, -1.5}, {0.4, 1}, {1.4, -0.6}, {right, top}},
             {{0, 0}, {0, 1}, {0, 0}, {1.15f, .25f}, {1.3f, .75f}, {1.7f, .33f}, {.7f, .7f}, {.5f, .5f}}},
            {"TriFan",
             Topology::triangle_fan,
             {{0, -0.75}, {-2.25, bottom}, {-2, top}, {-0.6, 0.65}, {0, 1.5}, {0.4, 1}, {2.4, 0.6}, {right, bottom}},
             {{1, 1}, {0, 0}, {0, 1}, {1.15f, .25f}, {1.3f, .75f}, {1.7f, .33f}, {.7f, .7f}, {.5f, .5f}}},
            {"Quad",
             Topology::quads,
             {{left, top},
              {-0.4, top},
              {-0.4, bottom},
              {left, bottom},
              {0.15, top},
              {right, top},
              {right, bottom},
              {0, bottom}},
             {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}}},
            {"QuadStrip",
             Topology::quad_strip,
             {{left, bottom}, {left, top}, {0, -1.35}, {0, 1}, {right, bottom}, {right, top}},
             {{.33f, .33f}, {1, 1}, {.7f, .1f}, {0, .9f}, {.33f, .33f}, {0, .7f}}},
            {"Poly",
             Topology::polygon,
             {{left, bottom}, {-1.4, 1.1}, {-0.3, top}, {2, 0.3}, {right, -1.5}},
             {{.33f, .33f}, {.7f, .1f}, {.1f, .7f}, {0, .9f}, {.7f, .7f}}}};
}

// By vertex index in submission order.
constexpr Argb vertex_colors[] = {0xff0000ff, 0xff00ff00, 0xffff0000, 0xffcccccc, 0xffcc33ff, 0xff33ccff, 0xff33ffcc,
                                  0xffccff33, 0xffffcc33, 0xffff33cc, 0xff111199, 0xff119911, 0xff991111, 0xff666666};

// The settings in a name other than the primitive.
struct ShadedCapture {
    bool is_lit = false, as_lines = false, is_textured = false, has_own_w = false, flat = false;
    std::size_t provoking = 0;  // 0 First, 1 Last
};

// The normals' z, by vertex index.
constexpr float normal_z[] = {0.5773502691896258f,
                              1,
                              0.8164965809277261f,
                              0.3333333f,
                              0.9045f,
                              0.7276f,
                              0.4685f,
                              0.8018f,
                              0.29f,
                              0.6097f,
                              0.1543f,
                              0.7071f,
                              0.5241f,
                              0.3906f};

// A light's contribution to a colour as the vertex engine outputs it: rounded to nearest with 14 significant bits.
float lit(float v) {
    constexpr std::uint32_t half = 1u << 9;  // half a unit of the fourteenth bit
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(v) + half) & ~(2 * half - 1));
}

// The light is directed along the normals' z, with a diffuse colour of (0, 1, .7) and no other terms.
std::array<float, 4> color_of(std::size_t index, bool is_lit) {
    if (!is_lit) return to_float(vertex_colors[index]);
    const float n = normal_z[index];
    return {0, lit(n), lit(0.7f * n), 1};
}

// w of vertex `k` as the test sets it for the fixed-function pipeline, accumulated in binary32.
float own_w(std::size_t k) {
    float w = 0.5f;
    for (std::size_t i = 0; i < k; ++i) w += 0.05f;
    return w;
}

// Texels per side of the checkerboard.
constexpr int texels = 64;

// Point `k` in the window. The vertex program's arithmetic truncates: a value that is exactly on a step of 1/16 pixel
// is computed below it (x = 0 at 319.9375), so the next smaller binary32 is used for it here. The fixed-function
// pipeline adds the viewport's offset, and the test's own w scales the distance to the eye.
ClipVertex window_vertex(const ShadedPrimitive& primitive, std::size_t k, const ShadedCapture& s) {
    const double w = depth + eye_distance * (s.has_own_w ? double{own_w(k)} : 1.0), scale = 240.0 * cotangent / w;
    const double x = 320.0 + primitive.points[k][0] * scale, y = 240.0 - primitive.points[k][1] * scale;
    const auto place = [&](double v) {
        return s.is_lit ? static_cast<float>(v + double{viewport_offset}) : next_below(static_cast<float>(v));
    };
    ClipVertex v = at(place(x), place(y), 0, {1, 1, 1, 1}, static_cast<float>(w));
    v.texcoord = {primitive.texture[k][0] * texels, primitive.texture[k][1] * texels};
    return v;
}

SplitDraw shaded(const ShadedPrimitive& primitive, const ShadedCapture& s) {
    std::vector<ClipVertex> vertices;
    std::vector<OutlinedTriangle> triangles =
        split(primitive.topology, static_cast<std::uint32_t>(primitive.points.size()));
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::uint32_t& corner : triangles[i].corner) {
            ClipVertex v = window_vertex(primitive, corner, s);
            const std::uint32_t provoking = provoking_vertices(primitive.topology, i)[s.provoking];
            if (!s.is_textured) v.front = v.back = color_of(s.flat ? provoking : corner, s.is_lit);
            corner = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(v);
        }
    return split_draw(triangles, vertices, s.as_lines ? PolygonMode::line : PolygonMode::fill);
}

// Flat pictures are equal. Smooth ones differ in at most one pixel, by one unit, where 256 times a weight is close to
// an integer (pipeline/reference/chip-fragment.md 3.3); two are allowed. A textured one may have the texel beyond a
// cell's edge there.
Bound bound_of(const ShadedCapture& s) {
    if (s.is_textured) return {5, 255};
    return s.flat ? Bound{} : Bound{2, 1};
}

// Removes the words before the primitive. False if they are not words of this suite.
bool take_shading(std::string_view& name, ShadedCapture& s) {
    s.has_own_w = take(name, "W_");
    s.is_lit = take(name, "Fixed");
    if (!s.is_lit && (s.has_own_w || !take(name, "Prog"))) return false;
    s.as_lines = !s.is_lit && take(name, "LM");
    s.is_textured = take(name, "Tex");
    return take(name, "_");
}

}  // namespace

Drawing draw_shade_model(std::string_view name, const pipeline::DeviceProfile& profile) {
    for (const std::string_view prefix : {"FixedLM_", "W_Prog"})
        if (name.starts_with(prefix)) return {std::nullopt, "pictures of this kind are not described"};
    ShadedCapture s;
    if (!take_shading(name, s)) return unknown_name;
    const std::string_view kind = take_until(name, "_"), shading = take_until(name, "_");
    if ((shading != "Smooth" && shading != "Flat") || (name != "First" && name != "Last")) return unknown_name;
    s.flat = shading == "Flat";
    s.provoking = name == "First" ? 0 : 1;
    for (const ShadedPrimitive& primitive : primitives()) {
        if (primitive.name != kind) continue;
        pipeline::Surface surface{profile, {}};
        surface.clear_color(unpack(0xff2c302e));
        const pipeline::Texture texture = checker(texels, 8, 0xffc0c020, 0xff700000);
        SplitDraw draw = shaded(primitive, s);
        surface.draw({.cull = rasterizer::CullFace::back,
                      .front_face = rasterizer::FrontFace::clockwise,
                      .texture = s.is_textured ? &texture : nullptr},
                     std::move(draw.soup), draw.primitive);
        return {SuitePicture{.image = surface.color(), .bound = bound_of(s)}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
