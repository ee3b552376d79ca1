// rasterizer/values/fragment_values.cpp - selects the parts of a draw's values and runs them.
#include "rasterizer/values/fragment_values.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/rules/depth_key.h"
#include "rasterizer/values/attributes/point_sprite.h"
#include "rasterizer/values/chip_lanes.h"
#include "rasterizer/values/lane_kernels.h"

namespace strata::rasterizer {
namespace {

// A reference by the stored path is a copy of the stored code.
[[nodiscard]] FragmentNeeds with_code(FragmentNeeds needs) noexcept {
    needs.code |= needs.reference;
    return needs;
}

// False for what checks before a draw refuse: window_z and w_buffer work in the buffer units of the format that is
// stored, which is not D32F, and quotients take r and q of the vertices.
[[maybe_unused]] [[nodiscard]] bool is_possible(const DepthScale& scale, const Geometry& geometry,
                                                const DepthRequest& depth) noexcept {
    const auto is_quotient = [](DepthPath path) {
        return path == DepthPath::perspective_rq || path == DepthPath::depth_replace;
    };
    const bool has_chip_units = scale.z_units == scale.code_units && depth.format != DepthFormat::d32f;
    const bool stores_chip_depth = depth.path == DepthPath::window_z || depth.path == DepthPath::w_buffer;
    const bool takes_quotient = is_quotient(depth.path) || (depth.reference && is_quotient(*depth.reference));
    return (!stores_chip_depth || has_chip_units) && (!takes_quotient || geometry.extras.has_rq);
}

}  // namespace

FragmentValues::FragmentValues(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs)
    : depth_{lane_kernels(), chip_kernels(), depth_scale(geometry, depth)},
      needs_{with_code(needs)},
      fast_{select_fast_depth(depth_, geometry, depth, needs_)},
      steps_{depth_, geometry, depth, needs_},
      is_reversed_{geometry.state.depth_order == DepthOrder::greater} {
    assert(is_possible(depth_.scale, geometry, depth));
    const bool has_attributes = needs.color || needs.texcoord;
    if (has_attributes && geometry.rules.plane_rule == PlaneRule::exact)
        attributes_.emplace<PlaneAttributes>(
            PlaneAttributes{depth_.kernels, depth_.chip_kernels, needs.color, needs.texcoord});
    else if (has_attributes)
        attributes_.emplace<SteppedAttributes>(SteppedAttributes{depth_.kernels, needs.color, needs.texcoord});
    if (needs.has_extras())
        units_.emplace(UnitValues{depth_.kernels, depth_.chip_kernels, needs.units, needs.fog, needs.secondary});
}

// Depth comes first: it may remove fragments.
int FragmentValues::fill(const DrawnTriangle& triangle, int first, FragmentBatch& batch, WeightLanes& weights) const {
    const TriangleFragments f{triangle, static_cast<std::size_t>(first), batch, weights};
    int fallbacks = fill_depths(f);
    if (is_reversed_) turn_into_keys(f);
    if (const auto* planes = std::get_if<PlaneAttributes>(&attributes_)) fallbacks += planes->fill(f);
    if (const auto* stepped = std::get_if<SteppedAttributes>(&attributes_)) stepped->fill(f);
    if (units_) fallbacks += units_->fill(f);
    if (needs_.texcoord && triangle.geometry.state.point_sprites && triangle.record.shape() == Shape::point)
        fill_sprite_coordinates(f);
    if (needs_.facing) std::fill_n(&batch.front_facing[f.first], f.count(), std::uint8_t{triangle.record.front_facing});
    return fallbacks;
}

int FragmentValues::fill_depths(const TriangleFragments& f) const {
    const auto try_form = [&](const auto& form) -> std::optional<int> {
        if constexpr (std::is_same_v<std::decay_t<decltype(form)>, std::monostate>)
            return std::nullopt;
        else
            return form.fill(depth_, f);
    };
    const std::optional<int> fallbacks = std::visit(try_form, fast_);
    return fallbacks ? *fallbacks : steps_.fill(depth_, f);
}

// Arrays that were not requested are left unchanged.
void FragmentValues::turn_into_keys(const TriangleFragments& f) const noexcept {
    FragmentBatch& batch = f.batch;
    const DepthFormat format = depth_.scale.format;
    for (auto i = f.first; i < static_cast<std::size_t>(batch.count); ++i) {
        if (needs_.shader_z) batch.shader_z[i] = depth_key(batch.shader_z[i]);
        if (needs_.code) batch.code[i] = depth_key(batch.code[i], format);
        if (needs_.reference) {
            batch.reference_code[i] = depth_key(batch.reference_code[i], format);
            batch.reference_z[i] = double{depth_key(static_cast<float>(batch.reference_z[i]))};
        }
        if (needs_.exact_code) batch.exact_code[i] = depth_key(batch.exact_code[i], format);
    }
}

}  // namespace strata::rasterizer
