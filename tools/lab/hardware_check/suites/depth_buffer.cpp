// Suites Depth_buffer: DepthFmt_<z16|z24>_C<y|n>_FZ<y|n>_M<clear>[_ZB], depth words or colours, and
// Depth_buffer_fixed_function, the same without DepthFmt_. Slopes of depth over small and wide quads.
// rasterizer/reference/chip-depth.md 2, rasterizer/reference/chip-geometry.md 5.4.
#include <bit>
#include <vector>

#include "rasterizer/rules/depth_code.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::DepthFormat;

// The settings in a capture's name. `clear` is a code of `format`; `is_float` is FZy, and `shows_depth` is _ZB.
struct DepthBufferCapture {
    DepthFormat format = DepthFormat::d16;
    std::uint32_t clear = 0;
    bool is_float = false, shows_depth = false;
};

// The greatest code that the test uses: for 24-bit floats the last finite number.
std::uint32_t greatest_code(DepthFormat format) {
    return format == DepthFormat::d24f ? 0xfeffffu : rasterizer::max_code(format);
}

// Parses names such as z16_Cn_FZn_M00ffff. C is whether the chip compresses the buffer, which does not change stored
// values. A clear word above the format's greatest code is not a name of the suite.
std::optional<DepthBufferCapture> parse(std::string_view name) {
    DepthBufferCapture s;
    s.shows_depth = take_last(name, "_ZB");
    const std::string_view format = take_until(name, "_");
    if (format != "z16" && format != "z24") return std::nullopt;
    if (!take(name, "Cn_") && !take(name, "Cy_")) return std::nullopt;
    s.is_float = take(name, "FZy_");
    if (!s.is_float && !take(name, "FZn_")) return std::nullopt;
    const auto clear = take(name, "M") ? to_hexadecimal(name) : std::nullopt;
    if (!clear) return std::nullopt;
    s.clear = *clear;
    s.format = format == "z24" ? (s.is_float ? DepthFormat::d24f : DepthFormat::d24)
                               : (s.is_float ? DepthFormat::d16f : DepthFormat::d16);
    if (s.clear > greatest_code(s.format)) return std::nullopt;
    return s;
}

using Color = std::array<float, 4>;

// A quad with its own depth at every corner. Corners are in the order upper left, upper right, lower right, lower left.
struct Slope {
    Box where;
    // Window z in the buffer's own values; for world_slopes() world z.
    std::array<float, 4> z;
    std::array<Color, 4> color{};
};

[[nodiscard]] Color rgb(float r, float g, float b) { return {r, g, b, 1}; }
// A grey from 0.25 to 1 for a fraction of the depth range, 0 to 1.
[[nodiscard]] Color grey(float share) {
    const float v = 0.25f + share * 0.75f;
    return rgb(v, v, v);
}

// Window z of code `k`, in the buffer's own values: the code for a fixed-point format, the code's number for a float
// format.
float value_of(DepthFormat format, float k) {
    const auto code = static_cast<std::uint32_t>(k);
    if (format == DepthFormat::d16f) return rasterizer::d16f_value(code);
    return format == DepthFormat::d24f ? std::bit_cast<float>(code << 7) : k;
}

