// rasterizer/values/chip_fill.cpp - the part of a batch that the kernels of NV2A's interpolators fill
// (chip_lanes.h), and the fallback to the definitions (fragment_values.h).
#include <utility>

#include "rasterizer/chip/color_weights.h"
#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/truncated_coordinates.h"
#include "rasterizer/values/weight_lanes.h"

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
[[nodiscard]] bool is_finite(double v) noexcept { return v - v == 0.0; }

}  // namespace

// Fixed point: NV2A truncates, whatever the rounding rule, and clamps to the codes of the depth range.
ChipConversion FragmentValues::chip_conversion() const noexcept {
    if (!to_code_.is_fixed()) return {to_code_.kind, value_to_code_.least, value_to_code_.greatest};
    return {CodeKind::fixed, static_cast<double>(depth_code(to_code_.least, to_code_)),
            static_cast<double>(depth_code(to_code_.greatest, to_code_))};
}

bool FragmentValues::fill_chip_codes(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept {
    const DepthHypothesis& h = rules_.hypothesis;
    if (!is_chip_path_ || !ChipTriangle::suits(triangle.weights, triangle.record, h)) return false;
    const NarrowWindowZ z{window_z_corners(triangle.geometry, triangle.index, offset_), h};
    if (!z.is_narrow) return false;
    const auto f = static_cast<std::size_t>(first);
    chip_kernels_->window_z({triangle.weights, h}, z, &batch.x[f], &batch.y[f], batch.count - first, chip_.to_code,
                            &batch.code[f]);
    return true;
}

int FragmentValues::fill_quotient_reference(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                            const WeightLanes& weights) const noexcept {
    const TriangleEdges edges = triangle.edges();
    const auto f = static_cast<std::size_t>(first);
    const int fallbacks = quotient_depth(quotient_corners(triangle.geometry, triangle.record),
                                         lanes(triangle, edges, first, batch, weights), rules_.hypothesis, kernels_,
                                         &batch.reference_z[f]);
    fill_value_codes(&batch.reference_z[f], batch.count - first, &batch.reference_code[f]);
    return fallbacks;
}

bool FragmentValues::fill_chip_depth(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                     WeightLanes& weights, int& fallbacks) const noexcept {
    if (!is_chip_plain_ || triangle.weights.kind == PixelWeights::Kind::snapped_wide) return false;
    const std::array<double, 3> z = triangle.geometry.depths(triangle.index);
    if (chip_.may_leave_range(z)) return false;
    const auto f = static_cast<std::size_t>(first);
    if (needs_.shader_z) {
        const RationalPlane plane{z, 1.0, z_units_};
        if (plane.is_constant()) return false;
        const DepthLanes out{to_code_, &batch.shader_z[f], nullptr, &weights.b1[f], &weights.b2[f]};
        if (kernels_.depth(triangle.weights, FilterPlane{plane, triangle.weights.filter_reach()}, &batch.x[f],
                           &batch.y[f], batch.count - first, out))
            return false;
    } else if (needs_plane_weights_ || needs_.reference) {
        fill_weights(triangle, first, batch, weights);
    }
    if (needs_.code && !fill_chip_codes(triangle, first, batch)) return false;
    if (needs_.reference) fallbacks += fill_quotient_reference(triangle, first, batch, weights);
    return true;
}

void FragmentValues::fill_chip_colors(const DrawnTriangle& triangle, const TriangleLanes& lanes, int first,
                                      FragmentBatch& batch) const noexcept {
    const Corners3 inverse_w = inverse_w_of(triangle);
    const InterpolationHypothesis& hypothesis = rules_.interpolation;
    const auto f = static_cast<std::size_t>(first);
    ColorLanes colors;
    for (std::size_t i = 0; i < 3; ++i) {
        const ClipVertex& v = triangle.geometry.vertices[triangle.record.vertex[i]];
        const std::array<float, 4>& color = triangle.record.front_facing ? v.front : v.back;
        for (std::size_t c = 0; c < color_channels; ++c)
            colors.codes[c][i] = to_color_code(color[c], hypothesis.vertex_color_bits);
    }
    for (std::size_t c = 0; c < color_channels; ++c) colors.out[c] = &batch.color[c][f];
    const bool is_known = is_affine(inverse_w) || hypothesis.perspective_color == PerspectiveColor::cut_products;
    if (chip_kernels_ != nullptr && is_known &&
        ChipTriangle::suits(triangle.weights, triangle.record, rules_.hypothesis)) {
        if (fill_constant_channels(colors, lanes.count)) return;
        return chip_kernels_->colors(attribute_triangle(triangle, inverse_w, rules_.hypothesis), colors, lanes.x,
                                     lanes.y, lanes.count);
    }
    const ColorWeights weights{w_of(triangle), inverse_w, lanes.edges->area(), rules_.hypothesis,
                               hypothesis.perspective_color};
    for (int i = 0; i < lanes.count; ++i) {
        const std::array<std::int32_t, 3> w = weights.at(lanes.edge_values(i));
        for (std::size_t c = 0; c < color_channels; ++c) colors.out[c][i] = weighted_color(w, colors.codes[c]);
    }
}

void FragmentValues::fill_chip_coordinates(const DrawnTriangle& triangle, const TriangleLanes& lanes,
                                           std::span<const TruncatedCoordinate> coordinates) const noexcept {
    const Corners3 inverse_w = inverse_w_of(triangle);
    const bool suits =
        chip_kernels_ != nullptr && ChipTriangle::suits(triangle.weights, triangle.record, rules_.hypothesis);
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
        truncated_coordinates(c.u, coordinate_w(inverse_w, w_of(triangle)), lanes, rules_.hypothesis, c.out);
    };
    for (const TruncatedCoordinate& c : coordinates)
        if (!add(c)) define(c);
    if (by_kernel.count == 0) return;
    if (!chip_kernels_->coordinates(attribute_triangle(triangle, inverse_w, rules_.hypothesis), by_kernel, lanes.x,
                                    lanes.y, lanes.count))
        return;
    for (const TruncatedCoordinate& c : coordinates) define(c);
}

}  // namespace strata::rasterizer
