#include "tools/hardware_check/compare.h"

#include <algorithm>
#include <cstdlib>

#include "rasterizer/base/input_error.h"

namespace strata::hardware_check {
namespace {

using pipeline::Format;
using pipeline::Image;
using Pixel = std::array<std::uint32_t, 4>;  // r g b a

constexpr std::uint32_t label = 0x00ffffff;  // (255, 255, 255, 0)

template <class F>
void for_each_pixel(F&& f) {
    for (int y = 0; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) f(x, y);
}

// Label pixels are marked by a colour: a picture of depth words has none.
bool reads_color(Reading reading) { return reading == Reading::color || reading == Reading::drawn; }
bool contains(const rasterizer::Rect& r, int x, int y) { return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1; }

Pixel pixel_of(const Image& image, int x, int y) {
    const std::size_t i = image.index(x, y);
    return {image.codes[i], image.codes[i + 1], image.codes[i + 2], image.codes[i + 3]};
}

std::uint32_t packed(const Pixel& p) { return p[0] | p[1] << 8 | p[2] << 16 | p[3] << 24; }
std::uint32_t packed(const std::array<std::uint8_t, 4>& p) { return packed(Pixel{p[0], p[1], p[2], p[3]}); }

// The word that stands for a pixel of the drawn picture; their_word() is the same for the capture.
std::uint32_t our_word(const Picture& drawn, int x, int y) {
    switch (drawn.reading) {
        case Reading::color: return packed(pixel_of(drawn.image, x, y));
        case Reading::drawn: return packed(pixel_of(drawn.image, x, y)) != packed(drawn.background);
        case Reading::depth16: return drawn.image.codes[drawn.image.index(x, y)];
        case Reading::depth24: {
            const std::uint32_t depth = drawn.image.codes[drawn.image.index(x, y)] << 8;
            return drawn.stencil.codes.empty() ? depth : depth | drawn.stencil.codes[drawn.stencil.index(x, y)];
        }
    }
    return 0;  // unreachable: the enum is closed
}

// A capture is always rgba8. Depth is unpacked as compare.h says; without a stencil in the drawn
// picture the capture's stencil byte counts as 0.
std::uint32_t their_word(const Picture& drawn, const Image& capture, int x, int y) {
    const Pixel p = pixel_of(capture, x, y);
    switch (drawn.reading) {
        case Reading::color: return packed(p);
        case Reading::drawn: return packed(p) != packed(drawn.background);
        case Reading::depth16: return (p[0] >> 3) << 11 | (p[1] >> 2) << 5 | p[2] >> 3;
        case Reading::depth24: return p[3] << 24 | p[0] << 16 | p[1] << 8 | (drawn.stencil.codes.empty() ? 0 : p[2]);
    }
    return 0;  // unreachable: the enum is closed
}

bool is_hidden(const Picture& drawn, int x, int y) {
    return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                       [&](const rasterizer::Rect& r) { return contains(r, x, y); });
}

bool is_label(const Picture& drawn, const Image& capture, int x, int y) {
    if (!reads_color(drawn.reading)) return false;
    const std::uint32_t theirs = packed(pixel_of(capture, x, y));
    return theirs == label || (drawn.overdrawn && theirs == packed(*drawn.overdrawn));
}

// False for labels, which hold text, and for rectangles that the suite hides.
bool is_compared(const Picture& drawn, const Image& capture, int x, int y) {
    return !is_label(drawn, capture, x, y) && !is_hidden(drawn, x, y);
}

// Theirs minus ours, in the reading's units.
std::int64_t difference(Reading reading, std::uint32_t ours, std::uint32_t theirs) {
    if (reading == Reading::color) {
        std::int64_t worst = 0;
        for (int shift = 0; shift < 32; shift += 8)
            worst =
                std::max(worst, std::abs(std::int64_t{theirs >> shift & 0xff} - std::int64_t{ours >> shift & 0xff}));
        return worst;
    }
    const bool has_depth = reading == Reading::depth24 && (ours ^ theirs) > 0xff;
    return has_depth ? std::int64_t{theirs >> 8} - std::int64_t{ours >> 8} : std::int64_t{theirs} - std::int64_t{ours};
}

template <class Word>
std::string digest_of(const Picture& drawn, const rasterizer::Rect& box, Word&& word) {
    Image words{Format::r32f, picture_width, picture_height};
    for_each_pixel([&](int x, int y) {
        words.codes[words.index(x, y)] = contains(box, x, y) || is_hidden(drawn, x, y) ? 0 : word(x, y);
    });
    return digest(words);
}

}  // namespace

Comparison compare(const Picture& drawn, const Image& capture, const std::string& path) {
    if (capture.format != Format::rgba8 || capture.width != picture_width || capture.height != picture_height)
        throw InputError{path, "picture", "640 x 480 pixels of 8-bit r g b a",
                         std::to_string(capture.width) + " x " + std::to_string(capture.height) + " pixels of " +
                             std::string{pipeline::info(capture.format).name}};
    Comparison result;
    for_each_pixel([&](int x, int y) {
        if (!is_compared(drawn, capture, x, y)) return;
        ++result.compared;
        const std::uint32_t ours = our_word(drawn, x, y), theirs = their_word(drawn, capture, x, y);
        const std::int64_t d = difference(drawn.reading, ours, theirs);
        if (d == 0) return;
        if (result.differing++ == 0) {
            result.first = {x, y};
            result.ours = ours;
            result.theirs = theirs;
        }
        ++result.histogram[d];
        result.largest = std::max(result.largest, static_cast<std::uint32_t>(std::abs(d)));
    });
    result.within_bound = result.differing <= drawn.bound.pixels && result.largest <= drawn.bound.units;
    return result;
}

Image difference_picture(const Picture& drawn, const Image& capture) {
    Image shown{Format::rgba8, picture_width, picture_height};
    for_each_pixel([&](int x, int y) {
        const std::int64_t d = difference(drawn.reading, our_word(drawn, x, y), their_word(drawn, capture, x, y));
        const auto size = static_cast<std::uint32_t>(std::min<std::int64_t>(255, 96 + 16 * std::abs(d)));
        Pixel rgba{0, 0, 0, 255};
        if (!is_compared(drawn, capture, x, y))
            rgba = {255, 255, 255, 255};
        else if (d > 0)
            rgba = {size, 0, 0, 255};
        else if (d < 0)
            rgba = {0, size, size, 255};
        std::copy(rgba.begin(), rgba.end(), shown.codes.begin() + static_cast<std::ptrdiff_t>(shown.index(x, y)));
    });
    return shown;
}

rasterizer::Rect label_box(const Picture& drawn, const Image& capture) {
    rasterizer::Rect box{picture_width, picture_height, 0, 0};
    for_each_pixel([&](int x, int y) {
        if (is_label(drawn, capture, x, y))
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    });
    return box.area() == 0 ? rasterizer::Rect{} : box;
}

std::string digest_outside(const rasterizer::Rect& box, const Picture& drawn) {
    return digest_of(drawn, box, [&](int x, int y) { return our_word(drawn, x, y); });
}
std::string digest_outside(const rasterizer::Rect& box, const Picture& drawn, const Image& capture) {
    return digest_of(drawn, box, [&](int x, int y) { return their_word(drawn, capture, x, y); });
}

}  // namespace strata::hardware_check
