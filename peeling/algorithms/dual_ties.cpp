// peeling/algorithms/dual_ties.cpp - a dual peel that loses no fragment of equal depth: an extra pass counts the
// fragments at both depths being peeled, and two of each are taken per iteration. Vasilakis and Fudos 2013,
// "Depth-Fighting Aware Methods for Multifragment Rendering", at both ends; peeling/reference/algorithms.md 25.
//
// Needs      float MAX blending, a separate blend equation for alpha, five render targets. GeForce8 has all of these.
// Passes     1 + 2 max(1, iterations); without ties ceil(N/2) iterations. Of equal depths the first submitted is in
//            front.
// Invariant  before an iteration, min_max = (-near, far) of the depths that remain; each end's `ties` = what is left at
//            its depth; `front` and `back` = all layers outside these depths and the fragments taken from the outer
//            end of their groups; each end's `group` = those taken from the inner end.
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/min_max.h"
#include "peeling/programs/tie_groups.h"

namespace strata::peeling::listing::dual_ties {

using namespace pipeline;

namespace {

struct PeelEnd {
    Region& region;
    Side side;
    Target ties = region.make(Format::rgba32f), next_ties = region.make(Format::rgba32f);
    Target first = region.make_color(), last = region.make_color(), group = region.make_color();
    Target next_group = region.make_color();
    GroupTrace trace{region, side};
};

struct DualTiesPeel {
    Region& region;
    Target min_max = region.make(Format::rg32f), next_min_max = region.make(Format::rg32f);
    Target front = region.make_color(), back = region.make(region.frame().behind_format());
    PeelEnd near{region, Side::front}, far{region, Side::back};
};

// Fragments that are not selected write what MAX and the counts ignore.
FragmentSelection ends_of(const DualTiesPeel& p) {
    return ends_between({}, p.min_max, p.region.opaque_depth(), Outside::writes_alike);
}

// Counts the fragments that are left at each end, and finds the least and the greatest number of their triangles. Where
// both ends have one depth, it is the end at which the group was begun, or the near one.
void count_ties(const DualTiesPeel& p) {
    PassState state;
    state.color = {p.near.next_ties, p.far.next_ties};
    state.blend = {extremes_and_count, extremes_and_count};
    state.reads = {p.min_max, p.near.ties, p.far.ties, p.region.opaque_depth()};
    state.needs = depth_only;
    state.selection = ends_of(p);
    p.region.clear(p.near.next_ties, no_ties), p.region.clear(p.far.next_ties, no_ties);
    static_cast<void>(p.region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float z = in.shader_z[i], near = 0.0f - loads.color(0)[0][i], far = loads.color(0)[1][i];
            const float number = number_of(in, i);
            const bool has_both = near == far, is_far_open = is_open(loads.color(2), i);
            const bool is_near = z == near && !(has_both && is_far_open), is_far = z == far && !(has_both && is_near);
            const bool sees = is_visible(in, i, loads.depth(3)) && near <= far;  // none left: 1 and -1
            write_number(out.color[0], i, sees && is_near && is_left(loads.color(1), i, number), number);
            write_number(out.color[1], i, sees && is_far && is_left(loads.color(2), i, number), number);
        }
    }));
}

