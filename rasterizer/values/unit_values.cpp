// rasterizer/values/unit_values.cpp - the texture coordinates of each texture unit at a triangle's fragments.
//
// Rule     Each of s, t, r, q is interpolated like every attribute in fragment_values.h: u (1/w) rounded to binary32 at
//          the vertex, exact plane rounded once, divided by the plane of 1/w rounded once. Under another
//          DepthHypothesis they are interpolated as depth_paths.h does r and q; where truncated_coordinates.h applies,
//          by its rule. Nothing is divided by q here: the texture shader decides which operation does.
// Source   rasterizer/reference/attributes.md 1.1 and 3.4 (GL 2.1 equation 3.8).
// Tests    tests/rasterizer/values/unit_values_test.cpp
#include <cassert>

#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {
namespace {

using Corners = std::array<float, 3>;

}  // namespace

int FragmentValues::fill_units(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                               const WeightLanes& weights) const {
    const Geometry& geometry = triangle.geometry;
    assert(geometry.extras.has_units && "texture units are prepared with the geometry");
    std::array<const float*, 3> v;
    Corners w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = geometry.extras.units_of(triangle.record.vertex[i]);
        w[i] = geometry.corners[triangle.record.vertex[i]].inverse_w;
    }
    const DepthHypothesis& h = rules_.hypothesis;
    const bool truncated = truncates_coordinates(rules_, w);
    // Under the default hypothesis coordinates go through the kernel together with the other attributes.
    const bool is_plain = h.interpolant_bits >= 24 && h.divide == DivideRule::exact;
    const TriangleEdges edges = triangle.edges();
    const TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    int fallbacks = 0;
    for (std::size_t u = 0; u < texture_units; ++u) {
        AttributeLanes varying;
        varying.has_w = w != std::array{1.0f, 1.0f, 1.0f};
        varying.inverse_w = {{w[0], w[1], w[2]}};
        std::array<TruncatedCoordinate, 4> truncated_values;
        std::size_t truncated_count = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            if (!names(needs_.units, u, c)) continue;
            float* const out = &batch.unit[u][c][static_cast<std::size_t>(first)];
            const Corners value{v[0][4 * u + c], v[1][4 * u + c], v[2][4 * u + c]};
            if (truncated)
                truncated_values[truncated_count++] = {value, out};
            else if (!is_plain)
                fallbacks += interpolate(value, w, own, h, out);
            else if (is_constant(value))
                varying.add(value[0], out);
            else
                varying.add({{value[0] * w[0], value[1] * w[1], value[2] * w[2]}}, out);  // products in binary32
        }
        fill_chip_coordinates(triangle, own, std::span{truncated_values}.first(truncated_count));
        if (varying.count + varying.constant_count > 0) fallbacks += fill_varying(varying, own);
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
