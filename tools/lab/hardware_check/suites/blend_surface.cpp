// Suite Blend_surface: <DstAlpha|1-DstAlpha>_<format>: the value of destination alpha in surfaces with and without
// alpha. <format>_Add_SrcA_<1-SrcA|DstA>: patterns of seven texel formats blended into them.
// pipeline/reference/chip-fragment.md 5.
#include <algorithm>

#include "tools/lab/hardware_check/drawing/blend_patterns.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::BlendEquation;
using pipeline::BlendFactor;
using pipeline::Format;

// A surface format, and the value of the bits of a pixel that store neither colour nor alpha.
struct BlendedLayout {
    std::string_view name;
    Format format;
    // True: unused bits are written as 1, and the texture unit reads them as alpha. False: they are 0.
    bool ones = false;
};
constexpr BlendedLayout layouts[] = {{"ARGB8", Format::rgba8},
                                     {"R5G6B5", Format::r5g6b5},
                                     {"XA_Z1A7RGB8", Format::x1a7r8g8b8, false},
                                     {"XA_O1A7RGB8", Format::x1a7r8g8b8, true},
                                     {"X_ZRGB8", Format::x8r8g8b8, false},
                                     {"X_ORGB8", Format::x8r8g8b8, true},
                                     {"X_Z1RGB5", Format::x1r5g5b5, false},
                                     {"X_O1RGB5", Format::x1r5g5b5, true}};

// Pixels per side of an off-screen target (pipeline/reference/chip-fragment.md 5).
constexpr int side = 128;

// A filled target onto which 22FFFFFF is blended with its destination alpha. The texture unit displays the stored
// codes.
pipeline::Image blended(const pipeline::DeviceProfile& profile, Format format, BlendFactor factor, Argb fill) {
    pipeline::Surface target{profile, {.color = format, .width = side, .height = side}};
    target.clear_color(unpack(fill));
    // The destination's factor is zero, so the pixel becomes the source times destination alpha, and the picture shows
    // that alpha as grey.
    const pipeline::BlendTerm term{BlendEquation::add, factor, BlendFactor::zero};
    target.draw({.blend = {true, term, term}}, box({0, 0, side, side}, 0x22ffffff));
    return target.color();
}

// The alpha that a lookup returns for a stored alpha `code`. Seven stored bits are read as (a >> 1) with the unused bit
// above them; formats without alpha return the unused byte or bit, and R5G6B5, which has none, returns 255.
std::uint8_t texel_alpha(const BlendedLayout& layout, std::uint8_t code) {
    switch (layout.format) {
        case Format::x1a7r8g8b8: return static_cast<std::uint8_t>((layout.ones ? 0x80 : 0) | code >> 1);
        case Format::x8r8g8b8:
        case Format::x1r5g5b5: return layout.ones ? 255 : 0;
        case Format::r5g6b5: return 255;
        default: return code;
    }
}

// The surface as a texture. A 16-bit surface stores the upper 5 or 6 bits of a colour with zeros below; the texture
// unit fills these with the upper bits again, while blending reads the zeros (pipeline/reference/chip-fragment.md 5).
pipeline::Texture as_texels(const pipeline::Image& image, const BlendedLayout& layout) {
    pipeline::Texture texture = as_texture(image);
    const auto widened = [](std::uint8_t v, int bits) { return static_cast<std::uint8_t>(v | v >> bits); };
    const bool is_16_bit = layout.format == Format::r5g6b5 || layout.format == Format::x1r5g5b5;
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
        std::uint8_t& code = texture.texels[i];
        if (i % 4 == 3)
            code = texel_alpha(layout, code);
        else if (is_16_bit)
            code = widened(code, layout.format == Format::r5g6b5 && i % 4 == 1 ? 6 : 5);
    }
    return texture;
}

// Displays a target as the test does: its upper 64 rows blended with the alpha that the texture unit reads, its lower
// 64 rows opaque.
void show(pipeline::Surface& window, const pipeline::Texture& texture, float x, float y) {
    pipeline::Texture half = texture;
    half.height = side / 2;
    // Half of the rows, four bytes per texel.
    const std::size_t bytes = static_cast<std::size_t>(side) * side / 2 * 4;
    half.texels.assign(texture.texels.begin(), texture.texels.begin() + static_cast<std::ptrdiff_t>(bytes));
    place(window, half, x, y, {.blend = pipeline::blend_mode::over});
    half.texels.assign(texture.texels.begin() + static_cast<std::ptrdiff_t>(bytes), texture.texels.end());
    for (std::size_t i = 3; i < half.texels.size(); i += 4) half.texels[i] = 255;
    place(window, half, x, y + side / 2, {.blend = pipeline::blend_mode::over});
}

