// Suite Texture_shadow_comparator: <stage><source><format>_<min>-<max>_<reference>_<function>: a depth texture compared
// with r. rasterizer/reference/chip-depth.md 7.
//
//   stage   2 or 3: the two- or the three-dimensional projective one, which compares 0 or r
//   source  R: texels written by the CPU, numbers hexadecimal; P, F: depth rendered by a vertex program or the fixed
//           pipeline, numbers world z
//   format  16, 24, 16f
//
// Pictures are equal. With the fixed-function pipeline a row of the picture samples exactly at the edge of a texel row,
// so that the last bit of a coordinate decides 21 or 42 pixels: as many may differ.
#include <algorithm>

#include "rasterizer/rules/depth_code.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::DepthFormat;
using pipeline::Image;

// The origin of the texels: the CPU, a vertex program, or the fixed-function pipeline.
enum class TexelOrigin : std::uint8_t { raw, program, fixed };

// The settings in a capture's name. The raw numbers are codes and only for TexelOrigin::raw; the others are world z,
// for the two other sources.
struct ShadowCapture {
    bool compares_r = false;
    TexelOrigin source = TexelOrigin::raw;
    DepthFormat format = DepthFormat::d16;
    pipeline::CompareFunc func = pipeline::CompareFunc::never;
    std::uint32_t raw_least = 0, raw_greatest = 0, raw_reference = 0;
    float least = 0, greatest = 0, reference = 0;  // world z
};

// Raw texels exist only in the two fixed-point formats.
std::optional<DepthFormat> format_of(std::string_view word, TexelOrigin source) {
    if (word == "16") return DepthFormat::d16;
    if (word == "24") return DepthFormat::d24;
    if (word == "16f" && source != TexelOrigin::raw) return DepthFormat::d16f;
    return std::nullopt;
}

// Removes the letter of the source from the name.
std::optional<TexelOrigin> source_of(std::string_view& name) {
    if (take(name, "R")) return TexelOrigin::raw;
    if (take(name, "P")) return TexelOrigin::program;
    if (take(name, "F")) return TexelOrigin::fixed;
    return std::nullopt;
}

// Removes <least>-<greatest>_<reference>_ from the name. The dash is searched from the second character, because
// `least` may be negative. False if a number is missing or invalid.
template <class T>
bool take_numbers(std::string_view& name, std::optional<T> (*parse)(std::string_view), T& least, T& greatest,
                  T& reference) {
    std::string_view range = take_until(name, "_");
    const std::size_t dash = range.find('-', 1);
    if (dash == std::string_view::npos) return false;
    const auto from = parse(range.substr(0, dash)), to = parse(range.substr(dash + 1)),
               ref = parse(take_until(name, "_"));
    if (!from || !to || !ref) return false;
    least = *from;
    greatest = *to;
    reference = *ref;
    return true;
}

// True if the format supports raw texels, or if world depths are in front of the eye, which is at z = -7; behind it, w
// would be negative.
bool is_drawable(const ShadowCapture& s) {
    if (s.source == TexelOrigin::raw)
        return std::max({s.raw_least, s.raw_greatest, s.raw_reference}) <= rasterizer::max_code(s.format);
    const auto is_visible = [](float z) { return z > -7.0f && z < 1e6f; };
    return is_visible(s.least) && is_visible(s.greatest) && is_visible(s.reference);
}

std::optional<ShadowCapture> parse_name(std::string_view name) {
    ShadowCapture s;
    s.compares_r = take(name, "3");
    if (!s.compares_r && !take(name, "2")) return std::nullopt;
    const auto source = source_of(name);
    const auto format = source ? format_of(take_until(name, "_"), *source) : std::nullopt;
    if (!format) return std::nullopt;
    s.source = *source;
    s.format = *format;
    const bool has_numbers = s.source == TexelOrigin::raw
                                 ? take_numbers(name, to_hexadecimal, s.raw_least, s.raw_greatest, s.raw_reference)
                                 : take_numbers(name, to_number, s.least, s.greatest, s.reference);
    const auto func = compare_func(name);
    if (!has_numbers || !func || !is_drawable(s)) return std::nullopt;
    s.func = *func;
    return s;
}

// The seven boxes with depths around the reference, in pixels or texels.
constexpr int box_count = 7, box_left = 141, box_step = 63, box_top = 230, box_width = 21, box_height = 64;

// Sets the texels of a half-open rectangle.
void fill(Image& texels, const rasterizer::Rect& where, std::uint32_t code) {
    for (int y = where.y0; y < where.y1; ++y)
        for (int x = where.x0; x < where.x1; ++x) texels.codes[texels.index(x, y)] = code;
}

// 15 x 15 cells of increasing values, accumulated in binary32 as in the test; the columns next to them keep the
// reference. The test does not shift the cells' 24-bit values above the stencil bits, so a depth is their upper part.
void fill_cells(Image& texels, const ShadowCapture& s) {
    constexpr int cells = 15, width = 42, height = 32, indent = 5;
    const float step = static_cast<float>(s.raw_greatest) / static_cast<float>(cells * cells);
    float value = static_cast<float>(s.raw_least);
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto word = static_cast<std::uint32_t>(value);
            const int x = indent + column * width, y = row * height;
            fill(texels, {x, y, x + width, y + height}, s.format == DepthFormat::d24 ? word >> 8 : word & 0xffff);
            value += step;
        }
}

