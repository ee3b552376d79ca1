// rasterizer/values/attributes/unit_values.cpp - gathers the planes of a triangle's texture units.
#include "rasterizer/values/attributes/unit_values.h"

#include <cassert>

#include "rasterizer/values/attributes/chip_attributes.h"
#include "rasterizer/values/attributes/plane_attributes.h"
#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {

int UnitValues::fill(const TriangleFragments& f) const {
    const Geometry& geometry = f.triangle.geometry;
    assert(geometry.extras.has_units && "texture units are prepared with the geometry");
    std::array<const float*, 3> v;
    std::array<float, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = geometry.extras.units_of(f.triangle.record.vertex[i]);
        w[i] = geometry.corners[f.triangle.record.vertex[i]].inverse_w;
    }
    const DepthHypothesis& h = geometry.rules.hypothesis;
    const bool truncated = truncates_coordinates(geometry.rules, w);
    // Under the default hypothesis coordinates go through the kernel together with the other attributes.
    const bool is_plain = h.interpolant_bits >= 24 && h.divide == DivideRule::exact;
    const TriangleEdges edges = f.triangle.edges();
    const TriangleLanes lanes = f.lanes(edges);
    int fallbacks = 0;
    for (std::size_t u = 0; u < texture_units; ++u) {
        AttributeLanes planes;
        planes.has_w = w != std::array{1.0f, 1.0f, 1.0f};
        planes.inverse_w = {{w[0], w[1], w[2]}};
        std::array<TruncatedCoordinate, 4> truncated_values;
        std::size_t truncated_count = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            if (!names(units, u, c)) continue;
            float* const out = &f.batch.unit[u][c][f.first];
            const std::array<float, 3> value{v[0][4 * u + c], v[1][4 * u + c], v[2][4 * u + c]};
            if (truncated)
                truncated_values[truncated_count++] = {value, out};
            else if (!is_plain)
                fallbacks += interpolate(value, w, lanes, h, out);
            else if (is_constant(value))
                planes.add(value[0], out);
            else
                planes.add({{value[0] * w[0], value[1] * w[1], value[2] * w[2]}}, out);  // products in binary32
        }
        fill_chip_coordinates(chip_kernels, f.triangle, lanes, std::span{truncated_values}.first(truncated_count));
        if (planes.count + planes.constant_count > 0) fallbacks += fill_planes(kernels, planes, lanes);
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
