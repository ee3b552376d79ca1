// Suite W_buffering: <Z|W>Buf<16|24><D|F>_<shape>[-left-top]_V<program>_ZB<bias>_ZS<slope>[_ZB]: depth formats, polygon
// offset and the w buffer over wide shapes whose corners are far outside the window.
// rasterizer/reference/chip-float-depth.md 9.1.
#include "rasterizer/rules/depth_code.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::DepthFormat;
using rasterizer::DepthPath;

// The default start of the window clip.
constexpr int default_left = 150, default_top = 0;

// The settings in a capture's name.
struct BufferSetting {
    bool is_w = false, is_float = false, is_16 = false, by_program = false, has_bias = false, has_slope = false,
         shows_depth = false;
    std::string_view shape;
    int left = default_left, top = default_top;

    [[nodiscard]] DepthFormat format() const {
        if (is_16) return is_float ? DepthFormat::d16f : DepthFormat::d16;
        return is_float ? DepthFormat::d24f : DepthFormat::d24;
    }
};

// A digit 0 or 1 after `key`.
std::optional<bool> take_bit(std::string_view& name, std::string_view key) {
    if (!take(name, key) || name.empty() || (name[0] != '0' && name[0] != '1')) return std::nullopt;
    const bool bit = name[0] == '1';
    name.remove_prefix(1);
    return bit;
}

// Three decimal digits after a dash, as in ClipF and ClipW.
std::optional<int> take_three_digits(std::string_view& name) {
    if (!take(name, "-") || name.size() < 3) return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (name[i] < '0' || name[i] > '9') return std::nullopt;
        value = 10 * value + (name[i] - '0');
    }
    name.remove_prefix(3);
    return value;
}

std::optional<BufferSetting> parse_buffer_setting(std::string_view name) {
    BufferSetting s;
    s.is_w = name.starts_with("W");
    if (!take(name, "WBuf") && !take(name, "ZBuf")) return std::nullopt;
    s.is_16 = name.starts_with("16");
    if (!take(name, "16") && !take(name, "24")) return std::nullopt;
    s.is_float = name.starts_with("F");
    if (!take(name, "D_") && !take(name, "F_")) return std::nullopt;
    s.shape = name.substr(0, name.find_first_of("-_"));
    name.remove_prefix(s.shape.size());
    if (name.starts_with("-")) {
        const auto left = take_three_digits(name), top = take_three_digits(name);
        if (!left || !top) return std::nullopt;
        s.left = *left;
        s.top = *top;
    }
    const auto program = take_bit(name, "_V"), bias = take_bit(name, "_ZB"), slope = take_bit(name, "_ZS");
    if (!program || !bias || !slope) return std::nullopt;
    s.by_program = *program;
    s.has_bias = *bias;
    s.has_slope = *slope;
    s.shows_depth = take(name, "_ZB");
    return name.empty() ? std::optional<BufferSetting>{s} : std::nullopt;
}

// Window x, y, z and w, as output by the pass-through program.
struct WindowPoint {
    float x, y, z, w;
    std::optional<std::array<float, 2>> texture{};  // coordinates in multiples of the texture's size
};

// The two depths of the wide shapes.
constexpr WindowPoint far_at(float x, float y) { return {x, y, 16809768.0f, 325.8057861328125f}; }
constexpr WindowPoint near_at(float x, float y) { return {x, y, 16572698.0f, 58.379993438720703f}; }

// Adds a triangle whose corners have the first three corners of the texture.
void add(TriangleSoup& soup, std::array<WindowPoint, 3> p) {
    constexpr std::array<std::array<float, 2>, 3> texture{{{0, 0}, {1, 0}, {1, 1}}};
    const auto vertex = [](const WindowPoint& q, const std::array<float, 2>& own) {
        ClipVertex v = at(q.x, q.y, q.z, {1, 1, 1, 1}, q.w);
        v.texcoord = q.texture.value_or(own);
        return v;
    };
    add_triangle(soup, vertex(p[0], texture[0]), vertex(p[1], texture[1]), vertex(p[2], texture[2]));
}
// Adds a quad with `repeats` textures in each direction; if not `upright`, its first corner has the lower left corner
// of the texture.
void add(TriangleSoup& soup, std::array<WindowPoint, 4> p, bool upright = true, float repeats = 1) {
    const std::array<std::array<float, 2>, 4> texture{{{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}}};
    for (std::size_t i = 0; i < 4; ++i) p[i].texture = texture[upright ? i : 3 - i];
    add(soup, std::array{p[0], p[1], p[2]});
    add(soup, std::array{p[0], p[2], p[3]});
}

