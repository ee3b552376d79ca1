// rasterizer/coverage/sample_rectangle.cpp - a line's rectangle as half-planes (sample_rectangle.h).
#include "rasterizer/coverage/sample_rectangle.h"

#include "rasterizer/coverage/line_axis.h"

namespace strata::rasterizer {
namespace {

__extension__ using Square = unsigned __int128;

// The width in 1/256 pixel.
[[nodiscard]] std::int64_t width_in_256ths(float px) noexcept {
    if (!(px > 0.0f)) return 0;
    return px < 32767.0f ? static_cast<std::int64_t>(static_cast<double>(px) * 256.0 + 0.5) : 32767 * 256;
}

// The whole part of the square root, bit by bit.
[[nodiscard]] std::uint64_t root_of(Square n) noexcept {
    std::uint64_t root = 0;
    for (int bit = 63; bit >= 0; --bit) {
        const std::uint64_t tried = root | std::uint64_t{1} << bit;
        if (Square{tried} * tried <= n) root = tried;
    }
    return root;
}

[[nodiscard]] constexpr bool owns_points_on(std::int64_t right, std::int64_t down) noexcept {
    return right > 0 || (right == 0 && down > 0);
}

}  // namespace

ShapeCoverage sample_rectangle(SubpixelPoint a, SubpixelPoint b, float width_px, int subpixel_bits) noexcept {
    const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
    const std::int64_t width = width_in_256ths(width_px);
    if (dx == 0 && dy == 0) return {};
    const auto scaled = static_cast<std::uint64_t>(width << subpixel_bits);
    const Square squared = Square{scaled} * scaled * static_cast<std::uint64_t>(dx * dx + dy * dy);
    const std::uint64_t root = root_of(squared), reach = root >> 9;
    // Points lie on a side only if its distance is a whole number.
    const bool has_ties = Square{reach << 9} * (reach << 9) == squared;
    const auto side = [&](SubpixelPoint through, std::int64_t right, std::int64_t down, std::uint64_t most, bool ties) {
        return half_plane(through, right, down, static_cast<std::int64_t>(most), !ties || owns_points_on(right, down));
    };
    return {{side(a, -dy, dx, reach, has_ties), side(a, dy, -dx, reach, has_ties), side(a, dx, dy, 0, true),
             side(b, -dx, -dy, 0, true)},
            pixels_around(a, b, subpixel_bits, static_cast<int>(width >> 9) + 1)};
}

}  // namespace strata::rasterizer