// The quads of rasterizer/reference/chip-depth.md 2: a grid of 31 x 32 with depths that increase from quad to quad,
// then three wide ones. All in binary32, as in the test.
std::vector<Slope> window_slopes(DepthFormat format) {
    constexpr int columns = 31, rows = 32;
    const std::uint32_t max = greatest_code(format);
    // The test divides by the number of its quads plus one, so the last depth is below the greatest code.
    const float step = static_cast<float>(max) / static_cast<float>(columns * rows + 3 + 1);
    // Depths are truncated to whole codes, at least 0.
    const auto cut = [&](float k) {
        return value_of(format, static_cast<float>(static_cast<std::int64_t>(k > 0 ? k : 0)));
    };
    std::vector<Slope> slopes;
    // `z_left` is accumulated in binary32 with the test's own rounding errors: a product would not give the same codes.
    float z_left = 0, offset = step * 0.75f;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float x = 134.0f + 12.0f * static_cast<float>(column), y = 48.0f + 12.0f * static_cast<float>(row);
            const float left = cut(z_left), right = cut(z_left + offset), scale = static_cast<float>(max);
            const Color on_left = grey(z_left / scale), on_right = grey((z_left + offset) / scale);
            slopes.push_back(
                {{x, y, x + 8, y + 8}, {left, right, right, left}, {on_left, on_right, on_right, on_left}});
            z_left += step;
            offset = -offset;
        }
    const auto code = [&](std::uint32_t k) { return value_of(format, static_cast<float>(k)); };
    const auto share = [&](float z) { return z / static_cast<float>(max); };
    // (max - 1) * 3 / 4 is the test's integer arithmetic; it fits into 32 bits, because max is below 2^24.
    const float back = code((max - 1) * 3 / 4), near = code(0);
    const Color far_left = rgb(share(back), 0.75f, share(back)), near_right = rgb(0.75f, share(near), share(near));
    slopes.push_back({{132, 430, 492, 435}, {back, near, near, back}, {far_left, near_right, near_right, far_left}});
    const float first = code(1), half = code(max / 2);
    const Color upper = rgb(share(first), 0.5f, share(first)), lower = rgb(0.5f, share(half), share(half));
    slopes.push_back({{502, 45, 510, 435}, {first, first, half, half}, {upper, upper, lower, lower}});
    // max * 2 is computed in 64 bits, and the quotient is truncated.
    const float top = code(static_cast<std::uint32_t>(std::uint64_t{max - 1} * 2 / 3)), end = code(max - 1);
    slopes.push_back(
        {{128, 40, 512, 440}, {top, top, end, end}, {rgb(0, 1, 0), rgb(1, 0, 0), rgb(0.4f, 0.3f, 0), rgb(0, 0, 1)}});
    return slopes;
}

// The quads of rasterizer/reference/chip-geometry.md 5.4 with world z at their corners, for the fixed-function
// pipeline.
std::vector<Slope> world_slopes() {
    constexpr float near = -6, far = 193;
    constexpr int columns = 18, rows = 18;
    const float step = (far - near) / static_cast<float>(columns * rows + 3 + 1);
    std::vector<Slope> slopes;
    float z_left = near, offset = step * 0.75f;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float x = 136.0f + 20.0f * static_cast<float>(column), y = 56.0f + 20.0f * static_cast<float>(row);
            const float right = z_left + offset;
            const Color on_left = grey(z_left / far), on_right = grey(right / far);
            slopes.push_back(
                {{x, y, x + 16, y + 16}, {z_left, right, right, z_left}, {on_left, on_right, on_right, on_left}});
            z_left += step;
            offset = -offset;
        }
    // Fractions below 0, for depths in front of the eye's plane, are not colours: vertex colours are clamped.
    const Color deep_left = rgb(0.75f, 0.75f, 0.75f), near_right = rgb(0.75f, 0, 0), near_top = rgb(0, 0.5f, 0);
    slopes.push_back(
        {{132, 422, 492, 427}, {far * 0.75f, near, near, far * 0.75f}, {deep_left, near_right, near_right, deep_left}});
    const Color half = rgb(0.5f, 0.5f, 0.5f);
    slopes.push_back({{502, 53, 510, 427}, {near, near, far * 0.5f, far * 0.5f}, {near_top, near_top, half, half}});
    slopes.push_back({{128, 48, 512, 432},
                      {far * 2.0f / 3.0f, far * 2.0f / 3.0f, far, far},
                      {rgb(0, 1, 0), rgb(1, 0, 0), rgb(0.4f, 0.3f, 0), rgb(0, 0, 1)}});
    return slopes;
}

