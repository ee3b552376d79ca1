#include "tools/oracle/compare/drawings.h"

#include <algorithm>

#include "tools/oracle/compare/small_text.h"

namespace strata::oracle {

namespace {

constexpr int gap_px = 4;
constexpr std::uint32_t gap_grey = 96;

void put(pipeline::Image& image, int x, int y, const std::array<std::uint32_t, 3>& rgb) {
    for (std::size_t c = 0; c < 3; ++c) image.codes[image.index(x, y, static_cast<int>(c))] = rgb[c];
    image.codes[image.index(x, y, 3)] = 255;
}

pipeline::Image blank(int width, int height, std::uint32_t grey) {
    pipeline::Image image{pipeline::Format::rgba8, width, height};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) put(image, x, y, {grey, grey, grey});
    return image;
}

// An image with `color` evaluated at each pixel.
template <class Color>
pipeline::Image drawn(const Comparison& comparison, Color color) {
    pipeline::Image image{pipeline::Format::rgba8, comparison.width, comparison.height};
    for (int y = 0; y < comparison.height; ++y)
        for (int x = 0; x < comparison.width; ++x) {
            const std::array<std::uint8_t, 3> rgb = color(image.index(x, y) / 4);
            put(image, x, y, {rgb[0], rgb[1], rgb[2]});
        }
    return image;
}

// A square in the colour of each kind that occurs, followed by its name, as far as there is room.
void draw_kinds(pipeline::Image& image, int x, int y, const Comparison& comparison) {
    constexpr int letter_px = 2, square_px = 10, row_px = 12;
    const int left = x;
    for (const KindReport& kind : comparison.kinds) {
        const std::string_view words = name(kind.kind);
        const int wide = square_px + 4 + letter_px * letter_width_px * static_cast<int>(words.size());
        if (x > left && x + wide > image.width) x = left, y += row_px;
        if (y + square_px > image.height) return;
        const auto rgb = color_of(kind.kind);
        for (int i = 0; i < square_px * square_px; ++i)
            if (x + i % square_px < image.width)
                put(image, x + i % square_px, y + i / square_px, {rgb[0], rgb[1], rgb[2]});
        draw_text(image, x + square_px + 4, y, words, letter_px);
        x += wide + 2 * letter_px * letter_width_px;
    }
}

void paste(const pipeline::Image& from, int left, pipeline::Image& to) {
    for (int y = 0; y < from.height; ++y)
        std::copy_n(from.codes.begin() + static_cast<std::ptrdiff_t>(from.index(0, y)),
                    std::size_t{4} * static_cast<std::size_t>(from.width),
                    to.codes.begin() + static_cast<std::ptrdiff_t>(to.index(left, y)));
}

}  // namespace

std::array<std::uint8_t, 3> color_of(Kind kind) noexcept {
    switch (kind) {
        case Kind::none: return {0, 0, 0};
        case Kind::not_finite: return {255, 255, 255};
        case Kind::unseen: return {128, 128, 128};
        case Kind::coverage: return {255, 255, 0};
        case Kind::background: return {128, 128, 255};
        case Kind::layer_missing: return {255, 0, 0};
        case Kind::layer_doubled: return {255, 0, 255};
        case Kind::layer_swapped: return {255, 128, 0};
        case Kind::layer_merged: return {0, 255, 0};
        case Kind::layer_other: return {160, 96, 32};
        case Kind::depth: return {0, 255, 255};
        case Kind::color: break;
    }
    return {255, 150, 200};
}

HeatScale heat_scale(const Comparison& comparison) {
    return HeatScale{comparison.distance_of.empty() ? 0 : std::ranges::max(comparison.distance_of)};
}

pipeline::Image heat_map(const Comparison& comparison) {
    const HeatScale scale = heat_scale(comparison);
    return drawn(comparison, [&](std::size_t pixel) { return scale.color(comparison.distance_of[pixel]); });
}

pipeline::Image kind_map(const Comparison& comparison) {
    return drawn(comparison, [&](std::size_t pixel) { return color_of(comparison.kind_of[pixel]); });
}

pipeline::Image heat_map_with_legend(const Comparison& comparison) {
    pipeline::Image image =
        blank(std::max(comparison.width, least_legend_width_px), comparison.height + legend_height_px, 0);
    paste(heat_map(comparison), 0, image);
    draw_legend(image, 0, comparison.height, comparison.width, heat_scale(comparison));
    return image;
}

pipeline::Image as_shown(const Picture& picture, const std::string& name) {
    auto best = std::ranges::find(picture.targets, name, &TargetImage::name);
    if (name.empty() || best == picture.targets.end())
        best = std::ranges::min_element(picture.targets, {}, [](const TargetImage& t) { return t.meaning; });
    const TargetImage& target = *best;
    pipeline::Image image{pipeline::Format::rgba8, target.width, target.height};
    const auto code = [&](std::size_t pixel, int c) -> std::uint32_t {
        if (target.code == Code::unorm8 && target.meaning != Meaning::depth) return target.at(pixel, c).word;
        const double v = target.code == Code::integer ? static_cast<double>(target.at(pixel, c).word % 256) / 255
                                                      : target.value_at(pixel, c);
        return nearest(Code::unorm8, target.meaning == Meaning::depth ? 1.0 - v : v);
    };
    for (int y = 0; y < target.height; ++y)
        for (int x = 0; x < target.width; ++x) {
            const std::size_t i = image.index(x, y) / 4;
            const int last = target.channels - 1;
            if (target.channels == 2 && !target.is_grey &&
                target.code != Code::integer) {  // min-max depths: (-near, far)
                const double near = -target.value_at(i, 0), far = target.value_at(i, 1);
                const bool is_cleared = far < near;  // nothing is left to peel: black
                put(image, x, y,
                    {is_cleared ? 0 : nearest(Code::unorm8, near), is_cleared ? 0 : nearest(Code::unorm8, far), 0});
                continue;
            }
            put(image, x, y,
                {code(i, 0), code(i, target.channels < 3 ? 0 : 1),
                 code(i, std::min(target.channels < 3 ? 0 : 2, last))});
        }
    return image;
}

pipeline::Image beside(const std::vector<pipeline::Image>& images) {
    int width = -gap_px, height = 1;
    for (const pipeline::Image& image : images) {
        width += image.width + gap_px;
        height = std::max(height, image.height);
    }
    pipeline::Image all = blank(width, height, gap_grey);
    int left = 0;
    for (const pipeline::Image& image : images) {
        paste(image, left, all);
        left += image.width + gap_px;
    }
    return all;
}

pipeline::Image side_by_side(const Picture& reference, const Picture& candidate, const Comparison& comparison) {
    const int step = std::max(comparison.width, least_legend_width_px) + gap_px;
    pipeline::Image image = blank(4 * step - gap_px, comparison.height + legend_height_px, gap_grey);
    paste(as_shown(reference), 0, image);
    paste(as_shown(candidate), step, image);
    paste(heat_map(comparison), 2 * step, image);
    paste(kind_map(comparison), 3 * step, image);
    draw_legend(image, 2 * step, comparison.height, comparison.width, heat_scale(comparison));
    draw_kinds(image, 3 * step, comparison.height + 1, comparison);
    return image;
}

}  // namespace strata::oracle
