// rasterizer/values/fragment_values.cpp - fills depths, codes and references of a batch (fragment_values.h) in the path
// that the constructor chose.
#include "rasterizer/values/fragment_values.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/base/nv20_arithmetic.h"
#include "rasterizer/rules/depth_key.h"
#include "rasterizer/set_up/window.h"
#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {
namespace {

template <CodeKind kind, class Value>
void to_codes_of(const Value* __restrict z, int count, const DepthConversion<Value> to,
                 std::uint32_t* __restrict out) noexcept {
    for (int i = 0; i < count; ++i) out[i] = depth_code<kind>(OneLane<Value>{}, z[i], to);
}

template <class Value>
void to_codes(const Value* z, int count, const DepthConversion<Value>& to, std::uint32_t* out) noexcept {
    if constexpr (std::is_same_v<Value, float>)
        if (to.wraps) {
            for (int i = 0; i < count; ++i) out[i] = to_wrapped_code(z[i], to);
            return;
        }
    switch (to.kind) {
        case CodeKind::fixed: return to_codes_of<CodeKind::fixed>(z, count, to, out);
        case CodeKind::fixed_product: return to_codes_of<CodeKind::fixed_product>(z, count, to, out);
        case CodeKind::fixed_truncated_product:
            return to_codes_of<CodeKind::fixed_truncated_product>(z, count, to, out);
        case CodeKind::binary32: return to_codes_of<CodeKind::binary32>(z, count, to, out);
        case CodeKind::d16f: return to_codes_of<CodeKind::d16f>(z, count, to, out);
        case CodeKind::d24f: return to_codes_of<CodeKind::d24f>(z, count, to, out);
    }
}

[[nodiscard]] bool is_quotient(DepthPath path) noexcept {
    return path == DepthPath::perspective_rq || path == DepthPath::depth_replace;
}

// True for the paths that compute a value before it is converted to a code.
[[nodiscard]] bool is_value(DepthPath path, const DepthHypothesis& hypothesis) noexcept {
    return is_quotient(path) || path == DepthPath::float32_plane ||
           (path == DepthPath::window_z && hypothesis.window_z == WindowZRule::float32);
}

// True for the conversions that the kernels implement.
[[nodiscard]] bool has_vector_codes(const DepthConversion<float>& to) noexcept {
    return !to.wraps && (to.kind == CodeKind::fixed || to.kind == CodeKind::binary32);
}

}  // namespace