// A target onto which the pattern is blended four times, each time 12 pixels further right and down, so that up to four
// copies overlap. In the right corners squares of 8 x 8 are blended four times, in the left ones once: grey above, a
// colour of alpha 0 below. Rounding errors accumulate where the same square is blended repeatedly.
pipeline::Image patterned(const pipeline::DeviceProfile& profile, Format format, const pipeline::Blend& blend,
                          const TexelFormat& texels) {
    constexpr int swatch = 64, step = 12, corner = 8, copies = 4;
    constexpr float far = side - corner;
    pipeline::Surface target{profile, {.color = format, .width = side, .height = side}};
    // The test's background, r g b a.
    target.clear_color({25, 25, 25, 178});
    const pipeline::Texture pattern = radial_pattern(texels, swatch);
    for (int k = 1; k <= copies; ++k) {
        const auto offset = static_cast<float>(step * k);
        place(target, pattern, offset, offset, {.blend = blend});
    }
    const pipeline::Texture grey = flat_pattern(texels, corner, 0x44444444);
    const pipeline::Texture clear = flat_pattern(texels, corner, texels.is_wide ? 0x00ffff55 : 0x0ff5);
    // k = 0 draws the left corners, the others the right ones.
    for (int k = 0; k < copies + 1; ++k) {
        const float x = k == 0 ? 0 : far;
        place(target, grey, x, 0, {.blend = blend});
        place(target, clear, x, far, {.blend = blend});
    }
    return target.color();
}

// The destination's factor in names with _Add_; the source's is always SrcA.
std::optional<BlendFactor> added_factor(std::string_view name) {
    if (name == "1-SrcA") return BlendFactor::one_minus_src_alpha;
    if (name == "DstA") return BlendFactor::dst_alpha;
    return std::nullopt;
}

// Null if no surface has that name.
const BlendedLayout* find_layout(std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(layouts), std::end(layouts), [&](const BlendedLayout& l) { return l.name == name; });
    return found == std::end(layouts) ? nullptr : found;
}

// One tile per texel format, four per row, each an own target of `layout_name`. Tiles are displayed with alpha 255,
// because the picture is about colours.
Drawing draw_added(const pipeline::DeviceProfile& profile, std::string_view layout_name, std::string_view factor_name) {
    const BlendedLayout* const layout = find_layout(layout_name);
    const auto factor = added_factor(factor_name);
    if (layout == nullptr || !factor) return unknown_name;
    const pipeline::BlendTerm term{BlendEquation::add, BlendFactor::src_alpha, *factor};
    pipeline::Surface window{profile, {}};
    window.clear_color(unpack(0xff555555));
    for (std::size_t k = 0; k < blended_formats.size(); ++k) {
        pipeline::Texture shown =
            as_texels(patterned(profile, layout->format, {true, term, term}, blended_formats[k]), *layout);
        for (std::size_t i = 3; i < shown.texels.size(); i += 4) shown.texels[i] = 255;
        place(window, shown, 32.0f + 144.0f * static_cast<float>(k % 4), 92.0f + 144.0f * static_cast<float>(k / 4),
              {});
    }
    return {SuitePicture{.image = window.color()}, {}};
}

}  // namespace

Drawing draw_blend_surface(std::string_view name, const pipeline::DeviceProfile& profile) {
    // Both kinds of names contain factor and format, in opposite order: DstAlpha_<format>, but
    // <format>_Add_SrcA_<factor>.
    constexpr std::string_view added = "_Add_SrcA_";
    if (const std::size_t place = name.find(added); place != std::string_view::npos)
        return draw_added(profile, name.substr(0, place), name.substr(place + added.size()));
    BlendFactor factor = BlendFactor::dst_alpha;
    if (take(name, "1-")) factor = BlendFactor::one_minus_dst_alpha;
    if (!take(name, "DstAlpha_")) return unknown_name;
    const BlendedLayout* const layout = find_layout(name);
    if (layout == nullptr) return unknown_name;
    pipeline::Surface window{profile, {}};
    window.clear_color(unpack(0xff555555));
    // Eight targets: the alphas 00, 40, 80 and FF over black above, the same over blue below.
    for (int k = 0; k < 8; ++k) {
        constexpr Argb alphas[] = {0x00000000, 0x40000000, 0x80000000, 0xff000000};
        const Argb fill = alphas[k % 4] | (k < 4 ? 0x000000 : 0x0000ff);
        const float x = 32.0f + 144.0f * static_cast<float>(k % 4), y = k < 4 ? 92 : 252;
        show(window, as_texels(blended(profile, layout->format, factor, fill), *layout), x, y);
    }
    return {SuitePicture{.image = window.color()}, {}};
}

}  // namespace strata::hardware_check
