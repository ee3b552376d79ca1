// Suite 2D_Lines: 2DLine-<16|24>-C<colour>-<x>_<y>-<x>_<y>: a line of the chip's 2D engine, which passes no pipeline:
// max(|dx|, |dy|) pixels from the first end, without the last one; the other axis to the nearest.
// rasterizer/reference/chip-geometry.md 5.9.
#include <cmath>
#include <cstdlib>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

struct LineEnd {
    int x, y;
};
std::optional<LineEnd> end_of(std::string_view word) {
    const auto x = to_number(take_until(word, "_")), y = to_number(word);
    const auto is_inside = [](float v, int size) {
        return v >= 0 && v < static_cast<float>(size) && v == std::floor(v);
    };
    if (!x || !y || !is_inside(*x, picture_width) || !is_inside(*y, picture_height)) return std::nullopt;
    return LineEnd{static_cast<int>(*x), static_cast<int>(*y)};
}

// `v` of `of` steps on an axis whose length is `length`, to the nearest. Captures show no ties.
int step(int v, int of, int length) {
    const int magnitude = (2 * v * std::abs(length) + of) / (2 * of);
    return length < 0 ? -magnitude : magnitude;
}

// R5G6B5 in the lower half, each field extended by its own upper bits.
Argb extended(std::uint32_t word) {
    const std::uint32_t r = word >> 11 & 31, g = word >> 5 & 63, b = word & 31;
    return 0xff000000u | (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
}

}  // namespace

Drawing draw_two_d_lines(std::string_view name, const pipeline::DeviceProfile&) {
    if (!take(name, "2DLine-")) return unknown_name;
    const std::string_view depth = take_until(name, "-C");
    const auto color = to_hexadecimal(take_until(name, "-"));
    const auto first = end_of(take_until(name, "-")), last = end_of(name);
    if ((depth != "16" && depth != "24") || !color || !first || !last) return unknown_name;
    pipeline::Image image{pipeline::Format::rgba8, picture_width, picture_height};
    const auto write = [&](int x, int y, Argb value) {
        const pipeline::PixelCode code = unpack(value);
        for (int c = 0; c < 4; ++c) image.codes[image.index(x, y, c)] = code[static_cast<std::size_t>(c)];
    };
    for (int y = 0; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) write(x, y, 0xff440011);
    const int dx = last->x - first->x, dy = last->y - first->y, pixels = std::max(std::abs(dx), std::abs(dy));
    const Argb drawn = depth == "16" ? extended(*color) : 0xff000000u | *color;
    for (int k = 0; k < pixels; ++k) write(first->x + step(k, pixels, dx), first->y + step(k, pixels, dy), drawn);
    return {SuitePicture{.image = std::move(image)}, {}};
}

}  // namespace strata::hardware_check
