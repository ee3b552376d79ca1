// tests/rasterizer/lines.h - random lines and points at window positions, and the pixels that the rasterizer draws.
#pragma once
#include <set>
#include <utility>

#include "tests/rasterizer/scene.h"

namespace strata::rasterizer {

using PixelSet = std::set<std::pair<int, int>>;  // x, y

inline constexpr int line_window = 48;

[[nodiscard]] inline RasterState line_state() {
    RasterState state = scene_state(line_window, line_window);
    state.window_positions = true;
    state.depth_clamp = true;
    return state;
}

// Ends in subpixels, from `margin` pixels outside of the window on.
struct RandomLine {
    SubpixelPoint a, b;
};
[[nodiscard]] inline RandomLine random_line(Random& random, int bits, int margin) {
    const int unit = 1 << bits;
    const auto any = [&] { return random_int(random, -margin * unit, (line_window + margin) * unit); };
    SubpixelPoint a{any(), any()}, b{any(), any()};
    const auto whole = [&](int v) { return v / (unit / 2) * (unit / 2); };  // pixel borders and centres, for ties
    if (random() % 2 == 0) a = {whole(a.x), whole(a.y)}, b = {whole(b.x), whole(b.y)};
    switch (random() % 6) {
        case 0: b.x = a.x; break;
        case 1: b.y = a.y; break;
        case 2: b = {a.x + (b.y - a.y), b.y}; break;  // a diagonal
        case 3: b = {a.x + random_int(random, -unit, unit), a.y + random_int(random, -unit, unit)}; break;  // short
        default: break;
    }
    return {a, b};
}

[[nodiscard]] inline ClipVertex vertex_at(SubpixelPoint p, int bits) {
    const auto unit = static_cast<float>(1 << bits);
    return {.x = static_cast<float>(p.x) / unit, .y = static_cast<float>(p.y) / unit, .z = 0.5f};
}

[[nodiscard]] inline Geometry shapes(const std::vector<ClipVertex>& vertices, Primitive primitive,
                                     const RasterState& state, const RasterRules& rules) {
    TriangleSoup soup;
    soup.vertices.assign(vertices.begin(), vertices.end());
    const std::uint32_t ends = primitive == Primitive::lines ? 2 : 1;
    for (std::uint32_t i = 0; i + ends <= vertices.size(); i += ends) {
        const std::uint32_t last = i + ends - 1;
        soup.indices.insert(soup.indices.end(), {i, i, last});
    }
    soup.runs = {{.index_count = static_cast<std::uint32_t>(soup.indices.size()), .primitive = primitive}};
    return set_up(std::move(soup), state, rules, 1);
}

[[nodiscard]] inline PixelSet pixels_of(const std::vector<Fragment>& fragments) {
    PixelSet pixels;
    for (const Fragment& f : fragments) pixels.insert({f.x, f.y});
    return pixels;
}

[[nodiscard]] inline PixelSet drawn_line(const RandomLine& line, const RasterState& state, const RasterRules& rules) {
    const int bits = rules.subpixel_bits;
    return pixels_of(draw(shapes({vertex_at(line.a, bits), vertex_at(line.b, bits)}, Primitive::lines, state, rules),
                          {}, coverage_only)
                         .fragments);
}

// The pixels of the window for which `covers` (x, y) holds.
template <class Covers>
[[nodiscard]] PixelSet pixels_where(const Covers& covers) {
    PixelSet pixels;
    for (int y = 0; y < line_window; ++y)
        for (int x = 0; x < line_window; ++x)
            if (covers(x, y)) pixels.insert({x, y});
    return pixels;
}

}  // namespace strata::rasterizer
