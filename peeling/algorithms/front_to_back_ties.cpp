// peeling/algorithms/front_to_back_ties.cpp - a peel from the front that loses no fragment of equal depth: an extra
// pass counts the fragments at the depth being peeled, and two of them are taken per iteration. Vasilakis and Fudos
// 2013, "Depth-Fighting Aware Methods for Multifragment Rendering", F2B-2P; peeling/reference/algorithms.md 25.
//
// Needs      float MAX blending, a separate blend equation for alpha, three render targets. GeForce8 has all of these.
// Passes     1 + 2 max(1, K), where K is the greatest sum over a pixel's depths of ceil(fragments there / 2). Of equal
//            depths the first submitted is in front.
// Invariant  before an iteration, `nearest` = the depth being peeled, negated; `ties` = what is left at that depth;
//            `accumulated` = everything in front of it and the fragments taken from its beginning; `group` = those
//            taken from its end.
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/region_programs.h"
#include "peeling/programs/tie_groups.h"

namespace strata::peeling::listing::front_to_back_ties {

using namespace pipeline;

namespace {

constexpr ClearValue none{.color = {-1, -1, -1, -1}};  // depth 1, at which nothing is visible

struct TiesPeel {
    Region& region;
    Target nearest = region.make(Format::r32f), next_nearest = region.make(Format::r32f);
    Target ties = region.make(Format::rgba32f), next_ties = region.make(Format::rgba32f);
    Target first = region.make_color(), last = region.make_color();
    Target group = region.make_color(), next_group = region.make_color();
    Target accumulated = region.make_color();
    GroupTrace trace{region, Side::front};
};

// Selects the fragments at the depth being peeled and the next one behind it; without `nearest` those at the first
// depth. Others write what MAX and the count ignore.
FragmentSelection group_at(const TiesPeel& p, Target nearest) {
    return {.keeps = KeptFragments::group,
            .outside = Outside::writes_alike,
            .far = {KeyBound::beyond(p.region.opaque_depth())},
            .range = nearest};
}

void find_nearest(const TiesPeel& p) {
    p.region.clear(p.nearest, none);
    PassState state;
    state.color[0] = p.nearest;
    state.blend[0] = blend_mode::max;
    state.reads[0] = p.region.opaque_depth();
    state.needs = depth_only;
    state.selection = group_at(p, {});
    static_cast<void>(p.region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.color[0][0][i] = is_visible(in, i, loads.depth(0)) ? 0.0f - in.shader_z[i] : -1.0f;
    }));
}

// Counts the fragments that are left at the depth, and finds the least and the greatest number of their triangles.
void count_ties(const TiesPeel& p) {
    p.region.clear(p.next_ties, no_ties);
    PassState state;
    state.color[0] = p.next_ties;
    state.blend[0] = extremes_and_count;
    state.reads = {p.nearest, p.ties, p.region.opaque_depth()};
    state.needs = depth_only;
    state.selection = group_at(p, p.nearest);
    static_cast<void>(p.region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const bool is_here = is_visible(in, i, loads.depth(2)) && in.shader_z[i] == 0.0f - loads.color(0)[0][i];
            const float number = number_of(in, i);
            write_number(out.color[0], i, is_here && is_left(loads.color(1), i, number), number);
        }
    }));
}

// Draws the two fragments into a layer each, and finds the next depth: the same one if more than these are left.
void take_two(TiesPeel& p) {
    p.region.clear(p.next_nearest, none);
    for (const Target layer : {p.first, p.last}) p.region.clear(layer, {});
    PassState state;
    state.color = {p.next_nearest, p.first, p.last};
    state.blend = {blend_mode::max, blend_mode::max, blend_mode::max};
    state.reads = {p.nearest, p.next_ties, p.region.opaque_depth()};
    state.needs.code = false;
    state.selection = group_at(p, p.nearest);
    static_cast<void>(p.region.draw(state, [&p](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes& ties = loads.color(1);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float z = in.shader_z[i], near = 0.0f - loads.color(0)[0][i], number = number_of(in, i);
            const bool has_surface_behind = is_visible(in, i, loads.depth(2)),
                       is_here = has_surface_behind && z == near;
            const bool is_next = has_surface_behind && (z > near || (is_here && is_open(ties, i)));
            out.color[0][0][i] = is_next ? 0.0f - z : -1.0f;
            const bool takes_first = is_here && is_first(ties, i, number),
                       takes_last = is_here && is_last(ties, i, number);
            write_chosen(in, i, takes_first, out.color[1]);
            write_chosen(in, i, takes_last, out.color[2]);
            if (takes_first || takes_last) p.trace.add(in, out, i, takes_last);
        }
    }));
}

// Blends the first fragment, and the rest of its group where the group has ended. Counts the pixels with a next depth.
DrawCounts composite(TiesPeel& p) {
    set_aside(p.region, p.last, InFront::layer, p.group, p.ties, p.next_group);
    blend_layer(p.region, p.first, blend_mode::under, p.accumulated);
    std::swap(p.nearest, p.next_nearest), std::swap(p.ties, p.next_ties), std::swap(p.group, p.next_group);
    p.trace.blend(p.ties, Blended::ended_groups);
    return blend_group(p.region, p.group, p.ties, Blended::ended_groups, p.nearest, blend_mode::under, p.accumulated);
}

void run(Region& region) {
    TiesPeel p{region};
    region.set_name(p.nearest, "nearest"), region.set_name(p.next_nearest, "nearest");
    region.set_name(p.accumulated, "accumulated");
    name_group_targets(region, {p.ties, p.next_ties}, {p.first, p.last}, {p.group, p.next_group});
    region.clear(p.ties, no_ties);
    region.clear(p.accumulated, {.color = {0, 0, 0, 1}});
    find_nearest(p);
    while (!region.limit_reached(2)) {
        region.begin_iteration();
        count_ties(p);
        take_two(p);
        if (!region.any(composite(p).tallied, Idle::yes)) break;
    }
    blend_open_groups(region, p.trace, p.group, p.ties, blend_mode::under, p.accumulated);
    publish_over_background(region, p.accumulated, region.opaque_color());
}

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "front_to_back_ties",
                      .listed = 250,
                      .paper = "Vasilakis and Fudos 2013",
                      .section = "F2B-2P",
                      .summary = "one depth a pass and a pass that counts its fragments: all of them are composited",
                      .pass_formula = "1 + 2 max(1, K), K pairs at one depth",
                      .ties = TiePolicy::first,
                      .key = DepthKey::shader_z,
                      .exact = true,
                      .compares_own_codes = true,
                      .run = run,
                      .features = {float_targets, fragment_programs, separate_alpha_blend},
                      .render_targets = 3}};
}

}  // namespace strata::peeling::listing::front_to_back_ties