// The texels of names with R (rasterizer/reference/chip-depth.md 7.1). The codes next to reference and greatest wrap
// around at 0 and are masked.
Image raw_texels(const ShadowCapture& s) {
    const std::uint32_t max = rasterizer::max_code(s.format), reference = s.raw_reference;
    Image texels{pipeline::target_format(s.format), picture_width, picture_height};
    fill(texels, {0, 0, picture_width, picture_height}, reference & max);
    fill_cells(texels, s);
    const std::uint32_t codes[box_count] = {
        0, 1, reference - 1, reference, reference + 1, s.raw_greatest - 1, s.raw_greatest};
    for (int k = 0; k < box_count; ++k) {
        const int x = box_left + box_step * k;
        fill(texels, {x, box_top, x + box_width, box_top + box_height}, codes[k] & max);
    }
    return texels;
}

// Window z of a world z, in the buffer's own units: with the vertex engine's arithmetic for the fixed-function
// pipeline, in binary64 for a vertex program, which gets finished positions from the test.
float depth_of(const ShadowCapture& s, float z) {
    const double units = s.format == DepthFormat::d16f ? rasterizer::max_d16f : rasterizer::max_code(s.format);
    if (s.source == TexelOrigin::fixed) return chip_window_z(z, static_cast<float>(units));
    return static_cast<float>(window_z(z, units));
}

constexpr float side_margin = 0.8f;  // of the quads that cover the window

// The depth pass of names with P and F (rasterizer/reference/chip-depth.md 7.2): a background from `least` at the top
// to `greatest` at the bottom, and the boxes.
Image rendered_texels(const pipeline::DeviceProfile& profile, const ShadowCapture& s) {
    const float shift = s.source == TexelOrigin::fixed ? viewport_offset : 0.0f;
    const std::array<float, 4> white{1, 1, 1, 1};
    TriangleSoup soup;
    const auto add = [&](const Box& b, float top_z, float bottom_z) {
        const float left = b.left + shift, top = b.top + shift, right = b.right + shift, bottom = b.bottom + shift;
        const float z0 = depth_of(s, top_z), z1 = depth_of(s, bottom_z);
        add_quad(soup, {at(left, top, z0, white), at(right, top, z0, white), at(right, bottom, z1, white),
                        at(left, bottom, z1, white)});
    };
    add({side_margin, 6, picture_width - side_margin, picture_height - 6}, s.least, s.greatest);
    constexpr float near_by = 0.0125f;
    const float z[box_count] = {s.least,     s.least + near_by,     s.reference - near_by,
                                s.reference, s.reference + near_by, s.greatest - near_by,
                                s.greatest};
    for (int k = 0; k < box_count; ++k) {
        const auto x = static_cast<float>(box_left + box_step * k);
        add({x, box_top, x + box_width, box_top + box_height}, z[k], z[k]);
    }
    pipeline::Surface surface{profile, {.depth = s.format}};
    surface.clear_depth(rasterizer::max_code(s.format));
    surface.draw({.depth = {.enabled = true, .func = pipeline::CompareFunc::always, .write = true}}, std::move(soup));
    return surface.depth();
}

// The quad that samples every texel at its pixel, with the reference as r. It is white where the comparison passes.
TriangleSoup lookup_quad(const ShadowCapture& s) {
    const bool is_raw = s.source == TexelOrigin::raw;
    const float shift = s.source == TexelOrigin::fixed ? viewport_offset : 0.0f, margin = is_raw ? 0.0f : side_margin;
    const float left = margin + shift, right = picture_width - margin + shift;
    const float top = (is_raw ? 100.0f : 96.0f) + shift, bottom = (is_raw ? 380.0f : 384.0f) + shift;
    const float r = is_raw ? static_cast<float>(s.raw_reference) : depth_of(s, s.reference);
    const auto corner = [&](float x, float y, float texel_x, float texel_y) {
        return TexturedCorner{x, y, {{{texel_x, texel_y, r, 1}}}};
    };
    return textured_quad({corner(left, top, 0, 0), corner(right, top, picture_width, 0),
                          corner(right, bottom, picture_width, picture_height),
                          corner(left, bottom, 0, picture_height)});
}

// The second pass of the test: the window after the comparison, black where it fails.
SuitePicture compared(const pipeline::DeviceProfile& profile, const ShadowCapture& s, const Image& texels) {
    pipeline::FragmentPath path;
    path.shader[0] = rectangle_lookup(
        {.depth_image = &texels,
         .compare = {.func = s.func, .target = pipeline::TextureTarget::rectangle},
         .reference = s.compares_r ? pipeline::CompareReference::r_over_q : pipeline::CompareReference::zero});
    path.combiners = show(pipeline::CombinerRegister::texture0, pipeline::CombinerRegister::primary_color);
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(s.source == TexelOrigin::raw ? 0xfe112233 : 0xfe443333));
    surface.draw({.path = &path}, lookup_quad(s));
    SuitePicture picture{.image = surface.color()};
    // Each box of the captures contains a mark in its own colour, which is not compared.
    for (int k = 0; k < box_count; ++k) {
        const int x = box_left + box_step * k;
        picture.hidden.push_back({x, 235, x + 24, 270});
    }
    // Up to 42 pixels may differ by any amount; reason: head of this file.
    if (s.source == TexelOrigin::fixed) picture.bound = {42, 255};
    return picture;
}

}  // namespace

Drawing draw_texture_shadow_comparator(std::string_view name, const pipeline::DeviceProfile& profile) {
    const auto setting = parse_name(name);
    if (!setting) return unknown_name;
    const Image texels =
        setting->source == TexelOrigin::raw ? raw_texels(*setting) : rendered_texels(profile, *setting);
    return {compared(profile, *setting, texels), {}};
}

}  // namespace strata::hardware_check
