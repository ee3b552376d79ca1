// rasterizer/values/depth/depth_range.cpp - removes the fragments of a triangle whose depth is outside the depth range
// (depth_steps.h).

#include <algorithm>

#include "rasterizer/chip/w_buffer.h"
#include "rasterizer/values/depth/depth_steps.h"
#include "rasterizer/values/depth_quotient.h"

namespace strata::rasterizer {
namespace {

// Removes the fragments for which keep(k) is false; moved(from, to) follows what moves, k = 0 being the first fragment.
template <class Keep, class Moved>
void keep_fragments(const TriangleFragments& f, const Keep& keep, const Moved& moved) noexcept {
    const auto count = static_cast<std::size_t>(f.count());
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
        if (!keep(k)) continue;
        if (kept != k) {
            move_lane(f.first + k, f.first + kept, f.batch, f.weights);
            moved(k, kept);
        }
        ++kept;
    }
    f.batch.count = static_cast<int>(f.first + kept);
}

}  // namespace

DepthRangeTest::DepthRangeTest(const DepthConstants& constants, const DepthRequest& depth,
                               const RasterRules& rules) noexcept
    : stores_w_{depth.path == DepthPath::w_buffer}, values_{nullptr} {
    const DepthScale& scale = constants.scale;
    const DepthPath path = stores_w_ ? DepthPath::w_buffer : DepthPath::window_z;
    if (scale.z_units == scale.code_units && depth.format != DepthFormat::d32f && is_chip(path, rules.hypothesis))
        values_ = stores_w_ ? w_buffer_values : chip_window_z_values;
}

// With a w buffer, w may leave the range even if z does not.
bool DepthRangeTest::may_be_left(const DepthConstants& constants, const DepthInput& input) const noexcept {
    const DepthScale& scale = constants.scale;
    if (!stores_w_) return scale.chip.may_leave_range(input.corners.z);
    if (!scale.chip.clips) return false;
    const std::array<float, 3> w = scaled_w(input.corners, input.triangle.geometry.state.w_scale);
    const auto [low, high] = std::minmax({w[0], w[1], w[2]});
    return scale.chip.offset.enabled || low < scale.value_to_code.least || high > scale.value_to_code.greatest;
}

void DepthRangeTest::drop_outside(const DepthConstants& constants, const DepthInput& input,
                                  const TriangleFragments& f) const noexcept {
    const DepthScale& scale = constants.scale;
    const auto nothing = [](std::size_t, std::size_t) {};
    if (values_ == nullptr) {
        const float* const z = &f.batch.shader_z[f.first];
        const float least = scale.to_code.least, greatest = scale.to_code.greatest;
        return keep_fragments(
            f, [=](std::size_t k) { return z[k] >= least && z[k] <= greatest; }, nothing);
    }
    Lanes<double> value;
    static_cast<void>(values_(constants, input, value.data()));
    const double least = scale.value_to_code.least, greatest = scale.value_to_code.greatest;
    keep_fragments(
        f, [&](std::size_t k) { return value[k] >= least && value[k] <= greatest; }, nothing);
}

void drop_rejected(const DepthScale& scale, const TriangleFragments& f, double* depth) noexcept {
    const auto is_inside = [&](std::size_t k) {
        return is_in_depth_range(depth[k], scale.value_to_code.least, scale.value_to_code.greatest);
    };
    keep_fragments(f, is_inside, [&](std::size_t from, std::size_t to) { depth[to] = depth[from]; });
}

}  // namespace strata::rasterizer
