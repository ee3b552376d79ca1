// rasterizer/values/chip_values.cpp - depths that NV2A computes itself, window_z and w_buffer, and the depth range
// test that uses them (fragment_values.h).
#include <algorithm>

#include "rasterizer/chip/w_buffer.h"
#include "rasterizer/chip/window_z.h"
#include "rasterizer/set_up/polygon_offset.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {

bool FragmentValues::is_chip(DepthPath path) const noexcept {
    return path == DepthPath::w_buffer ||
           (path == DepthPath::window_z && rules_.hypothesis.window_z == WindowZRule::chip);
}

void FragmentValues::fill_chip_values(DepthPath path, const SetupTriangle& t, const TriangleLanes& lanes,
                                      double* out) const noexcept {
    const auto fill = [&](const auto& rule) {
        for (int i = 0; i < lanes.count; ++i) out[i] = rule.value(lanes.edge_values(i));
    };
    const DepthHypothesis& h = rules_.hypothesis;
    if (path == DepthPath::w_buffer) {
        const std::array<float, 3> w = scaled_w(t, w_scale_);
        const bool has_slope = offset_.enabled && offset_.factor != 0.0f;
        return fill(WBuffer{w, h, chip_offset(has_slope ? w_slope(t, w, clip_, rules_) : 0.0, offset_)});
    }
    if (!offset_.enabled) return fill(WindowZ24{t.z, lanes.edges->area(), h});
    const double slope = largest_slope(t.p, t.given_z, rules_.subpixel_bits);
    fill(WindowZ24{t.given_z, lanes.edges->area(), h, chip_offset(slope, offset_)});
}

// With a w buffer, w may leave the range even if z does not.
bool FragmentValues::may_leave_depth_range(const SetupTriangle& t) const noexcept {
    if (depth_.path == DepthPath::w_buffer) {
        const std::array<float, 3> w = scaled_w(t, w_scale_);
        const auto [low, high] = std::minmax({w[0], w[1], w[2]});
        return offset_.enabled || low < value_to_code_.least || high > value_to_code_.greatest;
    }
    return chip_.may_leave_range(t.z);
}

// ZClip::per_fragment compares NV2A's own value with the range if NV2A computes one (rasterizer/reference/depth.md
// 5.2): the w buffer's, else window z, whichever path is stored. Otherwise shader_z is compared (assumed): a value that
// rounds to n or f is inside.
void FragmentValues::drop_outside_depth_range(const SetupTriangle& t, const TriangleLanes& lanes, int first,
                                              FragmentBatch& batch, WeightLanes& weights) const noexcept {
    Lanes<double> value;
    const DepthPath path = depth_.path == DepthPath::w_buffer ? depth_.path : DepthPath::window_z;
    const bool by_chip = z_units_ == code_units_ && depth_.format != DepthFormat::d32f && is_chip(path);
    if (by_chip) fill_chip_values(path, t, lanes, value.data());
    const auto begin = static_cast<std::size_t>(first);
    auto kept = begin;
    for (auto i = kept; i < static_cast<std::size_t>(batch.count); ++i) {
        const double v = by_chip ? value[i - begin] : double{batch.shader_z[i]};
        const DepthConversion<double>& range = value_to_code_;
        const double least = by_chip ? range.least : double{to_code_.least};
        const double greatest = by_chip ? range.greatest : double{to_code_.greatest};
        if (!(v >= least && v <= greatest)) continue;
        move_lane(i, kept++, batch, weights);
    }
    batch.count = static_cast<int>(kept);
}

}  // namespace strata::rasterizer
