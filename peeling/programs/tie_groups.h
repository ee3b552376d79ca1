// peeling/programs/tie_groups.h - extracts fragments of equal depth two at a time, those of the first and of the last
// submitted triangle, so that a peel loses none of them. Used by front_to_back_ties and dual_ties.
//
// Rule     A target holds, per pixel, (-least, greatest, 0, count) of the triangle numbers of the fragments that are
//          left at one depth: MAX on three channels, a sum on the fourth. Two fragments are taken per iteration; while
//          the count is above 2 some are left, whose numbers are between the two. Numbers are exact below 2^24.
// Source   peeling/reference/algorithms.md 25; Vasilakis and Fudos 2013.
// Tests    tests/peeling/algorithms/ties_test.cpp
#pragma once
#include <array>
#include <bit>
#include <vector>

#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

inline constexpr float no_number = -0x1p25f;  // less than minus any number
inline constexpr pipeline::ClearValue no_ties{.color = {no_number, no_number, 0, 0}};
inline constexpr pipeline::Blend extremes_and_count{
    .enabled = true,
    .color = {pipeline::BlendEquation::max, pipeline::BlendFactor::one, pipeline::BlendFactor::one},
    .alpha = {pipeline::BlendEquation::add, pipeline::BlendFactor::one, pipeline::BlendFactor::one}};
// OVER of a premultiplied colour.
inline constexpr pipeline::BlendTerm premultiplied_over{pipeline::BlendEquation::add, pipeline::BlendFactor::one,
                                                        pipeline::BlendFactor::one_minus_src_alpha};

inline constexpr rasterizer::FragmentNeeds depth_only{
    .shader_z = true, .code = false, .exact_code = false, .color = false, .texcoord = false, .facing = false};

inline namespace strict {

[[nodiscard]] inline bool is_visible(const pipeline::FragmentBatch& in, std::size_t i,
                                     const pipeline::Lanes<std::uint32_t>& opaque) noexcept {
    return in.shader_z[i] < std::bit_cast<float>(opaque[i]);
}

inline void name_group_targets(const pipeline::Region& region, const std::array<pipeline::Target, 2>& ties,
                               const std::array<pipeline::Target, 2>& layers,
                               const std::array<pipeline::Target, 2>& groups) {
    for (const pipeline::Target target : ties) region.set_name(target, "ties");
    for (const pipeline::Target target : layers) region.set_name(target, "layer");
    for (const pipeline::Target target : groups) region.set_name(target, "group");
}

// A triangle's number as the program has it: binary32.
[[nodiscard]] inline float number_of(const pipeline::FragmentBatch& in, std::size_t i) noexcept {
    return static_cast<float>(in.primitive[i]);
}

// True if fragments of the group are left after this iteration's two.
[[nodiscard]] inline bool is_open(const pipeline::ColorLanes& ties, std::size_t i) noexcept { return ties[3][i] > 2; }

// True if a fragment of the group is not taken yet; `ties` is the target of the iteration before.
[[nodiscard]] inline bool is_left(const pipeline::ColorLanes& ties, std::size_t i, float number) noexcept {
    return !is_open(ties, i) || (0.0f - ties[0][i] < number && number < ties[1][i]);
}

inline void write_number(pipeline::ColorLanes& out, std::size_t i, bool counts, float number) noexcept {
    out[0][i] = counts ? 0.0f - number : no_number;
    out[1][i] = counts ? number : no_number;
    out[2][i] = 0.0f;
    out[3][i] = counts ? 1.0f : 0.0f;
}

[[nodiscard]] inline bool is_first(const pipeline::ColorLanes& ties, std::size_t i, float number) noexcept {
    return 0.0f - ties[0][i] == number;
}
[[nodiscard]] inline bool is_last(const pipeline::ColorLanes& ties, std::size_t i, float number) noexcept {
    return ties[1][i] == number && !is_first(ties, i, number);
}

// (c a, a) of a chosen fragment, else 0, which MAX ignores.
inline void write_chosen(const pipeline::FragmentBatch& in, std::size_t i, bool is_chosen, pipeline::ColorLanes& out) {
    const float a = is_chosen ? in.color[3][i] : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) out[c][i] = in.color[c][i] * a;
    out[3][i] = a;
}