FragmentValues::FragmentValues(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs)
    : kernels_{lane_kernels()},
      rules_{geometry.rules},
      depth_{depth},
      needs_{needs},
      z_units_{z_units(geometry.state, geometry.rules)},
      code_units_{buffer_units(depth.format)},
      to_code_{depth_conversion(depth.format, rules_.depth_rounding, 1.0f, geometry.state.depth_near,
                                geometry.state.depth_far)},
      value_to_code_{depth_conversion(depth.format, rules_.depth_rounding, code_units_, geometry.state.depth_near,
                                      geometry.state.depth_far)},
      chip_kernels_{chip_kernels()} {
    // A reference by the stored path is a copy of the stored code, so it needs that code.
    needs_.code |= needs.reference;
    rejects_ = depth.path == DepthPath::depth_replace && !geometry.state.depth_clamp;
    if (rules_.offset_rule == OffsetRule::fragments) offset_ = geometry.state.polygon_offset;
    clip_ = geometry.state.viewport;
    if (geometry.state.scissor) clip_ = intersection(clip_, *geometry.state.scissor);
    w_scale_ = geometry.state.w_scale;
    clips_fragments_ = rules_.z_clip == ZClip::per_fragment && !geometry.state.depth_clamp;
    chip_ = {chip_conversion(),         offset_,
             value_to_code_.least,      value_to_code_.greatest,
             to_code_.least * z_units_, to_code_.greatest * z_units_,
             clips_fragments_};
    const bool is_float = depth.format == DepthFormat::d32f;
    // Codes of float32, codes of d32f by any path, and references are computed from shader_z.
    needs_float_z_ = needs.shader_z || (needs_.code && (depth.path == DepthPath::float32 || is_float)) ||
                     (needs.exact_code && is_float) || needs.reference;
    needs_attributes_ = needs.color || needs.texcoord || needs.units != 0;
    is_reversed_ = geometry.state.depth_order == DepthOrder::greater;
    // Keys of reversed depth are limited to the depth range (rasterizer/reference/depth.md 2.9); the formats without a
    // sign have no codes outside it.
    to_code_.wraps = rules_.depth_limits == DepthLimits::wrap && depth.path == DepthPath::float32 && !is_reversed_ &&
                     !geometry.state.depth_clamp && (to_code_.is_fixed() || is_float);
    if (rules_.depth_limits == DepthLimits::zero_to_one && depth.path == DepthPath::float32 && !is_reversed_ &&
        !geometry.state.depth_clamp && !clips_fragments_ && (to_code_.is_fixed() || is_float))
        to_code_ = depth_conversion(depth.format, rules_.depth_rounding, 1.0f);
    assert((!is_reversed_ || is_float) && "reversed depth has keys for codes of D32F alone");
    is_plain_ = kernels_.depth != nullptr && rules_.plane_rule == PlaneRule::exact && !clips_fragments_ &&
                !needs.exact_code && !needs.reference && !rejects_ &&
                (!needs.code || (depth.path == DepthPath::float32 && has_vector_codes(to_code_)));
    is_float_plain_ = rules_.plane_rule != PlaneRule::exact && !clips_fragments_ && !needs.exact_code &&
                      !needs.reference && !rejects_ && needs.units == 0 &&
                      (!needs.code || depth.path == DepthPath::float32);
    is_chip_path_ = chip_kernels_ != nullptr && depth.path == DepthPath::window_z && is_chip(depth.path);
    is_chip_plain_ = is_chip_path_ && rules_.plane_rule == PlaneRule::exact && !needs.exact_code &&
                     (!needs.reference || is_quotient(depth.reference.value_or(depth.path)));
    const DepthPath compared = depth.reference.value_or(depth.path);
    reference_is_stored_ = needs.reference && is_value(depth.path, rules_.hypothesis) &&
                           (compared == depth.path || (is_quotient(compared) && is_quotient(depth.path)));
    const InterpolationHypothesis& interpolation = rules_.interpolation;
    const bool truncates_all = interpolation.texture_coordinates == CoordinateRule::cut_weights &&
                               interpolation.perspective_coordinates == PerspectiveCoordinates::cut_products;
    needs_plane_weights_ = (needs.color && rules_.color != ColorInterpolation::weights_8bit) ||
                           ((needs.texcoord || needs.units != 0) && !truncates_all);
    assert(((depth.path != DepthPath::window_z && depth.path != DepthPath::w_buffer) ||
            (z_units_ == code_units_ && !is_float)) &&
           "window_z and w_buffer work in the buffer units of the format that is stored, which is no d32f");
    assert((geometry.extras.has_rq || !is_quotient(depth.path)) &&
           (geometry.extras.has_rq || !depth.reference || !is_quotient(*depth.reference)) &&
           "perspective_rq and depth_replace take r and q of the vertices");
}

TriangleLanes FragmentValues::lanes(const DrawnTriangle& triangle, const TriangleEdges& edges, int first,
                                    const FragmentBatch& batch, const WeightLanes& weights) const noexcept {
    const auto f = static_cast<std::size_t>(first);
    return {&edges,         rules_.subpixel_bits, &batch.x[f],         &batch.y[f],
            &weights.b1[f], &weights.b2[f],       batch.count - first, triangle.weights.filter_reach()};
}

void FragmentValues::fill_weights(const DrawnTriangle& triangle, int first, const FragmentBatch& batch,
                                  WeightLanes& weights) const noexcept {
    const PixelWeights& w = triangle.weights;
    const auto f = static_cast<std::size_t>(first);
    if (w.kind != PixelWeights::Kind::snapped_wide)
        return kernels_.weights(w, &batch.x[f], &batch.y[f], batch.count - first, &weights.b1[f], &weights.b2[f]);
    const TriangleEdges edges = triangle.edges();
    const TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    for (int i = 0; i < own.count; ++i) {
        const EdgeValues e = own.edge_values(i);
        weights.b1[f + static_cast<std::size_t>(i)] = static_cast<double>(e[1]) * w.r;
        weights.b2[f + static_cast<std::size_t>(i)] = static_cast<double>(e[2]) * w.r;
    }
}

