// peeling/algorithms/fixed_passes/adaptive.cpp - adaptive transparency: pass 1 approximates the transmittance of every
// pixel as a step function of depth with k nodes, pass 2 weights each fragment by the transmittance in front of it.
// Salvi, Montgomery and Lefohn 2011, "Adaptive Transparency", sections 3 and 4; peeling/reference/algorithms.md 19.2.
//
// Needs      STRATA_ordered_rmw (rasterizer ordered views, fragment shader interlock), float targets that blend.
// Passes     2. Exact if no pixel has more than k visible fragments and no two of them have equal depths. Of equal
//            depths none dims the others.
// Invariant  a pixel's nodes are sorted by depth. The transmittance of a node is that of all fragments up to its depth,
//            or less if nodes were removed; that of the last node is exact.
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/algorithm_options.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/fixed_passes/node_depths.h"
#include "peeling/programs/region_programs.h"
#include "peeling/programs/sums.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling::listing::adaptive {

using namespace pipeline;

namespace {

// A pixel's transmittance as a function of depth: a step function of at most k steps (algorithms.md 19.2). Steps
// (nodes) are sorted by depth; `through` is the transmittance from a node's depth on. Binary32, each operation rounded.
// There is room for one node more than a pixel may keep. Empty nodes have the depth no_node.
struct VisibilityCurve {
    std::array<float, most_nodes + 1> depth{}, through{};
};

// Removes the node whose removal changes the area under the curve least. From the depth of the node before it on, the
// curve then has the transmittance of the removed node. `count` is k.
void compress(VisibilityCurve& curve, std::size_t count, bool reversed) noexcept {
    const auto depth = [&](std::size_t e) { return depth_behind_near(reversed, curve.depth[e]); };
    std::size_t least = 1;
    float least_area = 0;
    for (std::size_t e = 1; e < count; ++e) {
        const float area = (depth(e) - depth(e - 1)) * (curve.through[e - 1] - curve.through[e]);
        if (e == 1 || area < least_area) least = e, least_area = area;
    }
    for (std::size_t e = least; e < count; ++e) curve.depth[e] = curve.depth[e + 1];
    for (std::size_t e = least - 1; e < count; ++e) curve.through[e] = curve.through[e + 1];
}

// Adds a node in front of all nodes that are not nearer, and multiplies the transmittance of the nodes behind it by
// `through`, which is 1 - alpha of the fragment. `depth` is its key.
void insert(VisibilityCurve& curve, std::size_t count, bool reversed, float depth, float through) noexcept {
    std::size_t place = 0;
    while (place < count && curve.depth[place] < depth) ++place;
    for (std::size_t e = count; e > place; --e) {
        curve.depth[e] = curve.depth[e - 1];
        curve.through[e] = curve.through[e - 1] * through;
    }
    curve.through[place] = (place > 0 ? curve.through[place - 1] : 1.0f) * through;
    curve.depth[place] = depth;
    if (curve.depth[count] != no_node) compress(curve, count, reversed);
}

struct CurveTargets {
    NodeDepths depths;
    std::array<Target, 2> through{};
};

// Pass 1 inserts the fragments into the curve of their pixel one after another.
void build(Region& region, const CurveTargets& t) {
    const auto count = static_cast<std::size_t>(t.depths.nodes), first = t.depths.target_count();
    PassState state = node_state(region, t.depths);
    for (std::size_t e = 0; e < first; ++e) state.color[first + e] = state.reads[first + e] = t.through[e];
    const DepthFormat format = region.frame().key_request().format;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            VisibilityCurve curve;
            curve.depth.fill(no_node);
            curve.through.fill(1.0f);
            for (std::size_t e = 0; e < count; ++e) {
                curve.depth[e] = depth_of_node(loads, e, i);
                curve.through[e] = depth_of_node(loads, 4 * first + e, i);
            }
            insert(curve, count, has_float_keys(region.frame()), depth_as_float(in.code[i], format),
                   1.0f - in.color[3][i]);
            for (std::size_t e = 0; e < 4 * first; ++e) {
                out.color[e / 4][e % 4][i] = e < count ? curve.depth[e] : no_node;
                out.color[first + e / 4][e % 4][i] = e < count ? curve.through[e] : 1.0f;
            }
        }
    }));
}

// Pass 2 sums (c a, a) of each fragment times the transmittance of the last node in front of it.
void accumulate(Region& region, const CurveTargets& t, Target sums) {
    const auto count = static_cast<std::size_t>(t.depths.nodes), first = t.depths.target_count();
    region.clear(sums, {});
    PassState state = node_state(region, t.depths);
    state.ordered_rmw = false;
    state.color = {sums};
    state.blend[0] = blend_mode::sum;
    for (std::size_t e = 0; e < first; ++e) state.reads[first + e] = t.through[e];
    const DepthFormat format = region.frame().key_request().format;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float depth = depth_as_float(in.code[i], format);
            float seen = in.color[3][i];
            std::size_t before = 0;
            while (before < count && depth_of_node(loads, before, i) < depth) ++before;
            if (before > 0) seen *= depth_of_node(loads, 4 * first + before - 1, i);
            for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * seen;
            out.color[0][3][i] = seen;
        }
    }));
}

void composite(Region& region, const CurveTargets& t, Target sums, Target result) {
    const auto last = static_cast<std::size_t>(t.depths.nodes - 1);
    PassState state;
    state.color[0] = result;
    state.reads = {t.through[last / 4], sums, region.opaque_color()};
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float through = loads.color(0)[last % 4][i];
            for (std::size_t c = 0; c < 3; ++c)
                out.color[0][c][i] = scalar::composited(loads.color(1)[c][i], through, loads.color(2)[c][i]);
            out.color[0][3][i] = scalar::alpha_over(through, loads.color(2)[3][i]);
        }
    }));
}

void run(Region& region, const ListingInputs& inputs) {
    CurveTargets t{make_node_depths(region, {region, ListGranularity::sample}, inputs.options.nodes), {}};
    for (std::size_t e = 0; e < t.depths.target_count(); ++e) {
        t.through[e] = region.make(Format::rgba32f);
        region.set_name(t.through[e], "transmittances");
        region.clear(t.through[e], {.color = {1, 1, 1, 1}});
    }
    const Target sums = make_sums(region);
    const Target result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(result, "result");
    region.begin_iteration();
    build(region, t);
    accumulate(region, t, sums);
    composite(region, t, sums, result);
    region.publish(result);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{
        .name = "adaptive",
        .listed = 191,
        .paper = "Salvi et al. 2011",
        .section = "Adaptive Transparency",
        .summary = "a pixel's visibility as a step function of k nodes, then colours by what they are seen through",
        .pass_formula = "2",
        .ties = TiePolicy::none,
        .compares_own_codes = true,
        .geometry_passes = two_passes,
        .run_with = run,
        .features = {ordered_rmw, float_targets, fragment_programs},
        .render_targets = 2}};
}

}  // namespace strata::peeling::listing::adaptive
