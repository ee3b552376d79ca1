#include "scenes/hardware_check/compare.h"

#include <algorithm>
#include <cstdlib>

#include "rasterizer/input_error.h"

namespace strata::scenes::hardware_check {
namespace {

using pipeline::Format;
using pipeline::Image;
using Rgba8 = std::array<std::uint32_t, 4>;

Rgba8 pixel_of(const Image& image, int x, int y) {
    const std::size_t i = image.index(x, y);
    return {image.codes[i], image.codes[i + 1], image.codes[i + 2], image.codes[i + 3]};
}

bool is_color_reading(Reading reading) { return reading == Reading::color || reading == Reading::drawn; }

bool is_compared(const Picture& drawn, const Rgba8& theirs, int x, int y) {
    if (is_color_reading(drawn.reading) && theirs == Rgba8{255, 255, 255, 0}) return false;
    return std::none_of(drawn.hidden.begin(), drawn.hidden.end(), [&](const rasterizer::Rect& r) {
        return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
    });
}

struct Difference {
    std::int64_t signed_value = 0;
    std::uint32_t ours = 0, theirs = 0;
};

Difference color_difference(const Rgba8& ours, const Rgba8& theirs) {
    Difference worst;
    for (std::size_t c = 0; c < 4; ++c) {
        const std::int64_t d = std::abs(std::int64_t{theirs[c]} - std::int64_t{ours[c]});
        if (d > worst.signed_value) worst = {d, ours[c], theirs[c]};
    }
    return worst;
}

std::uint32_t word16(const Rgba8& p) { return (p[0] >> 3) << 11 | (p[1] >> 2) << 5 | p[2] >> 3; }
std::uint32_t word24(const Rgba8& p) { return p[3] << 16 | p[0] << 8 | p[1]; }

Difference word_difference(std::uint32_t ours, std::uint32_t theirs) {
    return {std::int64_t{theirs} - std::int64_t{ours}, ours, theirs};
}

Difference difference(const Picture& drawn, const Rgba8& theirs, int x, int y) {
    switch (drawn.reading) {
        case Reading::color: return color_difference(pixel_of(drawn.image, x, y), theirs);
        case Reading::drawn: {
            const Rgba8 background{drawn.background[0], drawn.background[1], drawn.background[2], drawn.background[3]};
            return word_difference(pixel_of(drawn.image, x, y) != background, theirs != background);
        }
        case Reading::depth16: return word_difference(drawn.image.codes[drawn.image.index(x, y)], word16(theirs));
        case Reading::depth24: {
            const Difference depth = word_difference(drawn.image.codes[drawn.image.index(x, y)], word24(theirs));
            if (depth.signed_value != 0 || drawn.stencil.codes.empty()) return depth;
            return word_difference(drawn.stencil.codes[drawn.stencil.index(x, y)], theirs[2]);
        }
    }
    return {};  // unreachable: the enum is closed
}

template <class F>
void for_each_pixel(F&& f) {
    for (int y = 0; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) f(x, y);
}

}  // namespace

Comparison compare(const Picture& drawn, const Image& capture, const std::string& path) {
    if (capture.width != picture_width || capture.height != picture_height)
        throw InputError{path, "picture", "640 x 480 pixels",
                         std::to_string(capture.width) + " x " + std::to_string(capture.height)};
    Comparison result;
    for_each_pixel([&](int x, int y) {
        const Rgba8 theirs = pixel_of(capture, x, y);
        if (!is_compared(drawn, theirs, x, y)) return;
        ++result.compared;
        const Difference d = difference(drawn, theirs, x, y);
        if (d.signed_value == 0) return;
        if (result.differing++ == 0) {
            result.first = {x, y};
            result.ours = d.ours;
            result.theirs = d.theirs;
        }
        ++result.histogram[d.signed_value];
        result.largest = std::max(result.largest, static_cast<std::uint32_t>(std::abs(d.signed_value)));
    });
    result.within_bound = result.differing <= drawn.bound.pixels && result.largest <= drawn.bound.units;
    return result;
}

Image as_capture(const Picture& drawn) {
    if (is_color_reading(drawn.reading)) return drawn.image;
    Image shown{Format::rgba8, picture_width, picture_height};
    for_each_pixel([&](int x, int y) {
        const std::uint32_t word = drawn.image.codes[drawn.image.index(x, y)];
        const std::uint32_t stencil = drawn.stencil.codes.empty() ? 0 : drawn.stencil.codes[drawn.stencil.index(x, y)];
        const Rgba8 rgba = drawn.reading == Reading::depth16
                               ? Rgba8{(word >> 11) << 3, (word >> 5 & 0x3f) << 2, (word & 0x1f) << 3, 255}
                               : Rgba8{word >> 8 & 0xff, word & 0xff, stencil, word >> 16};
        std::copy(rgba.begin(), rgba.end(), shown.codes.begin() + static_cast<std::ptrdiff_t>(shown.index(x, y)));
    });
    return shown;
}

Image difference_picture(const Picture& drawn, const Image& capture) {
    Image shown{Format::rgba8, picture_width, picture_height};
    for_each_pixel([&](int x, int y) {
        const Rgba8 theirs = pixel_of(capture, x, y);
        const std::int64_t d = difference(drawn, theirs, x, y).signed_value;
        const auto size = static_cast<std::uint32_t>(std::min<std::int64_t>(255, 64 + 16 * std::abs(d)));
        Rgba8 rgba{0, 0, 0, 255};
        if (!is_compared(drawn, theirs, x, y)) rgba = {255, 255, 255, 255};
        else if (d > 0) rgba = {size, 0, 0, 255};
        else if (d < 0) rgba = {0, size, size, 255};
        std::copy(rgba.begin(), rgba.end(), shown.codes.begin() + static_cast<std::ptrdiff_t>(shown.index(x, y)));
    });
    return shown;
}

}  // namespace strata::scenes::hardware_check
