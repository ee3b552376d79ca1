// rasterizer/values/attributes/plane_attributes.cpp - gathers the planes of a triangle's attributes for the kernel.
#include "rasterizer/values/attributes/plane_attributes.h"

#include "rasterizer/values/attributes/chip_attributes.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/truncated_coordinates.h"

namespace strata::rasterizer {
namespace {

using CornerVertices = std::array<const ClipVertex*, 3>;

[[nodiscard]] std::array<float, 3> corner_values(const CornerVertices& v, const TriangleRecord& record,
                                                 std::size_t attribute) noexcept {
    std::array<float, 3> value;
    for (std::size_t i = 0; i < 3; ++i)
        value[i] = attribute >= color_channels ? v[i]->texcoord[attribute - color_channels]
                   : record.front_facing       ? v[i]->front[attribute]
                                               : v[i]->back[attribute];
    return value;
}

void fill_weighted(const ChipKernels* chip_kernels, const TriangleFragments& f, const CornerVertices& v,
                   const TriangleLanes& lanes) noexcept {
    ChipColor color;
    for (std::size_t i = 0; i < 3; ++i)
        color.corner[i] = f.triangle.record.front_facing ? v[i]->front.data() : v[i]->back.data();
    for (std::size_t c = 0; c < color_channels; ++c) color.out[c] = &f.batch.color[c][f.first];
    fill_chip_colors(chip_kernels, f, lanes, color);
}

void fill_truncated(const ChipKernels* chip_kernels, const TriangleFragments& f, const CornerVertices& v,
                    const TriangleLanes& lanes) noexcept {
    std::array<TruncatedCoordinate, 2> coordinates;
    for (std::size_t a = 0; a < coordinates.size(); ++a)
        coordinates[a] = {corner_values(v, f.triangle.record, color_channels + a), &f.batch.texcoord[a][f.first]};
    fill_chip_coordinates(chip_kernels, f.triangle, lanes, coordinates);
}

}  // namespace

int PlaneAttributes::fill(const TriangleFragments& f) const {
    const Geometry& geometry = f.triangle.geometry;
    const TriangleRecord& record = f.triangle.record;
    const bool has_weighted_color = has_color && geometry.rules.color == ColorInterpolation::weights_8bit;
    CornerVertices v;
    std::array<double, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = &geometry.vertices[record.vertex[i]];
        w[i] = geometry.corners[record.vertex[i]].inverse_w;
    }
    const bool truncated = has_texcoord && truncates_coordinates(geometry.rules, w);
    const std::size_t begin = has_color && !has_weighted_color ? 0 : color_channels;
    const std::size_t end = has_texcoord && !truncated ? attribute_count : color_channels;
    AttributeLanes planes;
    // If every w is 1, the quotient equals the dividend.
    planes.has_w = !(w[0] == 1.0 && w[1] == 1.0 && w[2] == 1.0);
    planes.inverse_w = {w};
    for (std::size_t a = begin; a < end; ++a) {
        float* const out =
            a < color_channels ? &f.batch.color[a][f.first] : &f.batch.texcoord[a - color_channels][f.first];
        const std::array<float, 3> u = corner_values(v, record, a);
        if (is_constant(u)) {
            planes.add(u[0], out);
            continue;
        }
        const auto product = [&](std::size_t i) -> double { return u[i] * static_cast<float>(w[i]); };  // binary32
        planes.add({{product(0), product(1), product(2)}}, out);
    }
    const TriangleEdges edges = f.triangle.edges();
    const TriangleLanes lanes = f.lanes(edges);
    if (has_weighted_color) fill_weighted(chip_kernels, f, v, lanes);
    if (truncated) fill_truncated(chip_kernels, f, v, lanes);
    return fill_planes(kernels, planes, lanes);
}

int fill_planes(const LaneKernels& kernels, const AttributeLanes& planes, const TriangleLanes& lanes) {
    if (!kernels.attributes(planes, lanes)) return 0;
    // The kernel's filter could not decide a lane: every plane is computed again, with exact arithmetic where needed.
    int fallbacks = 0;
    alignas(64) Lanes<float> inverse_w;
    if (planes.has_w) fallbacks += round_plane(planes.inverse_w, lanes, inverse_w.data());
    for (std::size_t k = 0; k < planes.count; ++k) {
        float* const out = planes.out[k];
        fallbacks += round_plane(planes.plane[k], lanes, out);
        for (int i = 0; planes.has_w && i < lanes.count; ++i) out[i] = out[i] / inverse_w[static_cast<std::size_t>(i)];
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
