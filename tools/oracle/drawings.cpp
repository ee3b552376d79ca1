#include "tools/oracle/drawings.h"

#include <algorithm>
#include <bit>

namespace strata::oracle {

namespace {

constexpr int gap_px = 4;
constexpr std::uint32_t gap_grey = 96;

void put(pipeline::Image& image, int x, int y, const std::array<std::uint32_t, 3>& rgb) {
    for (std::size_t c = 0; c < 3; ++c) image.codes[image.index(x, y, static_cast<int>(c))] = rgb[c];
    image.codes[image.index(x, y, 3)] = 255;
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
        case Kind::coverage: return {255, 255, 0};
        case Kind::background: return {128, 128, 255};
        case Kind::layer_missing: return {255, 0, 0};
        case Kind::layer_doubled: return {255, 0, 255};
        case Kind::layer_swapped: return {255, 128, 0};
        case Kind::layer_merged: return {0, 255, 0};
        case Kind::layer_other: return {160, 96, 32};
        case Kind::depth: return {0, 255, 255};
        case Kind::color: return {255, 255, 255};
    }
    return {};  // unreachable: the enum is closed
}

// The distance's bit length, 1 to 32, over the range 128 to 255.
pipeline::Image heat_map(const Comparison& comparison) {
    pipeline::Image image{pipeline::Format::rgba8, comparison.width, comparison.height};
    for (int y = 0; y < comparison.height; ++y)
        for (int x = 0; x < comparison.width; ++x) {
            const std::size_t i = image.index(x, y) / 4;
            const auto length = static_cast<std::uint32_t>(std::bit_width(comparison.distance_of[i]));
            const std::uint32_t share = std::min(128 + length * 4, 255u);
            const auto full = color_of(comparison.kind_of[i]);
            put(image, x, y, {full[0] * share / 255, full[1] * share / 255, full[2] * share / 255});
        }
    return image;
}

pipeline::Image as_shown(const Picture& picture) {
    const auto best = std::ranges::min_element(picture.targets, {}, [](const Target& t) { return t.meaning; });
    const Target& target = *best;
    pipeline::Image image{pipeline::Format::rgba8, target.width, target.height};
    const auto code = [&](std::size_t pixel, int c) -> std::uint32_t {
        const double v = target.code == Code::integer ? static_cast<double>(target.at(pixel, c).word % 256) / 255
                                                      : target.value_at(pixel, c);
        return nearest(Code::unorm8, target.meaning == Meaning::depth ? 1.0 - v : v);
    };
    for (int y = 0; y < target.height; ++y)
        for (int x = 0; x < target.width; ++x) {
            const std::size_t i = image.index(x, y) / 4;
            const int last = target.channels - 1;
            put(image, x, y,
                {code(i, 0), code(i, target.channels < 3 ? 0 : 1),
                 code(i, std::min(target.channels < 3 ? 0 : 2, last))});
        }
    return image;
}

pipeline::Image side_by_side(const Picture& reference, const Picture& candidate, const Comparison& comparison) {
    const int w = comparison.width, h = comparison.height;
    pipeline::Image image{pipeline::Format::rgba8, 3 * w + 2 * gap_px, h};
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < image.width; ++x) put(image, x, y, {gap_grey, gap_grey, gap_grey});
    paste(as_shown(reference), 0, image);
    paste(as_shown(candidate), w + gap_px, image);
    paste(heat_map(comparison), 2 * (w + gap_px), image);
    return image;
}

}  // namespace strata::oracle
