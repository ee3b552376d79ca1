// rasterizer/values/depth/depth_steps.cpp - the steps of depth_steps.h in their order.
#include "rasterizer/values/depth/depth_steps.h"

#include <algorithm>

#include "rasterizer/values/depth/code_lanes.h"
#include "rasterizer/values/depth/stepped_z.h"

namespace strata::rasterizer {

namespace {

// Codes of float32, codes of D32F by any path, and references are computed from shader_z.
[[nodiscard]] bool reads_shader_z(const DepthRequest& depth, const FragmentNeeds& needs) noexcept {
    const bool is_float = depth.format == DepthFormat::d32f;
    const bool is_of_z = depth.path == DepthPath::float32 || depth.path == DepthPath::packed_rgba8;
    return needs.shader_z || (needs.code && (is_of_z || is_float)) || (needs.exact_code && is_float) || needs.reference;
}

}  // namespace

DepthSteps::DepthSteps(const DepthConstants& constants, const Geometry& geometry, const DepthRequest& depth,
                       const FragmentNeeds& needs) noexcept
    : stored_{select_path(depth.path, geometry.rules.hypothesis)},
      compared_{select_path(depth.reference.value_or(depth.path), geometry.rules.hypothesis)},
      range_{constants, depth, geometry.rules},
      needs_{needs},
      shader_z_{geometry.rules.plane_rule != PlaneRule::exact ? ShaderZ::stepped_plane
                : reads_shader_z(depth, needs)                ? ShaderZ::exact_plane
                                                              : ShaderZ::not_needed},
      reference_{!needs.reference            ? Reference::not_needed
                 : compared_ != stored_      ? Reference::other_path
                 : stored_.converts_values() ? Reference::is_stored
                                             : Reference::values},
      rejects_{depth.path == DepthPath::depth_replace && !geometry.state.depth_clamp},
      is_own_order_{depth.path == DepthPath::logarithmic} {
    needs_.code |= is_own_order_;
}

int DepthSteps::fill(const DepthConstants& constants, const TriangleFragments& f) const {
    fill_weights(constants.kernels, f);
    const SetupTriangle corners = f.triangle.geometry.triangle(f.triangle.index);
    const TriangleEdges edges = f.triangle.edges();
    TriangleLanes lanes = f.lanes(edges);
    const DepthInput input{corners, f.triangle, lanes, &f.batch.shader_z[f.first]};
    const bool may_leave_range = range_.may_be_left(constants, input);
    int fallbacks = 0;
    if (shader_z_ == ShaderZ::stepped_plane)
        fill_stepped_z(constants, f);
    else if (shader_z_ == ShaderZ::exact_plane || may_leave_range)
        fallbacks +=
            round_plane(RationalPlane{corners.z, 1.0, constants.scale.z_units}, lanes, &f.batch.shader_z[f.first]);
    if (may_leave_range) {
        range_.drop_outside(constants, input, f);
        lanes.count = f.count();
    }
    if (needs_.code || rejects_) fallbacks += fill_stored(constants, input, f);
    lanes.count = f.count();
    if (reference_ != Reference::not_needed) fallbacks += fill_reference(constants, input, f);
    if (needs_.exact_code && is_own_order_)
        std::copy_n(&f.batch.code[f.first], lanes.count, &f.batch.exact_code[f.first]);
    else if (needs_.exact_code)
        fallbacks += exact_codes(constants, input, &f.batch.exact_code[f.first]);
    return fallbacks;
}

int DepthSteps::fill_stored(const DepthConstants& constants, const DepthInput& input,
                            const TriangleFragments& f) const {
    std::uint32_t* const code = &f.batch.code[f.first];
    if (!stored_.converts_values()) return stored_.codes(constants, input, code);
    Lanes<double> own;
    double* const depth = reference_ == Reference::is_stored ? &f.batch.reference_z[f.first] : own.data();
    const int fallbacks = stored_.values(constants, input, depth);
    if (rejects_) drop_rejected(constants.scale, f, depth);
    for (int i = 0; is_own_order_ && i < f.count(); ++i)
        f.batch.shader_z[f.first + static_cast<std::size_t>(i)] =
            static_cast<float>(depth[i] / constants.scale.code_units);
    if (needs_.code) to_codes(depth, f.count(), constants.scale.value_to_code, code);
    return fallbacks;
}

int DepthSteps::fill_reference(const DepthConstants& constants, const DepthInput& input,
                               const TriangleFragments& f) const {
    double* const z = &f.batch.reference_z[f.first];
    std::uint32_t* const code = &f.batch.reference_code[f.first];
    int fallbacks = 0;
    if (reference_ != Reference::is_stored) fallbacks += compared_.values(constants, input, z);
    if (reference_ != Reference::other_path)
        std::copy_n(&f.batch.code[f.first], input.lanes.count, code);
    else if (compared_.converts_values())
        to_codes(z, input.lanes.count, constants.scale.value_to_code, code);
    else
        fallbacks += compared_.codes(constants, input, code);
    return fallbacks;
}

}  // namespace strata::rasterizer