bool FragmentValues::fill_depth(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                WeightLanes& weights) const noexcept {
    const auto f = static_cast<std::size_t>(first);
    if (!is_plain_ || triangle.weights.kind == PixelWeights::Kind::snapped_wide) return false;
    if (!needs_float_z_) {
        if (needs_attributes_) fill_weights(triangle, first, batch, weights);
        return true;
    }
    const RationalPlane plane{triangle.geometry.depths(triangle.index), 1.0, z_units_};
    // round_plane converts a constant directly, with one rounding (depth.md 3.2).
    if (plane.is_constant()) return false;
    const DepthLanes out{to_code_, needs_.shader_z ? &batch.shader_z[f] : nullptr,
                         needs_.code ? &batch.code[f] : nullptr, needs_attributes_ ? &weights.b1[f] : nullptr,
                         needs_attributes_ ? &weights.b2[f] : nullptr};
    return !kernels_.depth(triangle.weights, FilterPlane{plane, triangle.weights.filter_reach()}, &batch.x[f],
                           &batch.y[f], batch.count - first, out);
}

// depth[0] belongs to fragment `first`.
void FragmentValues::drop_rejected(int first, FragmentBatch& batch, WeightLanes& weights,
                                   double* depth) const noexcept {
    const auto begin = static_cast<std::size_t>(first);
    std::size_t kept = begin;
    for (std::size_t i = begin; i < static_cast<std::size_t>(batch.count); ++i) {
        if (!is_in_depth_range(depth[i - begin], value_to_code_.least, value_to_code_.greatest)) continue;
        if (kept != i) {
            depth[kept - begin] = depth[i - begin];
            move_lane(i, kept, batch, weights);
        }
        ++kept;
    }
    batch.count = static_cast<int>(kept);
}

void FragmentValues::fill_value_codes(const double* values, int count, std::uint32_t* out) const noexcept {
    to_codes(values, count, value_to_code_, out);
}

void FragmentValues::fill_float_codes(int first, FragmentBatch& batch) const noexcept {
    const auto f = static_cast<std::size_t>(first);
    to_codes(&batch.shader_z[f], padded(batch.count - first), to_code_, &batch.code[f]);
}

// The exact plane in the buffer's own units, rounded once to binary32 and then truncated: NV2A's float formats.
int FragmentValues::fill_rounded_codes(const SetupTriangle& t, const TriangleLanes& lanes,
                                       std::uint32_t* out) const noexcept {
    const bool in_units = z_units_ == code_units_;
    alignas(64) Lanes<float> z;
    const RationalPlane plane{t.z, in_units ? 1.0 : code_units_, in_units ? 1.0 : z_units_};
    const int fallbacks = round_plane(plane, lanes, z.data());
    for (int i = 0; i < lanes.count; ++i) out[i] = code_of(double{z[static_cast<std::size_t>(i)]});
    return fallbacks;
}

// DepthPath::exact: the plane in codes, rounded once, then clamped to the codes of the depth range (depth.md 4.3).
int FragmentValues::fill_exact_codes(const SetupTriangle& t, const TriangleLanes& lanes, const float* shader_z,
                                     std::uint32_t* out) const noexcept {
    switch (to_code_.kind) {
        case CodeKind::binary32: {
            DepthConversion<float> in_range = to_code_;
            in_range.wraps = false;  // an audit sorts by exact codes, so they must not wrap
            to_codes(shader_z, padded(lanes.count), in_range, out);
            return 0;
        }
        case CodeKind::d16f:
        case CodeKind::d24f: return fill_rounded_codes(t, lanes, out);
        case CodeKind::fixed:
        case CodeKind::fixed_product:
        case CodeKind::fixed_truncated_product: break;
    }
    const std::uint32_t max = max_code(depth_.format);
    const bool in_codes = z_units_ == max;
    const RationalPlane plane{t.z, in_codes ? 1.0 : max, in_codes ? 1.0 : z_units_};
    // The exact plane has no binary32 product: it rounds once, for product_even too, with a half rounded up.
    const double half = truncates(rules_.depth_rounding) ? 0.0 : 0.5;
    const int fallbacks = round_plane(plane, lanes, CodeRounding{half, max}, out);
    const std::uint32_t least = depth_code(to_code_.least, to_code_),
                        greatest = depth_code(to_code_.greatest, to_code_);
    for (int i = 0; i < padded(lanes.count); ++i) out[i] = std::clamp(out[i], least, greatest);
    return fallbacks;
}

