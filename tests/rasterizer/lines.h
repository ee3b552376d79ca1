// tests/rasterizer/lines.h - random lines and points at window positions, the pixels that the rasterizer draws, and the
// model of NV2A's band.
#pragma once
#include <set>
#include <utility>

#include "tests/rasterizer/rational.h"
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

// Two ends with a depth, w and colours of their own.
[[nodiscard]] inline std::array<ClipVertex, 2> random_ends(Random& random) {
    std::array<ClipVertex, 2> ends;
    for (ClipVertex& v : ends) {
        v.x = random_float(random, 0, line_window);
        v.y = random_float(random, 0, line_window);
        v.z = random_float(random, 0.2f, 0.8f);
        v.w = random_float(random, 0.5f, 4.0f);
        for (float& c : v.front) c = random_float(random, 0, 1);
    }
    return ends;
}

// How many of a fragment's depth and colours differ from those of a rule: value(ends, value of each end, x, y) is a
// linear one, divide(over, under) a colour over w and 1 / w.
template <class Value, class Divide>
[[nodiscard]] int wrong_values(const Geometry& g, const std::array<ClipVertex, 2>& ends, const Fragment& f,
                               const Value& value, const Divide& divide) {
    const auto& [a, b] = ends;
    const float qa = g.corners[0].inverse_w, qb = g.corners[1].inverse_w;
    const Rounded under{value(a, b, qa, qb, f.x, f.y)};
    int wrong = f.shader_z != value(a, b, a.z, b.z, f.x, f.y) ? 1 : 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const Rounded over{
            value(a, b, (Rounded{a.front[c]} * Rounded{qa}).v, (Rounded{b.front[c]} * Rounded{qb}).v, f.x, f.y)};
        wrong += f.color[c] != divide(over, under).v ? 1 : 0;
    }
    return wrong;
}

// NV2A's rules of lines and points, with its four subpixel bits.
inline const RasterRules chip_lines{.subpixel_bits = 4,
                                    .snap = Snap::toward_zero,
                                    .guard_band_px = 524288,
                                    .lines = LineRule::band,
                                    .points = PointRule::reciprocal};

// lines-and-points.md 2, of a line that is `w` eighths of a pixel wide.
class BandModel {
  public:
    BandModel(const RandomLine& line, int w) : a_{line.a}, b_{line.b}, w_{w} {
        const Integer dx = b_.x - a_.x, dy = b_.y - a_.y;
        width_ = w * (2 * std::max(abs(dx), abs(dy)) + std::min(abs(dx), abs(dy)));
    }

    // In pixels.
    [[nodiscard]] bool has_in_box(int x, int y) const {
        const int h = (w_ + 15) / 16;
        return x >= pixel(std::min(a_.x, b_.x)) - h && x <= pixel(std::max(a_.x, b_.x)) + h &&
               y >= pixel(std::min(a_.y, b_.y)) - h && y <= pixel(std::max(a_.y, b_.y)) + h;
    }
    // In subpixels.
    [[nodiscard]] bool has_within_sides(int x, int y) const {
        const Integer dx = b_.x - a_.x, dy = b_.y - a_.y, px = x - a_.x, py = y - a_.y;
        if (w_ == 0 || (dx == 0 && dy == 0)) return false;
        const Integer e = dx * py - dy * px, t = dx * px + dy * py;
        return is_in(width_ + 2 * e, -dy, dx) && is_in(width_ - 2 * e, dy, -dx) && is_in(t, dx, dy) &&
               is_in(dx * dx + dy * dy - t, -dx, -dy);
    }

  private:
    [[nodiscard]] static int pixel(int v) { return floor(Rational{v, 16}).convert_to<int>(); }
    // A side with inward normal (nx, ny) and value `v` at the point.
    [[nodiscard]] static bool is_in(const Integer& v, const Integer& nx, const Integer& ny) {
        return v > 0 || (v == 0 && (nx < 0 || (nx == 0 && ny > 0)));
    }

    SubpixelPoint a_, b_;
    int w_;
    Integer width_;
};

}  // namespace strata::rasterizer
