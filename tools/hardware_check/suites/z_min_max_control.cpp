// Suite ZMinMaxControl: Ctrl[_WBuf][_NEARFAR]_<ZCULL|ZCLAMP>[_IgnW]: what the depth range removes, fragments and whole
// triangles, by z or by w. chip-float-depth.md 5.1.
#include "tools/hardware_check/names.h"
#include "tools/hardware_check/shapes.h"
#include "tools/hardware_check/suite.h"

namespace strata::hardware_check {
namespace {

constexpr int columns = 5, rows = 8;
constexpr float size = 16, pitch = 20;
constexpr double units = 16777215.0;  // of the 24-bit buffer

// What a group's quads have at their left and right side: a constant pair, or a number that grows from quad to quad.
struct Sides {
    float left, right;
    [[nodiscard]] static Sides growing(int n) {
        constexpr float step = 150.0f / (columns * rows + 1);
        const float first = static_cast<float>(n) * step;
        return {first, first + 0.75f * step};
    }
};
struct Group {
    float x, y;
    Sides (*z)(int n);
    Sides (*w)(int n);
};

constexpr float group_pitch = 126.72f + 90.0f, upper = 60, lower = 252;
constexpr auto one = [](int) { return Sides{1, 1}; };
constexpr auto ten = [](int) { return Sides{10, 10}; };
constexpr auto through_range = [](int) { return Sides{8, 120}; };
constexpr auto small = [](int) { return Sides{0.01f, 0.0001f}; };
constexpr Group groups[] = {{90, upper, Sides::growing, one},
                            {90, lower, through_range, Sides::growing},
                            {90 + group_pitch, upper, Sides::growing, small},
                            {90 + group_pitch, lower, through_range, through_range},
                            {90 + 2 * group_pitch, upper, Sides::growing, Sides::growing},
                            {90 + 2 * group_pitch, lower, Sides::growing, ten}};

}  // namespace

Drawing draw_z_min_max_control(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name.starts_with("CtrlFixed_"))
        return {std::nullopt, "corners of w = 0 in the fixed pipeline are not described"};
    if (!take(name, "Ctrl_")) return unknown_name;
    const bool by_w = take(name, "WBuf_"), culls_triangles = take(name, "NEARFAR_");
    const bool clamps = take(name, "ZCLAMP");
    if (!clamps && !take(name, "ZCULL")) return unknown_name;
    take(name, "_IgnW");  // changes nothing
    if (!name.empty()) return unknown_name;

    constexpr Argb background = 0xff222228;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(background));
    surface.clear_depth(0xffffff);
    pipeline::DrawState state{.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = true},
                              .depth_clamp = clamps,
                              .range_culls_triangles = culls_triangles};
    limit_depth(state, 10, 100, units);
    if (by_w) state.depth_path = rasterizer::DepthPath::w_buffer;
    for (const Group& group : groups)
        for (int n = 0; n < columns * rows; ++n) {
            const float x = group.x + pitch * static_cast<float>(n % columns);
            const float y = group.y + pitch * static_cast<float>(n / columns);
            const Sides z = group.z(n), w = group.w(n);
            constexpr std::array<float, 4> white{1, 1, 1, 1};
            TriangleSoup soup;
            add_quad(soup, {at(x, y, z.left, white, w.left), at(x + size, y, z.right, white, w.right),
                            at(x + size, y + size, z.right, white, w.right), at(x, y + size, z.left, white, w.left)});
            surface.draw(state, std::move(soup));
        }
    return {Picture{.reading = Reading::drawn, .image = surface.color(), .background = unpack(background)}, {}};
}

}  // namespace strata::hardware_check
