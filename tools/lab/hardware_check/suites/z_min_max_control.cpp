// Suite ZMinMaxControl: Ctrl[Fixed][_WBuf][_NEARFAR]_<ZCULL|ZCLAMP>[_IgnW]: the fragments and whole triangles that the
// depth range removes, by z or by w. rasterizer/reference/chip-float-depth.md 5.1.
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

constexpr int columns = 5, rows = 8;
constexpr float size = 16, pitch = 20;
constexpr double units = 16777215.0;  // of the 24-bit buffer

using Color = std::array<float, 4>;

// The values of a group's quads at their left and right side.
template <class T>
struct Sides {
    T left, right;
};

// A number that grows from quad to quad, accumulated in binary32 as in the test.
Sides<float> growing(int n) {
    constexpr float step = 150.0f / (columns * rows + 1);
    float first = 0;
    for (int i = 0; i < n; ++i) first += step;
    return {first, first + 0.75f * step};
}
// A grey from 0.25 to 1 for such a number.
Sides<float> grey(int n) {
    const Sides<float> v = growing(n);
    return {0.25f + v.left / 150.0f * 0.75f, 0.25f + v.right / 150.0f * 0.75f};
}

struct QuadGroup {
    float x, y;
    Sides<float> (*z)(int n);
    Sides<float> (*w)(int n);
    Sides<Color> (*color)(float left, float right);  // computed from the two greys
};

constexpr float group_pitch = 126.72f + 90.0f, upper = 60, lower = 252;
constexpr auto one = [](int) { return Sides<float>{1, 1}; };
constexpr auto ten = [](int) { return Sides<float>{10, 10}; };
constexpr auto through_range = [](int) { return Sides<float>{8, 120}; };
constexpr auto small = [](int) { return Sides<float>{0.01f, 0.0001f}; };
constexpr QuadGroup groups[] = {{90, upper, growing, one,
                                 [](float l, float r) {
                                     return Sides<Color>{{l, l, l, 1}, {r, r, r, 1}};
                                 }},
                                {90, lower, through_range, growing,
                                 [](float l, float r) {
                                     return Sides<Color>{{.33f, .25f, l, 1}, {.33f, .25f, r, 1}};
                                 }},
                                {90 + group_pitch, upper, growing, small,
                                 [](float l, float r) {
                                     return Sides<Color>{{.75f, l, l, 1}, {r, r, .8f, 1}};
                                 }},
                                {90 + group_pitch, lower, through_range, through_range,
                                 [](float, float) {
                                     return Sides<Color>{{.33f, .75f, .25f, 1}, {.33f, .75f, .8f, 1}};
                                 }},
                                {90 + 2 * group_pitch, upper, growing, growing,
                                 [](float l, float r) {
                                     return Sides<Color>{{l, .25f, l, 1}, {r, .25f, r, 1}};
                                 }},
                                {90 + 2 * group_pitch, lower, growing, ten, [](float l, float r) {
                                     return Sides<Color>{{l, l, .25f, 1}, {r, r, .8f, 1}};
                                 }}};

// The host's camera for the pictures with the fixed-function pipeline: three units back, and an orthographic view from
// `near` to `far`, which are also the chip's range.
HostCamera orthographic_camera() {
    const HostMatrix back{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, -3, 1}}};
    return camera_of(back, orthographic_to_window(10, 100));
}

// A corner through the fixed-function pipeline: the host un-projects it and multiplies by w, and the chip divides by
// that again. If w is 0 all products are 0, and the corner is at the window's.
ClipVertex through_pipeline(const ClipVertex& v, const HostCamera& camera) {
    const HostVector world = unprojected_point(camera, {v.x, v.y, v.z, 1});
    const auto [x, y, z, w] =
        chip_window_point(columns_of(camera.composite), {world[0] * v.w, world[1] * v.w, world[2] * v.w, v.w});
    ClipVertex projected = v;
    projected.x = x;
    projected.y = y;
    projected.z = z;
    projected.w = w;
    return projected;
}

}  // namespace

Drawing draw_z_min_max_control(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_fixed = take(name, "CtrlFixed_");
    if (!is_fixed && !take(name, "Ctrl_")) return unknown_name;
    const bool by_w = take(name, "WBuf_"), culls_triangles = take(name, "NEARFAR_");
    const bool clamps = take(name, "ZCLAMP");
    if (!clamps && !take(name, "ZCULL")) return unknown_name;
    take(name, "_IgnW");  // does not change the picture
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
    const HostCamera camera = orthographic_camera();
    for (const QuadGroup& group : groups)
        for (int n = 0; n < columns * rows; ++n) {
            const float x = group.x + pitch * static_cast<float>(n % columns);
            const float y = group.y + pitch * static_cast<float>(n / columns);
            const Sides<float> z = group.z(n), w = group.w(n), greys = grey(n);
            const Sides<Color> color = group.color(greys.left, greys.right);
            TriangleSoup soup;
            std::array<ClipVertex, 4> corner{
                at(x, y, z.left, color.left, w.left), at(x + size, y, z.right, color.right, w.right),
                at(x + size, y + size, z.right, color.right, w.right), at(x, y + size, z.left, color.left, w.left)};
            if (is_fixed)
                for (ClipVertex& v : corner) v = through_pipeline(v, camera);
            add_quad(soup, corner);
            surface.draw(state, std::move(soup));
        }
    // Colours where 256 times a weight is close to an integer: none in the available captures
    // (rasterizer/reference/chip-float-depth.md 7).
    return {SuitePicture{.image = surface.color(), .bound = {16, 1}}, {}};
}

}  // namespace strata::hardware_check
