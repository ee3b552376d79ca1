// rasterizer/values/attributes/chip_attributes.cpp - decides per triangle between NV2A's kernels and the definitions.
#include "rasterizer/values/attributes/chip_attributes.h"

#include <algorithm>
#include <utility>

#include "rasterizer/chip/color_weights.h"
#include "rasterizer/values/chip_lanes.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {
namespace {

using Corners3 = std::array<float, 3>;

[[nodiscard]] Corners3 inverse_w_of(const DrawnTriangle& triangle) noexcept {
    const auto& [a, b, c] = triangle.record.vertex;
    const auto& corners = triangle.geometry.corners;
    return {corners[a].inverse_w, corners[b].inverse_w, corners[c].inverse_w};
}
[[nodiscard]] Corners3 w_of(const DrawnTriangle& triangle) noexcept {
    const auto& [a, b, c] = triangle.record.vertex;
    const auto& vertices = triangle.geometry.vertices;
    return {vertices[a].w, vertices[b].w, vertices[c].w};
}

[[nodiscard]] bool is_affine(const Corners3& inverse_w) noexcept {
    return inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2];
}

// The triangle with the weights of colours and coordinates.
[[nodiscard]] ChipTriangle attribute_triangle(const DrawnTriangle& triangle, const Corners3& inverse_w,
                                              const DepthHypothesis& h) noexcept {
    if (is_affine(inverse_w)) return {triangle.weights, h};
    return {triangle.weights, h, w_of(triangle)};
}

// Fills channels with the same code at all corners: the weights add up to 256, so that (256 c + 128) >> 8 is c. True if
// no other channel is left.
[[nodiscard]] bool fill_constant_channels(ColorLanes& colors, int count) noexcept {
    bool is_done = true;
    for (std::size_t c = 0; c < color_channels; ++c) {
        const auto& [first, second, third] = colors.codes[c];
        if (first == second && first == third)
            std::fill_n(std::exchange(colors.out[c], nullptr), count, static_cast<float>(first) / 255.0f);
        else
            is_done = false;
    }
    return is_done;
}
// A smooth polygon's colours beyond its sides stay within those of its corners.
void limit_to_corners(const ColorLanes& colors, int count) noexcept {
    for (std::size_t c = 0; c < color_channels; ++c) {
        const auto [least, most] = std::minmax_element(colors.codes[c].begin(), colors.codes[c].end());
        const float from = static_cast<float>(*least) / 255.0f, to = static_cast<float>(*most) / 255.0f;
        for (int i = 0; i < count; ++i) colors.out[c][i] = std::clamp(colors.out[c][i], from, to);
    }
}
// A smooth line's colours beyond its ends are those of the ends.
[[nodiscard]] EdgeValues between_ends(const EdgeValues& e, std::int64_t area) noexcept {
    const std::int64_t second = std::clamp(e[2], std::int64_t{0}, area);
    return {0, area - second, second};
}
[[nodiscard]] bool is_finite(double v) noexcept { return v - v == 0.0; }

}  // namespace

void fill_chip_colors(const ChipKernels* kernels, const TriangleFragments& f, const TriangleLanes& lanes,
                      const ChipColor& color) noexcept {
    const DrawnTriangle& triangle = f.triangle;
    const RasterRules& rules = triangle.geometry.rules;
    const Corners3 inverse_w = inverse_w_of(triangle);
    const InterpolationHypothesis& hypothesis = rules.interpolation;
    ColorLanes colors;
    colors.out = color.out;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < color_channels; ++c)
            colors.codes[c][i] = to_color_code(color.corner[i][c], hypothesis.vertex_color_bits);
    const bool is_known = is_affine(inverse_w) || hypothesis.perspective_color == PerspectiveColor::cut_products;
    if (kernels != nullptr && is_known && ChipTriangle::suits(triangle.weights, triangle.record, rules.hypothesis)) {
        if (fill_constant_channels(colors, lanes.count)) return;
        return kernels->colors(attribute_triangle(triangle, inverse_w, rules.hypothesis), colors, lanes.x, lanes.y,
                               lanes.count);
    }
    const ColorWeights weights{w_of(triangle), inverse_w, lanes.edges->area(), rules.hypothesis,
                               hypothesis.perspective_color};
    const Shape shape = triangle.record.shape();
    for (int i = 0; i < lanes.count; ++i) {
        const EdgeValues e = lanes.edge_values(i);
        const std::array<std::int32_t, 3> w =
            weights.at(shape == Shape::line ? between_ends(e, lanes.edges->area()) : e);
        for (std::size_t c = 0; c < color_channels; ++c) colors.out[c][i] = weighted_color(w, colors.codes[c]);
    }
    if (shape == Shape::polygon) limit_to_corners(colors, lanes.count);
}

void fill_chip_coordinates(const ChipKernels* kernels, const DrawnTriangle& triangle, const TriangleLanes& lanes,
                           std::span<const TruncatedCoordinate> coordinates) noexcept {
    const RasterRules& rules = triangle.geometry.rules;
    const Corners3 inverse_w = inverse_w_of(triangle);
    const bool suits = kernels != nullptr && ChipTriangle::suits(triangle.weights, triangle.record, rules.hypothesis);
    CoordinateLanes by_kernel;
    const auto add = [&](const TruncatedCoordinate& c) {
        if (!suits || is_constant(c.u)) return false;
        const CoordinateLanes::Term term{c.u[1], double{c.u[0]} - double{c.u[1]}, double{c.u[2]} - double{c.u[1]},
                                         c.out};
        if (!is_finite(term.middle) || !is_finite(term.first) || !is_finite(term.last)) return false;
        by_kernel.term[by_kernel.count++] = term;
        return true;
    };
    const auto define = [&](const TruncatedCoordinate& c) {
        truncated_coordinates(c.u, coordinate_w(inverse_w, w_of(triangle)), lanes, rules.hypothesis, c.out);
    };
    for (const TruncatedCoordinate& c : coordinates)
        if (!add(c)) define(c);
    if (by_kernel.count == 0) return;
    if (!kernels->coordinates(attribute_triangle(triangle, inverse_w, rules.hypothesis), by_kernel, lanes.x, lanes.y,
                              lanes.count))
        return;
    for (const TruncatedCoordinate& c : coordinates) define(c);
}

}  // namespace strata::rasterizer
