// peeling/programs/min_max.h - the min-max depth of dual peeling: (-near, far) in two binary32 channels under MAX
// blending. Bavoil and Myers 2008, "Render Targets"; E9. Cleared to (-1, -1), which is near = 1 > far = -1: a pixel
// with nothing to peel.
#pragma once
#include "peeling/programs/region_programs.h"
#include "peeling/programs/under.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

inline constexpr pipeline::ClearValue empty_min_max{.color = {-1, -1, 0, 0}};

// The side of the peeled range on which a fragment is, as 0 or ~0 per lane.
struct alignas(64) PeelLanes {
    pipeline::Lanes<std::uint32_t> is_near, is_far, is_between;
};

inline namespace strict {

// A fragment beyond the opaque surface, before `near` or behind `far` is skipped: no lane is set. near == far counts as
// near.
void classify(const pipeline::FragmentBatch& in, const pipeline::ColorLanes& min_max,
              const pipeline::Lanes<std::uint32_t>& opaque, PeelLanes& side) noexcept;

// Classifies by the frame's reference depth and its epsilon: a depth within epsilon of `near` or `far` counts as equal
// to it. Depths are compared as values; the frame determines whether they are rounded to binary32.
inline void classify(const pipeline::DepthCompare& compare, const pipeline::FragmentBatch& in,
                     const pipeline::ColorLanes& min_max, const pipeline::Lanes<std::uint32_t>& opaque,
                     PeelLanes& side) noexcept {
    using pipeline::mask;
    if (compare.is_plain()) return classify(in, min_max, opaque, side);
    for (std::size_t i = 0; i < lanes(in); ++i) {
        const double z = compare.own(in.reference_z[i]);
        const double near = double{-min_max[0][i]}, far = double{min_max[1][i]};
        const auto reaches = [&](double least, double greatest) { return !compare.exceeds(least, greatest); };
        const bool left = near <= far && in.shader_z[i] < std::bit_cast<float>(opaque[i]);
        const bool inside = left && reaches(near, z) && reaches(z, far);
        const bool is_near = inside && reaches(z, near), is_far = inside && !is_near && reaches(far, z);
        side.is_near[i] = mask(is_near);
        side.is_far[i] = mask(is_far);
        side.is_between[i] = mask(inside && !is_near && !is_far);
    }
}

// (-z, z) where the mask is set, else (-1, -1), which MAX ignores.
void write_min_max(const pipeline::FragmentBatch& in, const pipeline::Lanes<std::uint32_t>& mask,
                   pipeline::ColorLanes& out) noexcept;

// Writes the colours of a dual peel. RT1: the front colour, with the near fragment blended UNDER it; RT2: the colour of
// the far fragment, else 0.
void write_layers(const pipeline::FragmentBatch& in, const pipeline::ColorLanes& front, const PeelLanes& side,
                  pipeline::ColorLanes& next_front, pipeline::ColorLanes& back) noexcept;

// The definitions. A NaN depth fails every comparison: such a fragment is on neither side and writes values that MAX
// ignores.
namespace scalar {

inline void classify(const pipeline::Lanes<float>& shader_z, const pipeline::ColorLanes& min_max,
                     const pipeline::Lanes<std::uint32_t>& opaque, PeelLanes& side, std::size_t count) noexcept {
    using pipeline::mask;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = shader_z[i], near = -min_max[0][i], far = min_max[1][i];
        const std::uint32_t inside = mask(z < std::bit_cast<float>(opaque[i])) & mask(z >= near) & mask(z <= far);
        const std::uint32_t is_near = inside & mask(z == near), is_far = inside & mask(z == far) & ~is_near;
        side.is_near[i] = is_near;
        side.is_far[i] = is_far;
        side.is_between[i] = inside & ~is_near & ~is_far;
    }
}

// -1 is the least value of -z and z for depths in [0, 1], so MAX prefers any depth (E9).
inline void write_min_max(const pipeline::Lanes<float>& shader_z, const pipeline::Lanes<std::uint32_t>& chosen,
                          pipeline::ColorLanes& out, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const float z = shader_z[i];
        out[0][i] = pipeline::select(chosen[i], -z, -1.0f);
        out[1][i] = pipeline::select(chosen[i], z, -1.0f);
    }
}

inline void write_layers(const pipeline::ColorLanes& color, const pipeline::ColorLanes& front, const PeelLanes& side,
                         pipeline::ColorLanes& next_front, pipeline::ColorLanes& back, std::size_t count) noexcept {
    using pipeline::select;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) {
            const float through = let_through(OneFloat{}, front[3][i]);
            const float blended = under(front[c][i], through, color[3][i], color[c][i]);
            next_front[c][i] = select(side.is_near[i], blended, front[c][i]);
            back[c][i] = select(side.is_far[i], color[c][i], 0.0f);
        }
    for (std::size_t i = 0; i < count; ++i) {
        const float blended = covered(OneFloat{}, let_through(OneFloat{}, front[3][i]), color[3][i]);
        next_front[3][i] = select(side.is_near[i], blended, front[3][i]);
        back[3][i] = select(side.is_far[i], color[3][i], 0.0f);
    }
}

}  // namespace scalar
}  // namespace strict