// Which of a layer and the part of its group that was set aside before is in front of the other.
enum class InFront : std::uint8_t { layer, group };

// A quad that sets a layer aside: next = layer and group, composited. `ties` are those of the iteration before; where
// they say that its group has ended, `group` is taken as empty.
inline void set_aside(pipeline::Region& region, pipeline::Target layer, InFront in_front, pipeline::Target group,
                      pipeline::Target ties, pipeline::Target next) {
    using namespace pipeline;
    PassState state;
    state.color[0] = next;
    state.reads = {layer, group, ties};
    static_cast<void>(region.full_screen(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes &added = loads.color(0), &before = loads.color(1);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const bool has_group = is_open(loads.color(2), i);
            const float added_alpha = added[3][i], before_alpha = has_group ? before[3][i] : 0.0f;
            for (std::size_t c = 0; c < 4; ++c) {
                const float kept = has_group ? before[c][i] : 0.0f;
                out.color[0][c][i] = in_front == InFront::layer ? added[c][i] + (1.0f - added_alpha) * kept
                                                                : kept + (1.0f - before_alpha) * added[c][i];
            }
        }
    }));
}

// A quad that blends a premultiplied layer.
inline void blend_layer(pipeline::Region& region, pipeline::Target layer, const pipeline::Blend& blend,
                        pipeline::Target result) {
    using namespace pipeline;
    PassState state;
    state.color[0] = result;
    state.blend[0] = blend;
    state.reads[0] = layer;
    static_cast<void>(region.full_screen(
        state, [](const FragmentBatch&, const Loads& loads, Outputs& out) { out.color[0] = loads.color(0); }));
}

// A quad that blends what was set aside, where the group has ended or where it is open. Tallies the pixels where `next`
// has a depth.
enum class Blended : std::uint8_t { ended_groups, open_groups };
inline pipeline::DrawCounts blend_group(pipeline::Region& region, pipeline::Target group, pipeline::Target ties,
                                        Blended which, pipeline::Target next, const pipeline::Blend& blend,
                                        pipeline::Target result) {
    using namespace pipeline;
    PassState state;
    state.color[0] = result;
    state.blend[0] = blend;
    state.reads = {group, ties, next};
    return region.full_screen(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = loads.color(0);
        std::uint32_t left = 0;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            left += loads.color(2)[0][i] != -1.0f ? 1 : 0;
            if (is_open(loads.color(1), i) == (which == Blended::open_groups)) continue;
            for (auto& channel : out.color[0]) channel[i] = 0.0f;
        }
        out.tally += left;
    });
}

// Traces fragments for the audit as their colours are blended: at once, or, if they are set aside, when their group
// ends, the last one first.
class GroupTrace {
  public:
    GroupTrace(pipeline::Region& region, pipeline::Side side) : region_{region}, side_{side} {}
    void add(const pipeline::FragmentBatch& in, const pipeline::Outputs& out, std::size_t i, bool is_set_aside) {
        if (!region_.frame().trace || out.alive[i] == 0) return;
        const pipeline::TraceEntry entry{in.pixel[i], ordered_code(in.shader_z[i]), in.primitive[i], side_, true};
        if (is_set_aside)
            waiting_.push_back(entry);
        else
            region_.trace(entry);
    }
    void blend(pipeline::Target ties, Blended which) {
        std::vector<pipeline::TraceEntry> open;
        for (auto entry = waiting_.rbegin(); entry != waiting_.rend(); ++entry)
            if (which == Blended::ended_groups && region_.targets().color(ties, entry->pixel)[3] > 2)
                open.push_back(*entry);
            else
                region_.trace(*entry);
        waiting_.assign(open.rbegin(), open.rend());
    }

  private:
    pipeline::Region& region_;
    pipeline::Side side_;
    std::vector<pipeline::TraceEntry> waiting_;
};

// Blends the groups that are still open after a limit of passes.
inline void blend_open_groups(pipeline::Region& region, GroupTrace& trace, pipeline::Target group,
                              pipeline::Target ties, const pipeline::Blend& blend, pipeline::Target result) {
    trace.blend(ties, Blended::open_groups);
    static_cast<void>(blend_group(region, group, ties, Blended::open_groups, ties, blend, result));
}

}  // namespace strict
}  // namespace strata::peeling
