// rasterizer/values/attributes/unit_values.cpp - gathers the planes of a triangle's texture units, of its fog
// coordinate and of its secondary colour.
#include "rasterizer/values/attributes/unit_values.h"

#include <cassert>

#include "rasterizer/values/attributes/chip_attributes.h"
#include "rasterizer/values/attributes/plane_attributes.h"
#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {
namespace {

// Up to four values that are interpolated together: those of a texture unit, or of a colour.
struct Together {
    const UnitValues& values;
    const TriangleFragments& f;
    const TriangleLanes& lanes;
    std::array<float, 3> w;  // 1 / w of the corners
    std::array<TruncatedCoordinate, 4> of{};
    std::size_t count = 0;

    void add(const std::array<float, 3>& corners, float* out) { of[count++] = {corners, out}; }

    // By exact planes, whatever the hypothesis.
    [[nodiscard]] int fill_planes() const {
        AttributeLanes planes;
        planes.has_w = w != std::array{1.0f, 1.0f, 1.0f};
        planes.inverse_w = {{w[0], w[1], w[2]}};
        for (const auto& [u, out] : std::span{of}.first(count)) {
            if (is_constant(u))
                planes.add(u[0], out);
            else
                planes.add({{u[0] * w[0], u[1] * w[1], u[2] * w[2]}}, out);  // products in binary32
        }
        return planes.count + planes.constant_count > 0 ? rasterizer::fill_planes(values.kernels, planes, lanes) : 0;
    }

    // By the rule of coordinates.
    [[nodiscard]] int fill() const {
        const RasterRules& rules = f.triangle.geometry.rules;
        if (truncates_coordinates(rules, w)) {
            fill_chip_coordinates(values.chip_kernels, f.triangle, lanes, std::span{of}.first(count));
            return 0;
        }
        // Under the default hypothesis coordinates go through the kernel together with the other attributes.
        const DepthHypothesis& h = rules.hypothesis;
        if (h.interpolant_bits >= 24 && h.divide == DivideRule::exact) return fill_planes();
        int fallbacks = 0;
        for (const auto& [u, out] : std::span{of}.first(count)) fallbacks += interpolate(u, w, lanes, h, out);
        return fallbacks;
    }
};

// The values of the corners at one place of their extras.
[[nodiscard]] std::array<float, 3> at(const std::array<const float*, 3>& v, std::size_t place) noexcept {
    return {v[0][place], v[1][place], v[2][place]};
}

[[nodiscard]] int fill_secondary(const TriangleFragments& f, Together together) {
    const Geometry& geometry = f.triangle.geometry;
    ChipColor color;
    for (std::size_t i = 0; i < 3; ++i)
        color.corner[i] = geometry.extras.secondary_of(f.triangle.record.vertex[i], f.triangle.record.front_facing);
    for (std::size_t c = 0; c < color_channels; ++c) {
        color.out[c] = &f.batch.secondary[c][f.first];
        together.add(at(color.corner, c), color.out[c]);
    }
    if (geometry.rules.color != ColorInterpolation::weights_8bit) return together.fill_planes();
    fill_chip_colors(together.values.chip_kernels, f, together.lanes, color);
    return 0;
}

}  // namespace

int UnitValues::fill(const TriangleFragments& f) const {
    const Geometry& geometry = f.triangle.geometry;
    const VertexExtras& extras = geometry.extras;
    assert((units == 0 || extras.has_units) && "texture units are prepared with the geometry");
    assert((!has_fog || extras.has_fog) && "fog coordinates are prepared with the geometry");
    assert((!has_secondary || extras.has_secondary) && "secondary colours are prepared with the geometry");
    const std::array<std::uint32_t, 3>& vertex = f.triangle.record.vertex;
    const TriangleEdges edges = f.triangle.edges();
    const TriangleLanes lanes = f.lanes(edges);
    Together none{*this, f, lanes, {}};
    for (std::size_t i = 0; i < 3; ++i) none.w[i] = geometry.corners[vertex[i]].inverse_w;
    int fallbacks = 0;
    for (std::size_t u = 0; units != 0 && u < texture_units; ++u) {
        const std::array v{extras.units_of(vertex[0]), extras.units_of(vertex[1]), extras.units_of(vertex[2])};
        Together unit = none;
        for (std::size_t c = 0; c < 4; ++c)
            if (names(units, u, c)) unit.add(at(v, 4 * u + c), &f.batch.unit[u][c][f.first]);
        fallbacks += unit.fill();
    }
    if (has_fog) {
        Together fog = none;
        fog.add(at({extras.of(vertex[0]), extras.of(vertex[1]), extras.of(vertex[2])}, extras.fog_place()),
                &f.batch.fog[f.first]);
        fallbacks += fog.fill();
    }
    if (has_secondary) fallbacks += fill_secondary(f, none);
    return fallbacks;
}

}  // namespace strata::rasterizer
