// rasterizer/values/depth/fast_depth.cpp - the loops of fast_depth.h, and which of them suits a draw.
#include "rasterizer/values/depth/fast_depth.h"

#include "rasterizer/values/depth/code_lanes.h"
#include "rasterizer/values/depth/stepped_z.h"
#include "rasterizer/values/lane_kernels.h"

namespace strata::rasterizer {
namespace {

// True for the conversions that the kernels implement.
[[nodiscard]] bool has_vector_codes(const DepthConversion<float>& to) noexcept {
    return !to.wraps && (to.kind == CodeKind::fixed || to.kind == CodeKind::binary32);
}

// True if some attribute is interpolated by planes, whose value takes the weights.
[[nodiscard]] bool has_planes(const FragmentNeeds& needs, const RasterRules& rules) noexcept {
    const InterpolationHypothesis& h = rules.interpolation;
    const bool truncates_all = h.texture_coordinates == CoordinateRule::cut_weights &&
                               h.perspective_coordinates == PerspectiveCoordinates::cut_products;
    return (needs.color && rules.color != ColorInterpolation::weights_8bit) ||
           ((needs.texcoord || needs.has_extras()) && !truncates_all);
}

[[nodiscard]] bool has_wide_edges(const TriangleFragments& f) noexcept {
    return f.triangle.weights.kind == PixelWeights::Kind::snapped_wide;
}

// False if a lane is not certain.
[[nodiscard]] bool fill_by_kernel(const LaneKernels& kernels, const RationalPlane& plane, const TriangleFragments& f,
                                  const DepthLanes& out) noexcept {
    const FilterPlane filter{plane, f.triangle.weights.filter_reach()};
    return !kernels.depth(f.triangle.weights, filter, f.x(), f.y(), f.count(), out);
}

// A reference of r / q: the value in the buffer's own units and its code.
[[nodiscard]] int fill_quotient_reference(const DepthConstants& constants, const TriangleFragments& f) noexcept {
    const TriangleEdges edges = f.triangle.edges();
    double* const z = &f.batch.reference_z[f.first];
    const TriangleLanes lanes = f.lanes(edges);
    const int fallbacks = quotient_values(constants, f.triangle, lanes, z);
    to_codes(z, lanes.count, constants.scale.value_to_code, &f.batch.reference_code[f.first]);
    return fallbacks;
}

}  // namespace

std::optional<int> KernelDepth::fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept {
    if (has_wide_edges(f)) return std::nullopt;
    if (!has_z && !has_code) {
        if (has_weights) fill_weights(constants.kernels, f);
        return 0;
    }
    const RationalPlane plane{f.triangle.geometry.depths(f.triangle.index), 1.0, constants.scale.z_units};
    // round_plane converts a constant directly, with one rounding (depth.md 3.2).
    if (plane.is_constant()) return std::nullopt;
    const DepthLanes out{constants.scale.to_code, has_z ? &f.batch.shader_z[f.first] : nullptr,
                         has_code ? &f.batch.code[f.first] : nullptr, has_weights ? &f.weights.b1[f.first] : nullptr,
                         has_weights ? &f.weights.b2[f.first] : nullptr};
    if (!fill_by_kernel(constants.kernels, plane, f, out)) return std::nullopt;
    return 0;
}

std::optional<int> ChipKernelDepth::fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept {
    if (has_wide_edges(f)) return std::nullopt;
    const std::array<double, 3> z = f.triangle.geometry.depths(f.triangle.index);
    if (constants.scale.chip.may_leave_range(z)) return std::nullopt;
    if (has_z) {
        const RationalPlane plane{z, 1.0, constants.scale.z_units};
        if (plane.is_constant()) return std::nullopt;
        const DepthLanes out{constants.scale.to_code, &f.batch.shader_z[f.first], nullptr, &f.weights.b1[f.first],
                             &f.weights.b2[f.first]};
        if (!fill_by_kernel(constants.kernels, plane, f, out)) return std::nullopt;
    } else if (has_weights) {
        fill_weights(constants.kernels, f);
    }
    if (has_code && !chip_window_z_by_kernel(constants, f.triangle, f.x(), f.y(), f.count(), &f.batch.code[f.first]))
        return std::nullopt;
    return has_reference ? fill_quotient_reference(constants, f) : 0;
}

std::optional<int> SteppedDepth::fill(const DepthConstants& constants, const TriangleFragments& f) const noexcept {
    if (has_z || has_code) fill_stepped_z(constants, f);
    if (has_code)
        to_codes(&f.batch.shader_z[f.first], padded(f.count()), constants.scale.to_code, &f.batch.code[f.first]);
    return 0;
}

FastDepth select_fast_depth(const DepthConstants& constants, const Geometry& geometry, const DepthRequest& depth,
                            const FragmentNeeds& needs) noexcept {
    const RasterRules& rules = geometry.rules;
    const DepthScale& scale = constants.scale;
    if (needs.exact_code || depth.path == DepthPath::logarithmic) return {};
    const bool is_stepped = rules.plane_rule != PlaneRule::exact;
    const bool is_float32 = depth.path == DepthPath::float32;
    const bool stores_chip_z = depth.path == DepthPath::window_z && is_chip(depth.path, rules.hypothesis);
    if (!is_stepped && stores_chip_z && constants.chip_kernels != nullptr) {
        if (needs.reference && !is_quotient(depth.reference.value_or(depth.path))) return {};
        return ChipKernelDepth{needs.shader_z, needs.code, needs.reference,
                               needs.reference || has_planes(needs, rules)};
    }
    const bool rejects = depth.path == DepthPath::depth_replace && !geometry.state.depth_clamp;
    if (scale.chip.clips || needs.reference || rejects || (needs.code && !is_float32)) return {};
    if (is_stepped) {
        if (needs.has_extras()) return {};  // their planes take weights
        return SteppedDepth{needs.shader_z, needs.code};
    }
    if (constants.kernels.depth == nullptr || (needs.code && !has_vector_codes(scale.to_code))) return {};
    return KernelDepth{needs.shader_z, needs.code, needs.color || needs.texcoord || needs.has_extras()};
}

}  // namespace strata::rasterizer