// 24 slivers each, side by side or one below the other, from 325 down to 58; z and w are equal.
void add_slivers(TriangleSoup& soup, bool horizontal) {
    for (int i = 0; i < 24; ++i) {
        const auto n = static_cast<float>(i);
        if (horizontal) {
            const float x = 160 + 20 * n + 0.5f, y = n + 0.5f;
            add(soup, std::array<WindowPoint, 3>{{{x, y, 325, 325}, {x + 10, y, 325, 325}, {x, y + 199.5f, 58, 58}}});
        } else {
            const float x = 160 + n + 0.5f, y = 20 * n + 0.5f;
            add(soup, std::array<WindowPoint, 3>{{{x, y, 325, 325}, {x + 199.5f, y, 58, 58}, {x, y + 10, 325, 325}}});
        }
    }
}

constexpr float large = 16777046.0f;

// A shape of the table; empty for an unknown name.
std::optional<TriangleSoup> shape_of(const BufferSetting& s) {
    TriangleSoup soup;
    const bool clipped_floor = s.shape == "ClipF", clipped_wall = s.shape == "ClipW";
    if (s.shape == "FloorQuad" || clipped_floor) {
        add(soup, std::array{far_at(53.1875f, -34.3125f), far_at(586.75f, -34.3125f), near_at(1808.6875f, 453),
                             near_at(-1168.6875f, 453)});
    } else if (s.shape == "RoofQuad") {
        add(soup,
            std::array{near_at(-1168.6875f, 0), near_at(1808.6875f, 0), far_at(586.75f, 487.3125f),
                       far_at(53.1875f, 487.3125f)},
            false);
    } else if (s.shape == "WallQuad" || clipped_wall) {
        add(soup, std::array{far_at(637.3125f, -26.8125f), far_at(637.3125f, 506.75f), near_at(150, 1728.6875f),
                             near_at(150, -1248.6875f)});
    } else if (s.shape == "LargeZ") {
        add(soup, std::array<WindowPoint, 4>{{{0, 0, large, large},
                                              {640, 0, large, large},
                                              {640, 480, large + 1, large + 1},
                                              {0, 480, large + 1, large + 1}}});
    } else if (s.shape == "TriH" || s.shape == "TriV") {
        add_slivers(soup, s.shape == "TriH");
    } else if (s.shape == "Riddick" && s.is_w) {
        add(soup, std::array<WindowPoint, 3>{{{-12630.8125f, 21456.1875f, 0, 2026.6815f},
                                              {270.4375f, 266.5f, 0, 668074.8125f},
                                              {317.25f, 262.375f, 0, 714052.1875f}}});
    } else if ((s.shape == "Trunc0" || s.shape == "TruncNeg") && !s.is_w) {
        // Just inside the step of 1/16 pixel above the window, and exactly on it.
        const float y = s.shape == "Trunc0" ? -0.0625f + 0.001f : -0.0625f;
        constexpr float near_w = 58.379993438720703f, far_w = 325.8057861328125f;
        add(soup,
            std::array<WindowPoint, 4>{{{-1168.6875f, y, 0, near_w},
                                        {1808.6875f, y, 0, near_w},
                                        {586.75f, 487.3125f, 500000, far_w},
                                        {53.1875f, 487.3125f, 500000, far_w}}},
            false);
    } else {
        return std::nullopt;
    }
    return soup;
}

// The camera is 50 above the floor and looks down by three in seven. The test switches the depth buffer to a float
// format without rebuilding its matrices, so they have the scale of fixed-point depth for every format.
CompositeMatrix looking_down(const BufferSetting& s) {
    const float units = s.is_16 ? 65535.0f : 16777215.0f;
    return columns_of(camera_of(look_at({0, 50, -7}, {0, 47, 0}), perspective_to_window(units)).composite);
}

// A floor of 30000 units, drawn with the fixed-function pipeline.
TriangleSoup fixed_floor(const BufferSetting& s) {
    const CompositeMatrix camera = looking_down(s);
    const auto window_point = [&](float x, float z) {
        const auto [window_x, window_y, window_z, w] = chip_window_point(camera, {x, 0, z, 1});
        return WindowPoint{window_x, window_y, window_z, w};
    };
    TriangleSoup soup;
    add(soup,
        std::array{window_point(-15000, 30000), window_point(15000, 30000), window_point(15000, -10),
                   window_point(-15000, -10)},
        true, 100);
    return soup;
}

