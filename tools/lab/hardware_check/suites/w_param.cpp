// Suite W_param: prog_w_zero_inf__<quad|bitri>_w<m>: the coverage of a square whose w are negative, zero, infinite, or
// very different. rasterizer/reference/chip-float-depth.md 8.
#include <bit>
#include <limits>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

constexpr float least = 0x1p-64f, greatest = 0x1p64f;  // 5.421011e-20, 1.8446744e19

// Names have three digits of the factor m; these tiny factors are powers of two.
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
    // The test has no other tiny factors, and names have too few digits for them.
    const bool is_tiny = number && *number != 0.0f && *number < 0x1p-20f && *number > -0x1p-20f;
    return is_tiny ? std::nullopt : number;
}

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

    // Texture coordinates belong to the corner, wherever it is.
    const auto corner = [](float x, float y, float w, std::array<float, 2> texture) {
        ClipVertex v = at(x, y, 0, {1, 1, 1, 1}, w);
        v.texcoord = texture;
        return v;
    };
    // A negative w moves its corner to the other end of the diagonal.
    const auto top_left = [&](float w) {
        return is_negative(w) ? corner(480, 390, w, {0, 0}) : corner(160, 70, w, {0, 0});
    };
    const auto low_right = [&](float w) {
        return is_negative(w) ? corner(160, 70, w, {1, 1}) : corner(480, 390, w, {1, 1});
    };
    const auto top_right = [&](float w) { return corner(480, 70, w, {1, 0}); };
    const auto low_left = [&](float w) { return corner(160, 390, w, {0, 1}); };
    const float first_w = least / *m, last_w = greatest * *m;
    TriangleSoup soup;
    if (is_quad) {
        add_quad(soup, {top_left(first_w), top_right(1), low_right(last_w), low_left(1)});
    } else {
        add_triangle(soup, top_left(first_w), top_right(least), low_left(least));
        add_triangle(soup, low_right(last_w), low_left(greatest), top_right(greatest));
    }
    pipeline::Texture texture = checker(256, 8, 0xff00c0c0, 0xffc00000);
    texture.target = pipeline::TextureTarget::two_d;
    texture.wrap_s = texture.wrap_t = pipeline::TextureWrap::repeat;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xfe251135));
    const pipeline::BlendTerm sum{pipeline::BlendEquation::add, pipeline::BlendFactor::one, pipeline::BlendFactor::one};
    surface.draw({.blend = {true, sum, sum}, .texture = &texture}, std::move(soup));
    // Texels whose coordinates are exactly on a cell's edge (rasterizer/reference/chip-float-depth.md 8).
    return {SuitePicture{.image = surface.color(), .bound = {200, 192}}, {}};
}

}  // namespace strata::hardware_check