int FragmentValues::fill_codes(DepthPath path, const SetupTriangle& t, const TriangleLanes& lanes,
                               const float* shader_z, std::uint32_t* out) const {
    if (path == DepthPath::float32) {
        to_codes(shader_z, padded(lanes.count), to_code_, out);
        return 0;
    }
    if (!is_chip(path)) return fill_exact_codes(t, lanes, shader_z, out);
    Lanes<double> value;
    fill_chip_values(path, t, lanes, value.data());
    if (!to_code_.is_fixed()) {
        fill_value_codes(value.data(), lanes.count, out);
        return 0;
    }
    const ChipConversion& to = chip_.to_code;
    for (int i = 0; i < lanes.count; ++i)
        out[i] = static_cast<std::uint32_t>(std::clamp(value[static_cast<std::size_t>(i)], to.least, to.greatest));
    return 0;
}

// A path's depth as binary64 in the buffer's own units, before any clamp: used by unquantized comparison and converted
// by value paths.
int FragmentValues::fill_depth_values(DepthPath path, const SetupTriangle& t, const DrawnTriangle& triangle,
                                      const TriangleLanes& lanes, const float* shader_z, double* out) const {
    const DepthHypothesis& h = rules_.hypothesis;
    int fallbacks = 0;
    switch (path) {
        case DepthPath::perspective_rq:
        case DepthPath::depth_replace:
            fallbacks = quotient_depth(quotient_corners(triangle.geometry, triangle.record), lanes, h, kernels_, out);
            break;
        case DepthPath::float32_plane: float32_plane_depth(t, rules_, lanes, out); break;
        case DepthPath::float32:
            for (int i = 0; i < lanes.count; ++i) out[i] = double{shader_z[i]} * code_units_;
            return 0;
        case DepthPath::window_z:
            if (is_chip(path))
                fill_chip_values(path, t, lanes, out);
            else
                fallbacks = window_z_depth(t, lanes, h, out);
            break;
        case DepthPath::w_buffer: fill_chip_values(path, t, lanes, out); return 0;
        case DepthPath::exact: plane_depth(t, lanes, out); break;
    }
    for (int i = 0; z_units_ != code_units_ && i < lanes.count; ++i) out[i] = out[i] * code_units_ / z_units_;
    return fallbacks;
}

int FragmentValues::fill_value_codes(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                     FragmentBatch& batch, WeightLanes& weights) const {
    const auto f = static_cast<std::size_t>(first);
    const TriangleEdges edges = triangle.edges();
    Lanes<double> own;
    double* const depth = reference_is_stored_ ? &batch.reference_z[f] : own.data();
    const int fallbacks = fill_depth_values(depth_.path, t, triangle, lanes(triangle, edges, first, batch, weights),
                                            &batch.shader_z[f], depth);
    if (rejects_) drop_rejected(first, batch, weights, depth);
    if (needs_.code) fill_value_codes(depth, batch.count - first, &batch.code[f]);
    return fallbacks;
}

