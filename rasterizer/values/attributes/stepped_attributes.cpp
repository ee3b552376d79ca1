// rasterizer/values/attributes/stepped_attributes.cpp - gathers the stepped planes of a triangle's attributes.
#include "rasterizer/values/attributes/stepped_attributes.h"

#include <algorithm>
#include <array>

#include "rasterizer/values/float_planes.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/ordered_planes.h"

namespace strata::rasterizer {

namespace {

// Corner values are multiplied by `w` before they become planes; `under` is the plane of `w`.
struct Divisor {
    std::array<float, 3> w;
    FloatPlane under;
    std::array<std::uint32_t, 3> vertex;  // the corners of the planes
};

template <class Planes>
void fill_by(const SteppedAttributes& attributes, const Planes& planes, const Divisor& divisor,
             const TriangleFragments& f) noexcept {
    const RasterRules& rules = f.triangle.geometry.rules;
    const bool is_front = f.triangle.record.front_facing;
    std::array<const ClipVertex*, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = &f.triangle.geometry.vertices[divisor.vertex[i]];
    FloatAttributeLanes lanes{rules.plane_rule, rules.perspective, divisor.under};
    const std::size_t begin = attributes.has_color ? 0 : color_channels;
    const std::size_t end = attributes.has_texcoord ? attribute_count : color_channels;
    for (std::size_t a = begin; a < end; ++a) {
        const bool is_color = a < color_channels;
        std::array<float, 3> values, over_w;
        for (std::size_t i = 0; i < 3; ++i) {
            values[i] = !is_color ? v[i]->texcoord[a - color_channels] : is_front ? v[i]->front[a] : v[i]->back[a];
            over_w[i] = values[i] * divisor.w[i];
        }
        float* const out = is_color ? &f.batch.color[a][f.first] : &f.batch.texcoord[a - color_channels][f.first];
        if (is_color && rules.equal_colors == EqualColors::kept && is_constant(values))
            std::fill_n(out, f.count(), values[0]);
        else
            lanes.add(planes.plane(over_w), out);
    }
    attributes.kernels.float_attributes(lanes, f.x(), f.y(), f.count());
}

}  // namespace

void SteppedAttributes::fill(const TriangleFragments& f) const noexcept {
    const Geometry& geometry = f.triangle.geometry;
    const RasterRules& rules = geometry.rules;
    if (rules.plane_rule == PlaneRule::greatest_w) {
        const OrderedPlanes planes = ordered_planes(geometry, f.triangle.index);
        const Divisor none{{1, 1, 1}, planes.plane({1, 1, 1}), geometry.plane_vertices(f.triangle.index)};
        return fill_by(*this, planes, none, f);
    }
    const FloatPlanes planes = float_planes(geometry, f.triangle.record);
    Divisor divisor{{}, {}, f.triangle.record.vertex};
    for (std::size_t i = 0; i < 3; ++i) divisor.w[i] = geometry.corners[divisor.vertex[i]].inverse_w;
    divisor.under = planes.plane(divisor.w);
    if (rules.sample_divisor == SampleDivisor::centre && planes.is_sampled())
        divisor.under.right = divisor.under.down = 0.5f;
    fill_by(*this, planes, divisor, f);
}

}  // namespace strata::rasterizer
