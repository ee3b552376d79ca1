// Suite 3D_primitive: <primitive>[-inlinebuf|-inlinearrays|-inlineelements][-ls][-ps]: smooth primitives with their own
// z, by four commands that draw alike. With -ls (smooth lines) or -ps (smooth polygons) the surface has two samples per
// pixel, and what is smooth is shown over older frames of the suite. pipeline/reference/fragment-stages.md 13.1,
// rasterizer/reference/chip-geometry.md 5.8, lines-and-points.md 3.
#include <vector>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

// World units.
constexpr double left = -2.75, right = 2.75, top = 1.75, bottom = -1.75, front = 1, back = 5;

struct ColoredPoint {
    double x, y, z;
    std::array<float, 3> color;
};

struct PointPrimitive {
    std::string_view name;
    Topology topology;
    std::vector<ColoredPoint> points;
};

// Six lines; points, strips and loops have the same vertices.
const std::vector<ColoredPoint> line_ends{{left, top, front, {.75f, .75f, .75f}},
                                          {right, top, front, {1, 1, 1}},
                                          {-2, 1, front, {1, 0, 0}},
                                          {2, 0, back, {1, 0, 0}},
                                          {1.5, 0.5, back, {0, 1, 0}},
                                          {-1.5, 0.75, back, {0, 1, 0}},
                                          {right, 0.25, front, {1, 1, 1}},
                                          {1.75, 1.25, front, {.15f, .15f, .15f}},
                                          {left, 1, front, {.25f, .25f, 1}},
                                          {left, -1, front, {.65f, .65f, 1}},
                                          {left, bottom, back, {0, 1, 1}},
                                          {right, bottom, back, {.5f, .5f, 1}}};

std::vector<PointPrimitive> primitives() {
    return {{"Points", Topology::points, line_ends},
            {"Lines", Topology::lines, line_ends},
            {"LineLoop", Topology::line_loop, line_ends},
            {"LineStrip", Topology::line_strip, line_ends},
            {"Triangles",
             Topology::triangles,
             {{left, top, front, {.25f, .25f, .25f}},
              {0, top, front, {.55f, .55f, .55f}},
              {left, 0, front, {.75f, .75f, .75f}},
              {right, top, front, {.8f, .25f, .1f}},
              {0.1, bottom, back, {.1f, .85f, .1f}},
              {0.25, 0, front, {.1f, .25f, .9f}},
              {-0.4, bottom, back, {.8f, .25f, .9f}},
              {-1.4, -1.4, back, {.1f, .85f, .9f}},
              {0, 0, back, {.85f, .95f, .1f}}}},
            {"TriStrip",
             Topology::triangle_strip,
             {{left, 0, front, {1, 0, 0}},
              {-2.25, top, front, {0, 1, 0}},
              {-2, bottom, front, {0, 0, 1}},
              {-1.3, 1.6, 1.15, {.25f, 0, .8f}},
              {0, -1.5, 1.3, {.75f, 0, .25f}},
              {0.4, 1, 1.7, {.33f, .33f, .33f}},
              {1.4, -0.6, back, {.7f, .7f, .7f}},
              {right, top, back, {.5f, .5f, .6f}}}},
            {"TriFan",
             Topology::triangle_fan,
             {{0, -0.75, front, {1, 1, 1}},
              {-2.25, bottom, front, {0, 0, 1}},
              {-2, top, front, {0, 1, 0}},
              {-0.6, 0.65, 1.15, {.25f, 0, .8f}},
              {0, 1.5, 1.3, {.75f, 0, .25f}},
              {0.4, 1, 1.7, {.33f, .33f, .33f}},
              {2.4, 0.6, back, {.7f, .7f, .7f}},
              {right, bottom, back, {.5f, .5f, .6f}}}},
            {"Quads",
             Topology::quads,
             {{left, top, front, {1, 1, 1}},
              {-0.6, 1.6, 1.7, {.5f, .5f, .6f}},
              {-1.35, -0.6, 1.7, {.7f, .7f, .7f}},
              {-2.4, bottom, 1.7, {.33f, .33f, .33f}},
              {0.06, -0.09, front, {1, 0, 1}},
              {1.9, -0.25, front, {.1f, .3f, .6f}},
              {2.62, -1.03, front, {1, 1, 0}},
              {1.25, -1.65, front, {0, 1, 1}},
              {-1.25, 1.3, back, {.25f, .25f, .25f}},
              {0.3, 1.25, back, {.1f, .3f, .1f}},
              {2.62, -0.03, back, {.65f, .65f, .65f}},
              {-1, -1, back, {.45f, .45f, .45f}}}},
            {"QuadStrip",
             Topology::quad_strip,
             {{left, bottom, front, {.33f, .33f, .33f}},
              {left, top, front, {1, 1, 1}},
              {0, -1.35, front, {.7f, .1f, 0}},
              {0, 1, front, {0, .9f, .2f}},
              {right, bottom, front, {.33f, .33f, .33f}},
              {right, top, front, {0, .7f, .9f}}}},
            {"Polygon",
             Topology::polygon,
             {{left, bottom, front, {.33f, .33f, .33f}},
              {-1.4, 1.1, front, {.7f, .1f, 0}},
              {-0.3, top, front, {.1f, .7f, .5f}},
              {2, 0.3, front, {0, .9f, .2f}},
              {right, -1.5, front, {.7f, .7f, .7f}}}}};
}

