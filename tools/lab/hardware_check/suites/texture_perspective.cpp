// Suite Texture_perspective: tex_<tex|diff>_pers_<y|n>_<quad|bitri>. A checkerboard, or four colours, on a quad whose w
// varies, with perspective correction and without; two corners are far outside the window.
// rasterizer/reference/chip-geometry.md 5.1.
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

// Texels per side.
constexpr int texels = 256;
constexpr float side = texels;

// A corner of the square of 3.5 world units, whose input w is not 1.
struct Corner {
    // World x and y; w is a factor of the camera's distance.
    double x, y, w;
    Argb color;
    std::array<float, 2> texel;
};

// A corner in the window, with the viewport's offset. Without correction all w are 1, so values are linear in the
// window.
ClipVertex vertex(const Corner& c, bool is_textured, bool corrected) {
    constexpr double distance = 7.0, scale = 240.0 * cotangent;
    const double w = distance * c.w;
    ClipVertex v = at(static_cast<float>(320.0 + scale * c.x / w + viewport_offset),
                      static_cast<float>(240.0 - scale * c.y / w + viewport_offset), 0,
                      to_float(is_textured ? 0xffffffff : c.color), corrected ? static_cast<float>(w) : 1.0f);
    v.texcoord = {c.texel[0], c.texel[1]};
    return v;
}

// Where 256 times a weight is close to an integer (rasterizer/reference/chip-float-depth.md 7).
constexpr Bound few_colors{5, 1};
// Texels from the other side of a cell's edge: none in the available captures, which do not include a quad.
constexpr Bound few_texels{5, 255};

}  // namespace

Drawing draw_texture_perspective(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_textured = take(name, "tex_tex_pers_");
    if (!is_textured && !take(name, "tex_diff_pers_")) return unknown_name;
    const bool corrected = take(name, "y_");
    if (!corrected && !take(name, "n_")) return unknown_name;
    const bool is_quad = name == "quad";
    if (!is_quad && name != "bitri") return unknown_name;

    // The third factor of w differs between the textured and the coloured pictures, as in the test.
    const std::array<Corner, 4> corners{{{-1.75, 1.75, 0.3, 0xffff0000, {0, 0}},
                                         {1.75, 1.75, 1, 0xff00ff00, {side, 0}},
                                         {1.75, -1.75, is_textured ? 3 : 0.3, 0xff0000ff, {side, side}},
                                         {-1.75, -1.75, 1, 0xffffffff, {0, side}}}};
    std::array<ClipVertex, 4> v;
    for (std::size_t i = 0; i < 4; ++i) v[i] = vertex(corners[i], is_textured, corrected);
    TriangleSoup soup;
    // The two splits of the same quad: along the corners 0 and 2, or 1 and 3.
    if (is_quad) {
        add_quad(soup, v);
    } else {
        add_triangle(soup, v[0], v[1], v[3]);
        add_triangle(soup, v[2], v[3], v[1]);
    }
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xfe251135));
    const pipeline::Texture texture = checker(texels, 8, 0xff00ffff, 0xff000000);
    surface.draw({.texture = is_textured ? &texture : nullptr}, std::move(soup));
    return {SuitePicture{.image = surface.color(),
                         .bound = !corrected    ? Bound{}
                                  : is_textured ? few_texels
                                                : few_colors},
            {}};
}

}  // namespace strata::hardware_check
