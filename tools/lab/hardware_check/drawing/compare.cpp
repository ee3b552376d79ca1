// tools/lab/hardware_check/drawing/compare.cpp - compares a drawn picture with a capture pixel by pixel, outside hidden
// rectangles and printed labels (compare.h).
#include "tools/lab/hardware_check/drawing/compare.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "rasterizer/base/input_error.h"

namespace strata::hardware_check {
namespace {

using pipeline::Format;
using pipeline::Image;
using Pixel = std::array<std::uint32_t, 4>;  // r g b a

constexpr std::uint32_t label = 0x00ffffff;  // (255, 255, 255, 0)

// Only colour pictures have labels, which are recognised by their colour.
bool reads_color(CaptureFormat reading) { return reading == CaptureFormat::color || reading == CaptureFormat::drawn; }
bool contains(const rasterizer::Rect& r, int x, int y) { return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1; }

std::uint32_t packed(const Pixel& p) { return p[0] | p[1] << 8 | p[2] << 16 | p[3] << 24; }
std::uint32_t packed(const std::array<std::uint8_t, 4>& p) { return packed(Pixel{p[0], p[1], p[2], p[3]}); }

using Row = std::array<std::uint32_t, picture_width>;

// `word` applied to the first code of each pixel in a row of `image`.
template <class F>
Row row_of(const Image& image, int y, F&& word) {
    const auto channels = static_cast<std::size_t>(image.channels());
    const std::uint32_t* codes = &image.codes[image.index(0, y)];
    Row row;
    for (std::uint32_t& each : row) {
        each = word(codes);
        codes += channels;
    }
    return row;
}

std::uint32_t packed_codes(const std::uint32_t* c) { return c[0] | c[1] << 8 | c[2] << 16 | c[3] << 24; }

// The words of a row of the drawn picture; their_row() is the same for the capture.
Row our_row(const SuitePicture& drawn, int y) {
    switch (drawn.reading) {
        case CaptureFormat::color: return row_of(drawn.image, y, packed_codes);
        case CaptureFormat::drawn: {
            const std::uint32_t background = packed(drawn.background);
            return row_of(drawn.image, y,
                          [=](const std::uint32_t* c) { return std::uint32_t{packed_codes(c) != background}; });
        }
        case CaptureFormat::depth16: return row_of(drawn.image, y, [](const std::uint32_t* c) { return *c; });
        case CaptureFormat::depth24: break;
    }
    Row row = row_of(drawn.image, y, [](const std::uint32_t* c) { return *c << 8; });
    for (int x = 0; x < picture_width && !drawn.stencil.codes.empty(); ++x)
        row[static_cast<std::size_t>(x)] |= drawn.stencil.codes[drawn.stencil.index(x, y)];
    return row;
}

// A capture is always rgba8. Depth is unpacked as described in compare.h; if the drawn picture has no stencil, the
// capture's stencil byte is replaced by 0.
Row their_row(const SuitePicture& drawn, const Image& capture, int y) {
    using Codes = const std::uint32_t*;
    switch (drawn.reading) {
        case CaptureFormat::color: return row_of(capture, y, packed_codes);
        case CaptureFormat::drawn: {
            const std::uint32_t background = packed(drawn.background);
            return row_of(capture, y, [=](Codes c) { return std::uint32_t{packed_codes(c) != background}; });
        }
        case CaptureFormat::depth16:
            return row_of(capture, y, [](Codes c) { return (c[0] >> 3) << 11 | (c[1] >> 2) << 5 | c[2] >> 3; });
        case CaptureFormat::depth24: break;
    }
    const std::uint32_t stencil = drawn.stencil.codes.empty() ? 0 : 0xff;
    return row_of(capture, y, [=](Codes c) { return c[3] << 24 | c[0] << 16 | c[1] << 8 | (c[2] & stencil); });
}

bool is_hidden(const SuitePicture& drawn, int x, int y) {
    return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                       [&](const rasterizer::Rect& r) { return contains(r, x, y); });
}

// 1 if a capture's pixel is a label, else 0. `theirs` is their_row() of the same row: for CaptureFormat::color its
// words are the colours.
Row labels_of(const SuitePicture& drawn, const Image& capture, const Row& theirs, int y) {
    if (!reads_color(drawn.reading)) return {};
    Row labels = drawn.reading == CaptureFormat::color ? theirs : row_of(capture, y, packed_codes);
    const std::uint32_t other = drawn.overdrawn ? packed(*drawn.overdrawn) : label;
    for (std::uint32_t& each : labels) each = std::uint32_t{each == label} | std::uint32_t{each == other};
    return labels;
}

// A row of both pictures: our words, the capture's, and 1 for labels of the capture.
struct RowPair {
    Row ours, theirs, labels;
};

// Calls f(y, row of both pictures), from the top.
template <class F>
void for_each_row(const SuitePicture& drawn, const Image& capture, F&& f) {
    RowPair row;
    for (int y = 0; y < picture_height; ++y) {
        row.ours = our_row(drawn, y);
        row.theirs = their_row(drawn, capture, y);
        row.labels = labels_of(drawn, capture, row.theirs, y);
        f(y, row);
    }
}

// Calls f(x, y, is a label, our word, their word), row by row from the top.
template <class F>
void for_each_pixel(const SuitePicture& drawn, const Image& capture, F&& f) {
    for_each_row(drawn, capture, [&](int y, const RowPair& row) {
        for (std::size_t x = 0; x < picture_width; ++x)
            f(static_cast<int>(x), y, row.labels[x] != 0, row.ours[x], row.theirs[x]);
    });
}

// The capture's word minus ours, in the reading's units.
std::int64_t difference(CaptureFormat reading, std::uint32_t ours, std::uint32_t theirs) {
    if (reading == CaptureFormat::color) {
        std::int64_t worst = 0;
        for (int shift = 0; shift < 32; shift += 8)
            worst =
                std::max(worst, std::abs(std::int64_t{theirs >> shift & 0xff} - std::int64_t{ours >> shift & 0xff}));
        return worst;
    }
    const bool has_depth = reading == CaptureFormat::depth24 && (ours ^ theirs) > 0xff;
    return has_depth ? std::int64_t{theirs >> 8} - std::int64_t{ours >> 8} : std::int64_t{theirs} - std::int64_t{ours};
}

template <class Words>
std::string digest_of(const SuitePicture& drawn, const rasterizer::Rect& box, Words&& row_of_words) {
    Image words{Format::r32f, picture_width, picture_height};
    for (int y = 0; y < picture_height; ++y) {
        const Row row = row_of_words(y);
        for (int x = 0; x < picture_width; ++x)
            words.codes[words.index(x, y)] =
                contains(box, x, y) || is_hidden(drawn, x, y) ? 0 : row[static_cast<std::size_t>(x)];
    }
    return digest(words);
}

// Counts a row's pixels and records the differences.
void add_row(CaptureComparison& result, const SuitePicture& drawn, int y, const RowPair& row) {
    for (std::size_t i = 0; i < picture_width; ++i) {
        const int x = static_cast<int>(i);
        if (row.labels[i] != 0 || is_hidden(drawn, x, y)) continue;
        ++result.compared;
        const std::uint32_t ours = row.ours[i], theirs = row.theirs[i];
        if (ours == theirs) continue;
        const std::int64_t d = difference(drawn.reading, ours, theirs);
        if (result.differing++ == 0) {
            result.first = {x, y};
            result.ours = ours;
            result.theirs = theirs;
        }
        ++result.histogram[d];
        result.largest = std::max(result.largest, static_cast<std::uint32_t>(std::abs(d)));
    }
}

}  // namespace