// The primitive at the samples that are `shift` pixels to the left and above the pixels' centres. The test's lines are
// thin unless they are smooth.
pipeline::Image at_samples(const PointPrimitive& primitive, const pipeline::DeviceProfile& profile, float shift,
                           const pipeline::DrawState& state = {.line_style = rasterizer::LineStyle::thin}) {
    constexpr double units = 65535;
    std::vector<ClipVertex> vertices;
    for (const ColoredPoint& p : primitive.points) {
        ClipVertex& v = vertices.emplace_back(project(p.x, p.y, p.z, units, {p.color[0], p.color[1], p.color[2], 1}));
        v.x += viewport_offset + shift;
        v.y += viewport_offset + shift;
    }
    SplitDraw draw = split_draw(primitive.topology, vertices, PolygonMode::fill);
    pipeline::Surface surface{profile, {.depth = pipeline::DepthFormat::d16}};
    surface.clear_color(unpack(0xff303030));
    surface.clear_depth(0xffff);
    pipeline::DrawState tested = state;
    tested.depth.enabled = true;
    surface.draw(tested, std::move(draw.soup), draw.primitive);
    return surface.color();
}

// The smooth primitive is blended into its surface, with alpha, and the surface's centres are blended over what older
// frames left: the picture without smoothing, and `frames` such pictures.
pipeline::Image smooth_over_older(const PointPrimitive& primitive, const pipeline::DeviceProfile& profile, int frames) {
    const pipeline::Texture surface =
        as_texture(at_samples(primitive, profile, 0,
                              {.blend = pipeline::blend_mode::over,
                               .line_style = rasterizer::LineStyle::smooth,
                               .smooth_polygons = primitive.topology > Topology::line_strip}));
    pipeline::Surface window{profile, {}};
    place(window, as_texture(at_samples(primitive, profile, 0)), 0, 0, {});
    for (int i = 0; i < frames; ++i) place(window, surface, 0, 0, {.blend = pipeline::blend_mode::over});
    return window.color();
}

// A surface of two samples per pixel as a texture of twice the width, whose columns are corners and centres
// alternately.
pipeline::Texture side_by_side(const pipeline::Image& corners, const pipeline::Image& centres) {
    pipeline::Image all{pipeline::Format::rgba8, 2 * corners.width, corners.height};
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x)
            for (int c = 0; c < 4; ++c) {
                const pipeline::Image& samples = x % 2 == 0 ? corners : centres;
                all.codes[all.index(x, y, c)] = samples.codes[samples.index(x / 2, y, c)];
            }
    return as_texture(all);
}

// The test draws that texture over the whole window, point-sampled: column 2 x + 1 begins at the centre of pixel x.
pipeline::Image shown(const pipeline::Texture& texture, const pipeline::DeviceProfile& profile) {
    constexpr float width = picture_width, height = picture_height;
    TriangleSoup soup = box({0, 0, width, height}, 0xffffffff);
    for (ClipVertex& v : soup.vertices) v.texcoord = {2 * v.x, v.y};
    pipeline::Surface window{profile, {}};
    window.draw({.texture = &texture}, std::move(soup));
    return window.color();
}

}  // namespace

Drawing draw_three_d_primitive(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool smooth_polygons = take_last(name, "-ps"), smooth_lines = take_last(name, "-ls");
    bool is_inline = false;
    for (const std::string_view command : {"-inlinebuf", "-inlinearrays", "-inlineelements"})
        if (take_last(name, command)) {
            is_inline = true;
            break;
        }
    for (const PointPrimitive& primitive : primitives()) {
        if (primitive.name != name) continue;
        if (primitive.topology <= Topology::line_strip) {
            if (smooth_lines && primitive.topology != Topology::points)
                return {SuitePicture{.image = smooth_over_older(primitive, profile, smooth_polygons ? 2 : 3)}, {}};
            return {SuitePicture{.image = at_samples(primitive, profile, 0)}, {}};
        }
        // A pixel where 256 times a weight is close to an integer differs by one unit, as in Shade_model.
        constexpr Bound near_integer{2, 1};
        if (smooth_polygons) {
            // Three pixels of TriStrip, where its triangles fold, are not explained.
            const Bound bound = name == "TriStrip" ? Bound{3, 103} : near_integer;
            const int frames = is_inline ? 1 : smooth_lines ? 3 : 2;
            return {SuitePicture{.image = smooth_over_older(primitive, profile, frames), .bound = bound}, {}};
        }
        const pipeline::Image centres = at_samples(primitive, profile, 0);
        if (!smooth_lines) return {SuitePicture{.image = centres, .bound = near_integer}, {}};
        const pipeline::Texture texture = side_by_side(at_samples(primitive, profile, 0.5f), centres);
        return {SuitePicture{.image = shown(texture, profile), .bound = near_integer}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
