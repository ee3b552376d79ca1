// rasterizer/values/attribute_values.cpp - colours and texture coordinates of a batch by exact planes.
#include <bit>

#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {
namespace {

[[nodiscard]] bool same_bits(float a, float b) noexcept {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace

int FragmentValues::fill_attributes(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                    const WeightLanes& weights) const {
    const Geometry& geometry = triangle.geometry;
    const auto f = static_cast<std::size_t>(first);
    const bool weighted = needs_.color && rules_.color == ColorInterpolation::weights_8bit;
    const std::size_t begin = needs_.color && !weighted ? 0 : color_channels;
    std::array<const ClipVertex*, 3> v;
    std::array<double, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = &geometry.vertices[triangle.record.vertex[i]];
        w[i] = geometry.corners[triangle.record.vertex[i]].inverse_w;
    }
    const bool truncated = needs_.texcoord && truncates_coordinates(rules_, w);
    const std::size_t end = needs_.texcoord && !truncated ? attribute_count : color_channels;
    AttributeLanes varying;
    // If every w is 1, the quotient equals the dividend.
    varying.has_w = !(w[0] == 1.0 && w[1] == 1.0 && w[2] == 1.0);
    varying.inverse_w = {w};
    for (std::size_t a = begin; a < end; ++a) {
        const auto value = [&](std::size_t i) {
            if (a >= color_channels) return v[i]->texcoord[a - color_channels];
            return triangle.record.front_facing ? v[i]->front[a] : v[i]->back[a];
        };
        float* const out = a < color_channels ? &batch.color[a][f] : &batch.texcoord[a - color_channels][f];
        if (same_bits(value(0), value(1)) && same_bits(value(0), value(2))) {
            varying.add(value(0), out);
            continue;
        }
        const auto product = [&](std::size_t i) -> double { return value(i) * static_cast<float>(w[i]); };  // binary32
        varying.add({{product(0), product(1), product(2)}}, out);
    }
    const TriangleEdges edges = triangle.edges();
    const TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    if (weighted) fill_chip_colors(triangle, own, first, batch);
    if (truncated) {
        const auto corners = [&](std::size_t a) {
            return std::array{v[0]->texcoord[a], v[1]->texcoord[a], v[2]->texcoord[a]};
        };
        fill_chip_coordinates(triangle, own,
                              std::array{TruncatedCoordinate{corners(0), &batch.texcoord[0][f]},
                                         TruncatedCoordinate{corners(1), &batch.texcoord[1][f]}});
    }
    return fill_varying(varying, own);
}

int FragmentValues::fill_varying(const AttributeLanes& varying, const TriangleLanes& lanes) const {
    if (!kernels_.attributes(varying, lanes)) return 0;
    // The kernel's filter could not decide a lane: every plane is computed again, with exact arithmetic where needed.
    int fallbacks = 0;
    alignas(64) Lanes<float> inverse_w;
    if (varying.has_w) fallbacks += round_plane(varying.inverse_w, lanes, inverse_w.data());
    for (std::size_t k = 0; k < varying.count; ++k) {
        float* const out = varying.out[k];
        fallbacks += round_plane(varying.plane[k], lanes, out);
        for (int i = 0; varying.has_w && i < lanes.count; ++i) out[i] = out[i] / inverse_w[static_cast<std::size_t>(i)];
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
