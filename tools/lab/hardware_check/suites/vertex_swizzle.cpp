// Suite Vertex_shader_swizzle_tests: Control, Mov<n>, and the same with NA, whose final alpha is 1: squares whose
// vertex program writes some components of the colour from a swizzle of (0.6, 0.7, 0.8, 1), and leaves 0.33 in the
// others. pipeline/reference/vertices.md 3.4.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "pipeline/region/fragment_path.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

// The order in which the tests combine masks and swizzles; a picture has nine combinations.
constexpr std::array<std::string_view, 15> masks{"ra",  "r", "gb",  "rgba", "ga", "ba",  "rg", "b",
                                                 "gba", "a", "rba", "rga",  "rb", "rgb", "g"};
constexpr std::array<std::string_view, 10> swizzles{"xw", "zy", "yw", "yzw", "yx", "wzy", "xzw", "zx", "zxy", "wz"};
constexpr std::array<std::string_view, 7> opaque_masks{"g", "rb", "rg", "b", "gb", "r", "rgb"};
constexpr std::array<std::string_view, 12> opaque_swizzles{"wz", "xw", "zx",  "xy",  "yzw", "wzy",
                                                           "zy", "yw", "xzw", "zxy", "yx",  "wy"};
constexpr std::size_t in_picture = 9;

// The last letter of a swizzle stands for all that follow.
std::array<float, 4> moved(std::string_view mask, std::string_view swizzle) {
    constexpr std::array<float, 4> source{0.6f, 0.7f, 0.8f, 1.0f};
    std::array<float, 4> color{0.33f, 0.33f, 0.33f, 0.33f};
    for (std::size_t c = 0; c < 4; ++c) {
        if (mask.find("rgba"[c]) == std::string_view::npos) continue;
        const char letter = swizzle[std::min(c, swizzle.size() - 1)];
        color[c] = source[std::string_view{"xyzw"}.find(letter)];
    }
    return color;
}

// The colours of a picture's squares; none for a number that the suite does not have.
std::vector<std::array<float, 4>> colors_of(std::size_t picture, std::span<const std::string_view> mask,
                                            std::span<const std::string_view> swizzle) {
    std::vector<std::array<float, 4>> colors;
    for (std::size_t k = picture * in_picture; k < (picture + 1) * in_picture; ++k)
        if (k < mask.size() * swizzle.size())
            colors.push_back(moved(mask[k / swizzle.size()], swizzle[k % swizzle.size()]));
    return colors;
}

// Two digits.
std::optional<std::size_t> picture_number(std::string_view digits) {
    if (digits.size() != 2 || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    return static_cast<std::size_t>(digits[0] - '0') * 10 + static_cast<std::size_t>(digits[1] - '0');
}

}  // namespace

Drawing draw_vertex_swizzle(std::string_view name, const pipeline::DeviceProfile& profile) {
    bool is_opaque = take(name, "NA");
    std::vector<std::array<float, 4>> colors;
    if (take(name, "Mov")) {
        const auto number = picture_number(name);
        if (!number) return unknown_name;
        colors = is_opaque ? colors_of(*number, opaque_masks, opaque_swizzles) : colors_of(*number, masks, swizzles);
    } else if (!is_opaque && take(name, "Control")) {
        is_opaque = take(name, "NA");
        if (name.empty()) colors = {moved("", "x")};
    }
    if (colors.empty()) return unknown_name;

    using Reg = pipeline::CombinerRegister;
    const pipeline::FragmentPath path{{}, show(Reg::primary_color, is_opaque ? Reg::zero : Reg::primary_color), {}};
    pipeline::DrawState state{.blend = pipeline::blend_mode::over};
    state.path = &path;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xfe312f31));
    draw_checkerboard(surface, 24, 0xff202020, 0xff000000, 0);
    constexpr float quad_side = 96, step_x = (640 - quad_side * 3) / 4, step_y = (480 - quad_side * 3) / 4 + 10;
    for (std::size_t k = 0; k < colors.size(); ++k) {
        const float left = step_x + static_cast<float>(k % 3) * (quad_side + step_x),
                    top = step_y + static_cast<float>(k / 3) * (quad_side + step_y);
        TriangleSoup square;
        add_quad(square,
                 {at(left, top, 0, colors[k]), at(left + quad_side, top, 0, colors[k]),
                  at(left + quad_side, top + quad_side, 0, colors[k]), at(left, top + quad_side, 0, colors[k])});
        surface.draw(state, square);
    }
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
