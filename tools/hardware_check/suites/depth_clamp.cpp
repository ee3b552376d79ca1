// Suite Depth_Clamp: depth_clamp_W<w buffer>_C<clamp>_ZB<bias>_FR<full range>_VSH<vertex program>. Which pixels a
// depth range removes, one by one; the program adds the viewport's offset like the fixed pipeline.
// chip-geometry.md 5.3.
#include "tools/hardware_check/fixed_pipeline.h"
#include "tools/hardware_check/names.h"
#include "tools/hardware_check/shapes.h"
#include "tools/hardware_check/suite.h"

namespace strata::hardware_check {
namespace {

// 2^24 - 1, the greatest code of the 24-bit buffer. Window z counts in codes.
constexpr double units = 16777215.0;
constexpr std::array<float, 4> white{1, 1, 1, 1};
// World x, y, z.
using Point = std::array<double, 3>;

// A white quad of world points in the window, with the viewport's offset.
TriangleSoup world_quad(const std::array<Point, 4>& corner) {
    std::array<ClipVertex, 4> v;
    for (std::size_t i = 0; i < 4; ++i) {
        v[i] = project(corner[i][0], corner[i][1], corner[i][2], units, white);
        v[i].x += viewport_offset;
        v[i].y += viewport_offset;
    }
    TriangleSoup soup;
    add_quad(soup, v);
    return soup;
}

// Takes `key` and the digit 0 or 1 behind it off the name. False if they do not stand there; the
// name may then be shortened.
bool take_flag(std::string_view& name, std::string_view key, bool& flag) {
    if (!take(name, key) || name.empty() || (name[0] != '0' && name[0] != '1')) return false;
    flag = name[0] == '1';
    name.remove_prefix(1);
    return true;
}

TriangleSoup floor() { return world_quad({{{-10, -2.5, 20}, {10, -2.5, 20}, {10, -2.5, 0}, {-10, -2.5, 0}}}); }

// The range of chip-geometry.md 5.3: about w = 9 to 17. DrawState takes limits from 0 to 1.
void limit(pipeline::DrawState& state, bool w_buffer) {
    if (w_buffer)
        limit_depth(state, 9.01f, 16.49f, units);
    else
        limit_depth(state, 14988020, 15869663, units);
}

}  // namespace

Drawing draw_depth_clamp(std::string_view name, const pipeline::DeviceProfile& profile) {
    bool w_buffer = false, clamp = false, bias = false, full = false, by_program = false;
    const bool known = take_flag(name, "depth_clamp_W", w_buffer) && take_flag(name, "_C", clamp) &&
                       take_flag(name, "_ZB", bias) && take_flag(name, "_FR", full) &&
                       take_flag(name, "_VSH", by_program);
    if (name.starts_with("depth_equal_")) return {std::nullopt, "the place of its floor is not described"};
    if (!known || !name.empty()) return unknown_name;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xfe251135));
    surface.clear_depth(0xffffff);
    pipeline::DrawState state{.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = true}};
    if (w_buffer) state.depth_path = rasterizer::DepthPath::w_buffer;
    // Two posts, one near and one far, drawn with the full range.
    surface.draw(state, world_quad({{{-2, 2, 2}, {-1, 2, 2}, {-1, -6.5, 2}, {-2, -6.5, 2}}}));
    surface.draw(state, world_quad({{{1, 2, 10}, {2, 2, 10}, {2, -6.5, 10}, {1, -6.5, 10}}}));
    state.depth_clamp = clamp;
    if (!full) limit(state, w_buffer);
    if (bias) state.polygon_offset = {.enabled = true, .units = w_buffer ? -5.0f : -500000.0f};
    // The floor goes from z = 20 to 0 and leaves the range at both ends: fragments are removed
    // there, not the triangle.
    surface.draw(state, floor());
    return {Picture{.reading = Reading::drawn, .image = surface.color(), .background = unpack(0xfe251135)}, {}};
}

}  // namespace strata::hardware_check