// The first pass of both dual algorithms: the nearest and farthest visible depth of every pixel.
inline void initialize(pipeline::Region& region, pipeline::Target min_max) {
    using namespace pipeline;
    region.clear(min_max, empty_min_max);
    PassState state;
    state.color[0] = min_max;
    state.blend[0] = blend_mode::max;
    state.reads[0] = region.opaque_depth();
    state.needs = {
        .shader_z = true, .code = false, .exact_code = false, .color = false, .texcoord = false, .facing = false};
    state.selection = {.keeps = KeptFragments::ends,
                       .outside = Outside::writes_alike,
                       .far = {KeyBound::beyond(region.opaque_depth())}};
    static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        Lanes<std::uint32_t> visible;
        for (std::size_t i = 0; i < lanes(in); ++i)
            visible[i] = mask(in.shader_z[i] < std::bit_cast<float>(loads.depth(0)[i]));
        write_min_max(in, visible, out.color[0]);
    }));
}

// Selects the fragments of a peel: between the ends in `min_max`, and before the surface.
[[nodiscard]] inline pipeline::FragmentSelection ends_between(const pipeline::DepthCompare& compare,
                                                              pipeline::Target min_max, pipeline::Target surface,
                                                              pipeline::Outside outside) {
    pipeline::FragmentSelection selection{.keeps = pipeline::KeptFragments::ends,
                                          .outside = outside,
                                          .far = {pipeline::KeyBound::beyond(surface)},
                                          .range = min_max};
    if (!compare.is_plain()) selection.compared = compare;
    return selection;
}

// The layers that a dual peel composites during the peel, as separate images, if the frame keeps layers. After a peel
// its fragments are drawn again, those at the near end and those at the far end separately, with the fragments' own
// colours, not premultiplied. Fragments tied at a depth are one layer, MAX of each channel. This is not a pass of the
// emulated device and not counted (peeling/reference/algorithms.md 5.5).
class DualLayers {
  public:
    explicit DualLayers(pipeline::Region& region) : region_{region} {
        if (region.frame().keep_layers)
            layer_ = {region.make_color(), region.make_depth(), region.make(pipeline::Format::rg32f)};
    }

    // Keeps both layers of the pass that reads this min-max target.
    void keep(pipeline::Target min_max) {
        if (!region_.frame().keep_layers) return;
        pipeline::RegionShortcuts{region_}.uncounted([&] {
            keep(min_max, pipeline::Side::front);
            keep(min_max, pipeline::Side::back);
        });
    }

    // Call after the last pass. Other regions may continue: this one adds empty layers.
    void end() {
        if (!region_.frame().keep_layers) return;
        pipeline::RegionShortcuts{region_}.uncounted([&] { clear(); });
        region_.keep_no_layer(layer_.color, layer_.depth);
    }

  private:
    void clear() {
        region_.clear(layer_.color, {.color = {0, 0, 0, 0}});
        region_.copy(region_.opaque_depth(), layer_.depth);
    }

    void keep(pipeline::Target min_max, pipeline::Side side) {
        using namespace pipeline;
        clear();
        find_end(min_max, side);
        PassState state;
        state.color[0] = layer_.color;
        state.blend[0] = blend_mode::max;
        state.depth = {.enabled = true, .func = CompareFunc::lequal, .write = true};
        state.depth_target = layer_.depth;
        state.reads = {min_max, region_.opaque_depth()};
        const DepthCompare compare = region_.frame().depth_compare();
        state.needs.reference = !compare.is_plain();
        if (compare.is_plain()) state.selection = {.keeps = KeptFragments::interval, .range = layer_.end};
        static_cast<void>(region_.draw(
            state, region_.frame().second_list(), [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                PeelLanes lane;
                classify(compare, in, loads.color(0), loads.depth(1), lane);
                const Lanes<std::uint32_t>& taken = side == Side::front ? lane.is_near : lane.is_far;
                for (std::size_t i = 0; i < lanes(in); ++i) out.alive[i] &= taken[i];
                out.color[0] = in.color;
            }));
        region_.keep_layer(layer_.color, layer_.depth, side);
    }

    // Sets both ends of layer_.end to the depth of one end of `min_max`.
    void find_end(pipeline::Target min_max, pipeline::Side side) {
        using namespace pipeline;
        PassState state;
        state.color[0] = layer_.end;
        state.reads[0] = min_max;
        static_cast<void>(region_.full_screen(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < lanes(in); ++i) {
                const float z = side == Side::front ? -loads.color(0)[0][i] : loads.color(0)[1][i];
                out.color[0][0][i] = -z;
                out.color[0][1][i] = z;
            }
        }));
    }

    struct Targets {
        pipeline::Target color, depth, end;
    };
    pipeline::Region& region_;
    Targets layer_{};
};

}  // namespace strata::peeling