// Drawn by the program alone.
TriangleSoup line_strip(rasterizer::Primitive& primitive) {
    constexpr float far_w = 325.8057861328125f, near_w = 58.379993438720703f;
    const auto vertex = [](float x, float y, float z, float w, std::array<float, 2> texture) {
        ClipVertex v = at(x, y, z, {1, 1, 1, 1}, w);
        v.texcoord = texture;
        return v;
    };
    SplitDraw draw =
        split_draw(Topology::line_strip,
                   {vertex(321, 0.5f, 16777210, near_w, {0, 0}), vertex(159.5f, 0.5f, 16777210, far_w, {1, 0}),
                    vertex(159.5f, 448.5f, 16572698, near_w, {1, 1}), vertex(321, 448.5f, 16572698, far_w, {0, 1})},
                   PolygonMode::fill);
    primitive = draw.primitive;
    return std::move(draw.soup);
}

const Drawing unknown_quad{std::nullopt,
                           "which quad gives the w slope of this shape is not known (chip-float-depth.md 4.5)"};

// Undetermined: the reciprocal of one sum, the slope of slivers, weights where w varies, and the last bits of a w slope
// (rasterizer/reference/chip-float-depth.md 1.2, 2.3, 4.4, 4.5).
Bound bound_of(const BufferSetting& s) {
    if (s.shape == "LineStrip") return s.is_w && s.is_float && !s.is_16 ? Bound{8, 1} : Bound{};
    if (s.is_w) return {250, s.has_slope ? 2u : 1u};
    // One triangle of the floor with the fixed-function pipeline: the last bit of its reciprocals.
    if (!s.by_program && !s.is_16) return {44, 1};
    if (s.shape == "TriH" && s.has_slope) return {168, 1};
    return s.shape == "TruncNeg" ? Bound{4, 1} : Bound{};
}

// Every fragment passes, so the picture shows the texture, and a red line at the beginning of its own clip. The test
// drew yellow lines over it, from its text to the pixels whose depths the text states.
SuitePicture color_picture(const pipeline::DeviceProfile& profile, const BufferSetting& s, TriangleSoup soup,
                           rasterizer::Primitive primitive) {
    pipeline::Texture texture = checker(256, 8, 0xff00ffff, 0xff000000);
    texture.target = pipeline::TextureTarget::two_d;
    texture.wrap_s = texture.wrap_t = pipeline::TextureWrap::repeat;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff251135));
    const rasterizer::Rect clip{s.left, s.top, picture_width, picture_height};
    surface.draw({.window_clip = clip, .depth_clamp = true, .texture = &texture}, std::move(soup), primitive);
    const auto left = static_cast<float>(s.left), top = static_cast<float>(s.top);
    constexpr Argb red = 0xffff0000;
    if (s.top != default_top) surface.draw({}, box({left, top, picture_width, top + 1}, red));
    if (s.left != default_left) surface.draw({}, box({left, top, left + 1, picture_height}, red));
    // Texels from the other side of a cell's edge (rasterizer/reference/chip-float-depth.md 4.4 and 7).
    return {.image = surface.color(), .overdrawn = std::array<std::uint8_t, 4>{255, 255, 0, 255}, .bound = {200, 255}};
}

}  // namespace

Drawing draw_w_buffering(std::string_view name, const pipeline::DeviceProfile& profile) {
    const auto s = parse_buffer_setting(name);
    if (!s) return unknown_name;
    auto primitive = rasterizer::Primitive::triangles;
    const bool is_strip = s->shape == "LineStrip";
    auto soup = is_strip ? line_strip(primitive) : shape_of(*s);
    if (!soup || (is_strip && !s->by_program)) return unknown_name;
    if (!s->by_program) soup = fixed_floor(*s);
    if (!s->shows_depth) return {color_picture(profile, *s, std::move(*soup), primitive), {}};
    const bool is_sliver = s->shape == "TriH" || s->shape == "TriV" || s->shape == "ClipF";
    if (s->is_w && s->has_slope && is_sliver) return unknown_quad;

    pipeline::Surface surface{profile, {.depth = s->format()}};
    surface.clear_depth(s->is_16 ? 0xffff : 0xffffff);
    pipeline::DrawState state{
        .depth = {.enabled = true, .func = pipeline::CompareFunc::lequal, .write = true},
        .window_clip = rasterizer::Rect{s->left, s->top, picture_width, picture_height},
        .depth_clamp = true,
        .polygon_offset = {.enabled = s->has_bias || s->has_slope,
                           .factor = !s->has_slope ? 0.0f
                                     : s->is_w     ? 65536.0f
                                                   : 16.0f,
                           .units = s->has_bias ? 16.0f : 0.0f},
    };
    if (s->is_w) state.depth_path = DepthPath::w_buffer;
    surface.draw(state, std::move(*soup), primitive);
    // The stencil is cleared to 0.
    return {SuitePicture{.reading = s->is_16 ? CaptureFormat::depth16 : CaptureFormat::depth24,
                         .image = surface.depth(),
                         .bound = bound_of(*s)},
            {}};
}

}  // namespace strata::hardware_check
