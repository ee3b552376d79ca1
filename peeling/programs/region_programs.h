// peeling/programs/region_programs.h - final passes, selections and queries that several algorithms share.
#pragma once
#include "peeling/programs/programs.h"
#include "peeling/programs/under.h"
#include "pipeline/region/region.h"
#include "rasterizer/rules/depth_key.h"

namespace strata::peeling {
// The selection of a peel that keeps the nearest fragment behind `peeled`, by any compared depth.
[[nodiscard]] inline pipeline::FragmentSelection nearest_behind(const pipeline::DepthCompare& compare,
                                                                pipeline::Target peeled) {
    pipeline::FragmentSelection selection{.keeps = pipeline::KeptFragments::nearest,
                                          .near = pipeline::KeyBound::beyond(peeled)};
    if (!compare.is_plain()) selection.compared = compare;
    return selection;
}

inline namespace strict {

// The promise of a one-layer peel about a region whose count is 0 (Region::any). Such a pass leaves the opaque depth in
// `peeled`, and a fragment that is stored in front of that depth but compares as behind it would have been found. Only
// if the first pass draws other vertices and compares nothing may it find nothing where the second finds such a
// fragment.
[[nodiscard]] inline pipeline::Idle idle_when_zero(const pipeline::Frame& frame) noexcept {
    return frame.second == nullptr || frame.depth_compare().is_plain() ? pipeline::Idle::yes : pipeline::Idle::no;
}

// True under reversed depth, where depth 1 is near.
[[nodiscard]] inline bool is_reversed(const pipeline::Frame& frame) noexcept {
    return frame.transparent->geometry.state.depth_order == rasterizer::DepthOrder::greater;
}

// True if codes are binary32 keys. Keys of d16 and d24 are evenly spaced from the near end, as depths under LESS are.
[[nodiscard]] inline bool has_float_keys(const pipeline::Frame& frame) noexcept {
    return is_reversed(frame) && frame.key_request().format == rasterizer::DepthFormat::d32f;
}

// A fragment's window depth under either depth order: `shader_z` is the key that orders fragments
// (rasterizer/reference/depth.md 11.2).
[[nodiscard]] inline float window_z(const pipeline::Frame& frame, float shader_z) noexcept {
    return is_reversed(frame) ? rasterizer::depth_key(shader_z) : shader_z;
}

// The distance of a depth from the near end of the depth range, 0 near and 1 far under either depth order. `key` is the
// key of the depth.
[[nodiscard]] inline float depth_behind_near(bool reversed, float key) noexcept {
    return reversed ? 1.0f - rasterizer::depth_key(key) : key;
}

// OVER of a colour that is not premultiplied onto a premultiplied one: onto an opaque background alpha stays 1 and is
// not written, else it is 1 - (1 - alpha) (1 - A).
[[nodiscard]] inline pipeline::Blend over_background(const pipeline::Frame& frame) noexcept {
    using namespace pipeline;
    Blend over = blend_mode::over;
    if (frame.is_opaque())
        over.write_mask = 0x7;
    else
        over.alpha = {BlendEquation::add, BlendFactor::one, BlendFactor::one_minus_src_alpha};
    return over;
}

// Publishes the front over the colour behind it, including alpha: the last quad of every peel that composites from the
// front.
inline void publish_over(pipeline::Region& region, pipeline::Target front, FrontAlpha meaning,
                         pipeline::Target behind) {
    using namespace pipeline;
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    PassState state;
    state.color[0] = result;
    state.reads = {front, behind};
    static_cast<void>(region.full_screen(state, [meaning](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        Lanes<float> through;
        for (std::size_t i = 0; i < lanes(in); ++i) through[i] = scalar::through_front(meaning, loads.color(0)[3][i]);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes(in); ++i)
                out.color[0][c][i] = scalar::composited(loads.color(0)[c][i], through[i], loads.color(1)[c][i]);
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.color[0][3][i] = scalar::alpha_over(through[i], loads.color(1)[3][i]);
    }));
    region.publish(result);
}

inline void publish_over_background(pipeline::Region& region, pipeline::Target accumulated,
                                    pipeline::Target background) {
    publish_over(region, accumulated, FrontAlpha::lets_through, background);
}

}  // namespace strict
}  // namespace strata::peeling
