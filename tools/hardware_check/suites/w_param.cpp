// Suite W_param: prog_w_zero_inf__<quad|bitri>_w<m>: which pixels a square covers whose w are negative, zero, infinite, or far
// apart. chip-float-depth.md 8.
#include <bit>
#include <limits>

#include "tools/hardware_check/names.h"
#include "tools/hardware_check/shapes.h"
#include "tools/hardware_check/suite.h"

namespace strata::hardware_check {
namespace {

constexpr float least = 0x1p-64f, greatest = 0x1p64f;  // 5.421011e-20, 1.8446744e19

// Names have three digits of the factor m; these tiny ones are powers of two.
struct TinyFactor {
    std::string_view name;
    float factor;
};
constexpr TinyFactor tiny_factors[] = {{"-3.08e-33", -0x1p-108f}, {"-9.63e-35", -0x1p-113f}, {"-1.50e-36", -0x1p-119f},
                                       {"-7.52e-37", -0x1p-120f}, {"-3.76e-37", -0x1p-121f}, {"-1.88e-37", -0x1p-122f}};

std::optional<float> factor_of(std::string_view text) {
    for (const TinyFactor& tiny : tiny_factors)
        if (text == tiny.name) return tiny.factor;
    if (text == "inf") return std::numeric_limits<float>::infinity();
    if (text == "-inf") return -std::numeric_limits<float>::infinity();
    const auto number = to_number(text);
    // The test has no other tiny factor, and its name would not tell it.
    const bool is_tiny = number && *number != 0.0f && *number < 0x1p-20f && *number > -0x1p-20f;
    return is_tiny ? std::nullopt : number;
}

constexpr Argb white = 0xffffffff;

bool is_negative(float w) { return std::bit_cast<std::uint32_t>(w) >> 31 != 0; }

}  // namespace

Drawing draw_w_param(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (!take(name, "prog_w_zero_inf__")) {
        for (const std::string_view other : {"ff_", "rcc_", "w_gaps", "w_pos_strip", "w_neg_strip"})
            if (name.starts_with(other))
                return {std::nullopt, "the fixed pipeline's w, its gaps and strips are not described"};
        return unknown_name;
    }
    const bool is_quad = take(name, "quad_w");
    if (!is_quad && !take(name, "bitri_w")) return unknown_name;
    const auto m = factor_of(name);
    if (!m) return unknown_name;

    const auto corner = [](float x, float y, float w) {
        ClipVertex v = at(x, y, white);
        v.w = w;
        return v;
    };
    // A negative w takes its corner to the other end of the diagonal.
    const float first_w = least / *m, last_w = greatest * *m;
    const ClipVertex top_left = is_negative(first_w) ? corner(480, 390, first_w) : corner(160, 70, first_w);
    const ClipVertex low_right = is_negative(last_w) ? corner(160, 70, last_w) : corner(480, 390, last_w);
    TriangleSoup soup;
    if (is_quad) {
        add_quad(soup, {top_left, corner(480, 70, 1), low_right, corner(160, 390, 1)});
    } else {
        add_triangle(soup, top_left, corner(480, 70, least), corner(160, 390, least));
        add_triangle(soup, low_right, corner(160, 390, greatest), corner(480, 70, greatest));
    }
    pipeline::Surface surface{profile, {}};
    constexpr Argb background = 0xfe251135;
    surface.clear_color(unpack(background));
    surface.draw({}, std::move(soup));
    return {Picture{.reading = Reading::drawn, .image = surface.color(), .background = unpack(background)}, {}};
}

}  // namespace strata::hardware_check