// The compared depth (depth.md 6.1). Its code is computed exactly as if a pass stored this path.
int FragmentValues::fill_reference(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                   FragmentBatch& batch, const WeightLanes& weights) const {
    const auto f = static_cast<std::size_t>(first);
    const DepthPath path = depth_.reference.value_or(depth_.path);
    const TriangleEdges edges = triangle.edges();
    const TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    if (reference_is_stored_) {  // fill_value_codes wrote it with the stored code
        std::copy_n(&batch.code[f], own.count, &batch.reference_code[f]);
        return 0;
    }
    int fallbacks = fill_depth_values(path, t, triangle, own, &batch.shader_z[f], &batch.reference_z[f]);
    if (path == depth_.path) {
        std::copy_n(&batch.code[f], own.count, &batch.reference_code[f]);
    } else if (is_value(path, rules_.hypothesis)) {
        fill_value_codes(&batch.reference_z[f], own.count, &batch.reference_code[f]);
    } else {
        fallbacks += fill_codes(path, t, own, &batch.shader_z[f], &batch.reference_code[f]);
    }
    return fallbacks;
}

// The general case. Fragments outside are dropped as early as possible, so that later arrays are filled only for the
// remaining ones.
int FragmentValues::fill_values(const SetupTriangle& t, const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                WeightLanes& weights) const {
    const auto f = static_cast<std::size_t>(first);
    fill_weights(triangle, first, batch, weights);
    const TriangleEdges edges = triangle.edges();
    TriangleLanes own = lanes(triangle, edges, first, batch, weights);
    const bool clips = clips_fragments_ && may_leave_depth_range(t);
    int fallbacks = 0;
    if (rules_.plane_rule != PlaneRule::exact)
        fill_float_z(triangle, first, batch);
    else if (needs_float_z_ || clips)
        fallbacks += round_plane(RationalPlane{t.z, 1.0, z_units_}, own, &batch.shader_z[f]);
    if (clips) {
        drop_outside_depth_range(t, own, first, batch, weights);
        own.count = batch.count - first;
    }
    if (is_value(depth_.path, rules_.hypothesis) && (needs_.code || rejects_)) {
        fallbacks += fill_value_codes(t, triangle, first, batch, weights);
        own.count = batch.count - first;
    } else if (needs_.code && !fill_chip_codes(triangle, first, batch)) {
        fallbacks += fill_codes(depth_.path, t, own, &batch.shader_z[f], &batch.code[f]);
    }
    if (needs_.reference) fallbacks += fill_reference(t, triangle, first, batch, weights);
    if (needs_.exact_code) fallbacks += fill_exact_codes(t, own, &batch.shader_z[f], &batch.exact_code[f]);
    return fallbacks;
}

// Arrays that were not requested are left unchanged.
void FragmentValues::turn_into_keys(int first, FragmentBatch& batch) const noexcept {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
        if (needs_.shader_z) batch.shader_z[i] = depth_key(batch.shader_z[i]);
        if (needs_.code) batch.code[i] = depth_key(batch.code[i]);
        if (needs_.reference) {
            batch.reference_code[i] = depth_key(batch.reference_code[i]);
            batch.reference_z[i] = double{depth_key(static_cast<float>(batch.reference_z[i]))};
        }
        if (needs_.exact_code) batch.exact_code[i] = depth_key(batch.exact_code[i]);
    }
}

int FragmentValues::fill(const DrawnTriangle& triangle, int first, FragmentBatch& batch, WeightLanes& weights) const {
    int fallbacks = 0;
    if (rules_.plane_rule != PlaneRule::exact)
        fallbacks += fill_float_values(triangle, first, batch, weights);
    else if (!fill_depth(triangle, first, batch, weights) &&
             !fill_chip_depth(triangle, first, batch, weights, fallbacks))
        fallbacks += fill_values(triangle.geometry.triangle(triangle.index), triangle, first, batch, weights);
    if (is_reversed_) turn_into_keys(first, batch);
    if (needs_attributes_ && rules_.plane_rule == PlaneRule::exact)
        fallbacks += fill_attributes(triangle, first, batch, weights);
    if (needs_.units != 0) fallbacks += fill_units(triangle, first, batch, weights);
    if (needs_.facing)
        std::fill_n(&batch.front_facing[static_cast<std::size_t>(first)], batch.count - first,
                    std::uint8_t{triangle.record.front_facing});
    return fallbacks;
}

}  // namespace strata::rasterizer
