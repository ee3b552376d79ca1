// Suite Depth_Clamp. depth_clamp_W<w buffer>_C<clamp>_ZB<bias>_FR<full range>_VSH<vertex program>: which pixels a depth
// range removes one by one; the program adds the viewport's offset like the fixed-function pipeline.
// depth_equal[_WBuf]_Ofs<offset>: whether a floor that is drawn twice, with removal and with clamping, has the same
// depths. rasterizer/reference/chip-geometry.md 5.3.
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

// 2^24 - 1, the greatest code of the 24-bit buffer. Window z is in codes.
constexpr double units = 16777215.0;
constexpr Argb clear_code = 0xfe251135;
constexpr int checker_side = 256;
// World x, y, z.
using Point = std::array<double, 3>;

// A quad of world points in the window, with the viewport's offset and a whole texture.
TriangleSoup world_quad(const std::array<Point, 4>& corner, Argb color = 0xffffffff) {
    constexpr std::array<std::array<float, 2>, 4> texel{
        {{0, 0}, {checker_side, 0}, {checker_side, checker_side}, {0, checker_side}}};
    std::array<ClipVertex, 4> v;
    for (std::size_t i = 0; i < 4; ++i) {
        v[i] = project(corner[i][0], corner[i][1], corner[i][2], units, to_float(color));
        v[i].z = chip_window_z(static_cast<float>(corner[i][2]), units);
        v[i].x += viewport_offset;
        v[i].y += viewport_offset;
        v[i].texcoord = {texel[i][0], texel[i][1]};
    }
    TriangleSoup soup;
    add_quad(soup, v);
    return soup;
}

// Removes `key` and the digit 0 or 1 after it from the name. False if they are absent; the name may then be shortened.
bool take_flag(std::string_view& name, std::string_view key, bool& flag) {
    if (!take(name, key) || name.empty() || (name[0] != '0' && name[0] != '1')) return false;
    flag = name[0] == '1';
    name.remove_prefix(1);
    return true;
}

TriangleSoup floor() { return world_quad({{{-10, -2.5, 20}, {10, -2.5, 20}, {10, -2.5, 0}, {-10, -2.5, 0}}}); }

// The range of rasterizer/reference/chip-geometry.md 5.3: about w = 9 to 17. DrawState has limits from 0 to 1.
void limit(pipeline::DrawState& state, bool w_buffer) {
    if (w_buffer)
        limit_depth(state, 9.01f, 16.49f, units);
    else
        limit_depth(state, 14988020, 15869663, units);
}

pipeline::Surface cleared_surface(const pipeline::DeviceProfile& profile) {
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(clear_code));
    surface.clear_depth(0xffffff);
    return surface;
}

pipeline::DrawState first_state(bool w_buffer) {
    pipeline::DrawState state{.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = true}};
    if (w_buffer) state.depth_path = rasterizer::DepthPath::w_buffer;
    return state;
}

// Texels from the other side of a cell's edge, where a coordinate under perspective is close to it: none in the
// available captures.
constexpr Bound edge_texels{32, 255};

struct Clamping {
    bool w_buffer = false, clamp = false, bias = false, full = false;
};

SuitePicture clamped_picture(const pipeline::DeviceProfile& profile, const Clamping& c) {
    pipeline::Surface surface = cleared_surface(profile);
    const pipeline::Texture texture = checker(checker_side, 8, 0xff00ffff, 0xff000000);
    pipeline::DrawState state = first_state(c.w_buffer);
    state.texture = &texture;
    // Two posts, one near and one far, drawn with the full range.
    surface.draw(state, world_quad({{{-2, 2, 2}, {-1, 2, 2}, {-1, -6.5, 2}, {-2, -6.5, 2}}}));
    surface.draw(state, world_quad({{{1, 2, 10}, {2, 2, 10}, {2, -6.5, 10}, {1, -6.5, 10}}}));
    state.depth_clamp = c.clamp;
    if (!c.full) limit(state, c.w_buffer);
    if (c.bias) state.polygon_offset = {.enabled = true, .units = c.w_buffer ? -5.0f : -500000.0f};
    // The floor extends from z = 20 to 0 and leaves the range at both ends: fragments are removed there, not the
    // triangle.
    surface.draw(state, floor());
    return {.image = surface.color(), .bound = edge_texels};
}

// A floor that passes below the eye, drawn with removal in front of the range, then with clamping, in red, with EQUAL.
// For a w buffer it is a hundred times larger, and begins above the window's lower border.
SuitePicture equal_picture(const pipeline::DeviceProfile& profile, bool w_buffer, float offset) {
    const float scale = w_buffer ? 100.0f : 1.0f, far = 200.0f * scale - offset, near = -20.0f + offset;
    const double x = 10 * scale, y = -2.5 * scale;
    const std::array<Point, 4> corner{{{-x, y, far}, {x, y, far}, {x, y, near}, {-x, y, near}}};
    pipeline::Surface surface = cleared_surface(profile);
    pipeline::DrawState state = first_state(w_buffer);
    limit_depth(state, w_buffer ? 255.99f : 14988020.0f, units, units);
    surface.draw(state, world_quad(corner));
    state.depth_clamp = true;
    state.depth.func = pipeline::CompareFunc::equal;
    surface.draw(state, world_quad(corner, 0xffff0000));
    return {.image = surface.color()};
}

}  // namespace

Drawing draw_depth_clamp(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (take(name, "depth_equal")) {
        const bool w_buffer = take(name, "_WBuf");
        const auto offset = take(name, "_Ofs") ? to_number(name) : std::nullopt;
        const bool known = offset && *offset > 0.0f && *offset < 6.0f;  // the floor still extends behind the eye
        return known ? Drawing{equal_picture(profile, w_buffer, *offset), {}} : unknown_name;
    }
    Clamping c;
    bool by_program = false;  // does not change the picture
    const bool known = take_flag(name, "depth_clamp_W", c.w_buffer) && take_flag(name, "_C", c.clamp) &&
                       take_flag(name, "_ZB", c.bias) && take_flag(name, "_FR", c.full) &&
                       take_flag(name, "_VSH", by_program);
    if (!known || !name.empty()) return unknown_name;
    return {clamped_picture(profile, c), {}};
}

}  // namespace strata::hardware_check
