// rasterizer/unit_values.cpp - the coordinates of texture units at a triangle's fragments.
//
// Rule     Each of s, t, r, q as fragment_values.h says of every attribute: u (1/w) rounded to binary32 at the vertex,
//          exact plane rounded once, over the plane of 1/w rounded once. Nothing is divided by q here: which operation
//          does, and which does not, is the texture shader's affair.
// Source   decisions.md 1; hardware.md 3 (GL 2.1 equation 3.8).
// Tests    tests/rasterizer/unit_values_test.cpp
#include <bit>
#include <cassert>

#include "rasterizer/fragment_values.h"

namespace strata::rasterizer {
namespace {

[[nodiscard]] bool same_bits(float a, float b) noexcept {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace

int FragmentValues::fill_units(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                               const WeightLanes& weights) const {
    const Geometry& geometry = triangle.geometry;
    assert(!geometry.units.empty() && "texture units are prepared with the geometry");
    std::array<const UnitCoordinates*, 3> v;
    std::array<float, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = &geometry.units[triangle.record.vertex[i]];
        w[i] = geometry.corners[triangle.record.vertex[i]].inverse_w;
    }
    const TriangleEdges edges = triangle.edges();
    const TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    int fallbacks = 0;
    for (std::size_t u = 0; u < texture_units; ++u) {
        AttributeLanes varying;
        varying.has_w = !(w[0] == 1.0f && w[1] == 1.0f && w[2] == 1.0f);
        varying.inverse_w = {{w[0], w[1], w[2]}};
        for (std::size_t c = 0; c < 4; ++c) {
            if (!names(needs_.units, u, c)) continue;
            float* const out = &batch.unit[u][c][static_cast<std::size_t>(first)];
            const auto value = [&](std::size_t i) { return (*v[i])[u][c]; };
            if (same_bits(value(0), value(1)) && same_bits(value(0), value(2))) {
                varying.add(value(0), out);
                continue;
            }
            const auto product = [&](std::size_t i) -> double { return value(i) * w[i]; };  // binary32
            varying.add({{product(0), product(1), product(2)}}, out);
        }
        if (varying.count + varying.constant_count > 0) fallbacks += fill_varying(varying, own);
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