// Adds a slope's two triangles, (UL, UR, LR) and (UL, LR, LL). The order matters, because weights depend on which
// corner of a triangle is first.
void add_slope(TriangleSoup& soup, const Slope& s) {
    const Box& b = s.where;
    const auto corner = [&](float x, float y, std::size_t k) { return at(x, y, s.z[k], s.color[k]); };
    add_quad(soup, {corner(b.left, b.top, 0), corner(b.right, b.top, 1), corner(b.right, b.bottom, 2),
                    corner(b.left, b.bottom, 3)});
}

// The same for a slope in the world, as (UL, LR, LL) and (UL, UR, LR): the host un-projects the corners, and the
// fixed-function pipeline projects them again. The test lists its corners in another order than its colours: those of
// UR and LL are exchanged.
void add_world_slope(TriangleSoup& soup, const Slope& s, const HostCamera& camera) {
    const CompositeMatrix to_window = columns_of(camera.composite);
    const auto corner = [&](float window_x, float window_y, std::size_t k, std::size_t color) {
        const auto [x, y, z, w] = chip_window_point(to_window, unprojected(camera, window_x, window_y, s.z[k]));
        return at(x, y, z, s.color[color], w);
    };
    const Box& b = s.where;
    const ClipVertex ul = corner(b.left, b.top, 0, 0), ur = corner(b.right, b.top, 1, 3);
    const ClipVertex lr = corner(b.right, b.bottom, 2, 2), ll = corner(b.left, b.bottom, 3, 1);
    add_triangle(soup, ul, lr, ll);
    add_triangle(soup, ul, ur, lr);
}

// Draws the soup with LESS over the clear word of `s`; the picture has depths or colours according to the name.
SuitePicture depth_picture(const pipeline::DeviceProfile& profile, const DepthBufferCapture& s, TriangleSoup soup) {
    pipeline::Surface surface{profile, {.depth = s.format}};
    surface.clear_color(unpack(0xff000000));
    surface.clear_depth(s.clear);
    surface.draw({.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = true}}, std::move(soup));
    if (!s.shows_depth) return {.image = surface.color()};
    return {.reading = s.format == DepthFormat::d24 || s.format == DepthFormat::d24f ? CaptureFormat::depth24
                                                                                     : CaptureFormat::depth16,
            .image = surface.depth()};
}

// The greatest window z of the fixed-function pipeline, in the buffer's own values, which the test uses in its matrix.
float fixed_scale(DepthFormat format) {
    return format == DepthFormat::d16f ? 511.9375f : static_cast<float>(rasterizer::max_code(format));
}

}  // namespace

Drawing draw_depth_buffer(std::string_view name, const pipeline::DeviceProfile& profile) {
    const auto setting = take(name, "DepthFmt_") ? parse(name) : std::nullopt;
    if (!setting) return unknown_name;
    TriangleSoup soup;
    for (const Slope& slope : window_slopes(setting->format)) add_slope(soup, slope);
    return {depth_picture(profile, *setting, std::move(soup)), {}};
}

Drawing draw_depth_buffer_fixed_function(std::string_view name, const pipeline::DeviceProfile& profile) {
    const auto setting = parse(name);
    if (!setting) return unknown_name;
    if (setting->format == DepthFormat::d24f)
        return {std::nullopt, "the fixed pipeline's scale of 24-bit float depth is beyond binary32"};
    const HostCamera camera = default_camera(fixed_scale(setting->format));
    TriangleSoup soup;
    for (const Slope& slope : world_slopes()) add_world_slope(soup, slope, camera);
    SuitePicture picture = depth_picture(profile, *setting, std::move(soup));
    // 24 words of the right strip: the last bits of its area's reciprocal are unknown
    // (rasterizer/reference/chip-depth.md 4).
    if (setting->format == DepthFormat::d24 && setting->shows_depth) picture.bound = {24, 1};
    // Colours where w varies, next to a step of a weight (rasterizer/reference/chip-float-depth.md 7).
    if (!setting->shows_depth) picture.bound = {5, 1};
    return {std::move(picture), {}};
}

}  // namespace strata::hardware_check