// Draws up to two fragments of each end into a layer each, and finds the next depths: those between the ends, and an
// end itself if more than these are left there.
void take_four(DualTiesPeel& p) {
    PassState state;
    state.color = {p.next_min_max, p.near.first, p.near.last, p.far.first, p.far.last};
    for (std::size_t t = 0; t < 5; ++t) state.blend[t] = blend_mode::max;
    state.reads = {p.min_max, p.near.next_ties, p.far.next_ties, p.region.opaque_depth()};
    state.needs.code = false;
    state.selection = ends_of(p);
    p.region.clear(p.next_min_max, empty_min_max);
    for (std::size_t t = 1; t < 5; ++t) p.region.clear(state.color[t], {});
    static_cast<void>(p.region.draw(state, [&p](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float z = in.shader_z[i], ends[2]{0.0f - loads.color(0)[0][i], loads.color(0)[1][i]};
            const bool sees = is_visible(in, i, loads.depth(3)) && ends[0] <= ends[1];
            bool is_next = sees && z > ends[0] && z < ends[1];
            for (const std::size_t e : {0u, 1u}) {
                const ColorLanes& ties = loads.color(static_cast<int>(1 + e));
                const bool is_here = sees && z == ends[e];
                const bool takes_first = is_here && is_first(ties, i, number_of(in, i));
                const bool takes_last = is_here && is_last(ties, i, number_of(in, i));
                write_chosen(in, i, takes_first, out.color[1 + 2 * e]);
                write_chosen(in, i, takes_last, out.color[2 + 2 * e]);
                GroupTrace& trace = e == 0 ? p.near.trace : p.far.trace;
                if (takes_first || takes_last) trace.add(in, out, i, e == 0 ? takes_last : takes_first);
                is_next = is_next || (is_here && is_open(ties, i));
            }
            out.color[0][0][i] = is_next ? 0.0f - z : -1.0f;
            out.color[0][1][i] = is_next ? z : -1.0f;
        }
    }));
}

// Blends the outer fragment of an end, and the rest of its group where the group has ended. Counts the pixels that have
// a next depth.
DrawCounts composite(DualTiesPeel& p, PeelEnd& end, const Blend& blend, Target result) {
    const bool is_near = end.side == Side::front;
    set_aside(p.region, is_near ? end.last : end.first, is_near ? InFront::layer : InFront::group, end.group, end.ties,
              end.next_group);
    blend_layer(p.region, is_near ? end.first : end.last, blend, result);
    std::swap(end.ties, end.next_ties), std::swap(end.group, end.next_group);
    end.trace.blend(end.ties, Blended::ended_groups);
    return blend_group(p.region, end.group, end.ties, Blended::ended_groups, p.next_min_max, blend, result);
}

void run(Region& region) {
    DualTiesPeel p{region};
    region.set_name(p.min_max, "min_max"), region.set_name(p.next_min_max, "min_max");
    region.set_name(p.front, "front"), region.set_name(p.back, "back");
    for (const PeelEnd* end : {&p.near, &p.far})
        name_group_targets(region, {end->ties, end->next_ties}, {end->first, end->last}, {end->group, end->next_group});
    Blend over = over_background(region.frame());
    over.color = over.alpha = premultiplied_over;
    region.clear(p.front, {.color = {0, 0, 0, 1}});
    region.copy(region.opaque_color(), p.back);
    region.clear(p.near.ties, no_ties), region.clear(p.far.ties, no_ties);
    initialize(region, p.min_max);
    while (!region.limit_reached(2)) {
        region.begin_iteration();
        count_ties(p);
        take_four(p);
        static_cast<void>(composite(p, p.near, blend_mode::under, p.front));
        const DrawCounts drawn = composite(p, p.far, over, p.back);
        std::swap(p.min_max, p.next_min_max);
        if (!region.any(drawn.tallied, Idle::yes)) break;
    }
    blend_open_groups(region, p.near.trace, p.near.group, p.near.ties, blend_mode::under, p.front);
    blend_open_groups(region, p.far.trace, p.far.group, p.far.ties, over, p.back);
    publish_over_background(region, p.front, p.back);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "dual_ties",
                      .listed = 251,
                      .paper = "Vasilakis and Fudos 2013",
                      .section = "F2B-2P, at both ends",
                      .summary = "dual peeling and a pass that counts the fragments at both ends: all are composited",
                      .pass_formula = "1 + 2 max(1, K), K ~ N/2 without ties",
                      .ties = TiePolicy::first,
                      .key = DepthKey::shader_z,
                      .exact = true,
                      .takes_both_ends = true,
                      .compares_own_codes = true,
                      .run = run,
                      .features = {float_targets, fragment_programs, separate_alpha_blend},
                      .render_targets = 5}};
}

}  // namespace strata::peeling::listing::dual_ties