CaptureComparison compare(const SuitePicture& drawn, const Image& capture, const std::string& path) {
    if (capture.format != Format::rgba8 || capture.width != picture_width || capture.height != picture_height)
        throw InputError{path, "picture", "640 x 480 pixels of 8-bit r g b a",
                         std::to_string(capture.width) + " x " + std::to_string(capture.height) + " pixels of " +
                             std::string{pipeline::info(capture.format).name}};
    CaptureComparison result;
    for_each_row(drawn, capture, [&](int y, const RowPair& row) {
        // Most rows are equal, and then only labels are counted.
        if (drawn.hidden.empty() && row.ours == row.theirs)
            result.compared += picture_width - std::accumulate(row.labels.begin(), row.labels.end(), 0U);
        else
            add_row(result, drawn, y, row);
    });
    result.within_bound = result.differing <= drawn.bound.pixels && result.largest <= drawn.bound.units;
    return result;
}

Image difference_picture(const SuitePicture& drawn, const Image& capture) {
    Image shown{Format::rgba8, picture_width, picture_height};
    for_each_pixel(drawn, capture, [&](int x, int y, bool is_label, std::uint32_t ours, std::uint32_t theirs) {
        const std::int64_t d = difference(drawn.reading, ours, theirs);
        const auto size = static_cast<std::uint32_t>(std::min<std::int64_t>(255, 96 + 16 * std::abs(d)));
        Pixel rgba{0, 0, 0, 255};
        if (is_label || is_hidden(drawn, x, y))
            rgba = {255, 255, 255, 255};
        else if (d > 0)
            rgba = {size, 0, 0, 255};
        else if (d < 0)
            rgba = {0, size, size, 255};
        std::copy(rgba.begin(), rgba.end(), shown.codes.begin() + static_cast<std::ptrdiff_t>(shown.index(x, y)));
    });
    return shown;
}

rasterizer::Rect label_box(const SuitePicture& drawn, const Image& capture) {
    rasterizer::Rect box{picture_width, picture_height, 0, 0};
    for_each_pixel(drawn, capture, [&](int x, int y, bool is_label, std::uint32_t, std::uint32_t) {
        if (is_label)
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    });
    return box.area() == 0 ? rasterizer::Rect{} : box;
}

std::string digest_outside(const rasterizer::Rect& box, const SuitePicture& drawn) {
    return digest_of(drawn, box, [&](int y) { return our_row(drawn, y); });
}
std::string digest_outside(const rasterizer::Rect& box, const SuitePicture& drawn, const Image& capture) {
    return digest_of(drawn, box, [&](int y) { return their_row(drawn, capture, y); });
}

}  // namespace strata::hardware_check
