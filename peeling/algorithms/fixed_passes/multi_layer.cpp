// peeling/algorithms/fixed_passes/multi_layer.cpp - keeps k layers per pixel, sorted by depth, during one pass; a
// fragment that does not fit makes the two farthest merge. Salvi and Vaidyanathan 2014, "Multi-Layer Alpha Blending";
// peeling/reference/algorithms.md 19.
//
// Needs      STRATA_ordered_rmw (rasterizer ordered views, fragment shader interlock), a float target for depths.
// Passes     1. Exact if no pixel has more than k visible fragments, or if all are submitted front to back. Of equal
//            depths the last submitted is in front.
// Invariant  a pixel's nodes are sorted by depth; composited UNDER one another they give the fragments drawn so far,
//            except for the order of merged ones.
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/fixed_passes/node_depths.h"
#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "peeling/programs/under.h"

namespace strata::peeling::listing::multi_layer {

using namespace pipeline;

namespace {

constexpr int most_layers = 6;             // because eight targets include two of depths
constexpr int most_layers_with_masks = 4;  // because depths and masks have one target each

struct Node {
    float depth = no_node;
    Rgba layer{0, 0, 0, 1};  // premultiplied; alpha is the transmittance
    std::uint8_t samples = 0;
};

struct NodeTargets {
    ListElements lists;
    NodeDepths depths;
    std::array<Target, most_nodes> layers{};
    Target masks{};  // of lists of pixels: a node's samples in a channel
};

NodeTargets make_nodes(Region& region, const AlgorithmOptions& options) {
    const ListElements lists{region, options.list_granularity};
    NodeTargets t{lists, make_node_depths(region, lists, options.nodes), {}};
    if (lists.are_pixels()) {
        t.masks = lists.make(Format::rgba32f);
        region.set_name(t.masks, "masks");
    }
    for (std::size_t e = 0; e < static_cast<std::size_t>(options.nodes); ++e) {
        t.layers[e] = lists.make(region.frame().color_format);
        region.set_name(t.layers[e], "layer");
        region.clear(t.layers[e], {.color = {0, 0, 0, 1}});
    }
    return t;
}

// `front` over `back`, as one layer.
Rgba merged(const Rgba& front, const Rgba& back) noexcept {
    Rgba both;
    for (Rgba::length_type c = 0; c < 3; ++c) both[c] = front[c] + back[c] * front[3];
    both[3] = front[3] * back[3];
    return both;
}

// Inserts a node in front of all that are not nearer. The node that no longer fits is merged into the last one.
void insert(std::array<Node, most_nodes>& nodes, std::size_t count, Node node) noexcept {
    for (std::size_t e = 0; e < count; ++e)
        if (node.depth <= nodes[e].depth) std::swap(node, nodes[e]);
    if (node.depth == no_node) return;
    nodes[count - 1].layer = merged(nodes[count - 1].layer, node.layer);
    nodes[count - 1].samples |= node.samples;
}

// The geometry pass: the program reads and writes all nodes of its pixel, in submission order.
void insert_all(Region& region, const NodeTargets& t) {
    const auto count = static_cast<std::size_t>(t.depths.nodes), first = t.depths.target_count();
    const std::size_t masks = first + count;
    PassState state = node_state(region, t.depths);
    state.once_a_pixel = t.lists.are_pixels();
    for (std::size_t e = 0; e < count; ++e) state.color[first + e] = state.reads[first + e] = t.layers[e];
    if (t.masks.exists()) state.color[masks] = state.reads[masks] = t.masks;
    const DepthFormat format = region.frame().key_request().format;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            std::array<Node, most_nodes> nodes;
            for (std::size_t e = 0; e < count; ++e) {
                const ColorLanes& layer = loads.color(static_cast<int>(first + e));
                nodes[e] = {depth_of_node(loads, e, i), {layer[0][i], layer[1][i], layer[2][i], layer[3][i]}};
                if (t.masks.exists())
                    nodes[e].samples = static_cast<std::uint8_t>(loads.color(static_cast<int>(masks))[e][i]);
            }
            const float a = in.color[3][i];
            insert(nodes, count,
                   {depth_as_float(in.code[i], format),
                    {in.color[0][i] * a, in.color[1][i] * a, in.color[2][i] * a, 1.0f - a},
                    t.lists.samples_of(out, i)});
            for (std::size_t e = 0; e < 4 * first; ++e) out.color[e / 4][e % 4][i] = nodes[e].depth;
            for (std::size_t e = 0; e < count; ++e)
                for (std::size_t c = 0; c < 4; ++c) out.color[first + e][c][i] = nodes[e].layer[static_cast<int>(c)];
            for (std::size_t e = 0; t.masks.exists() && e < 4; ++e)
                out.color[masks][e][i] = static_cast<float>(e < count ? nodes[e].samples : 0);
        }
    }));
}

// The full-screen pass: composites all layers from the nearest on over the background.
void composite(Region& region, const NodeTargets& t, Target result) {
    PassState state;
    state.color[0] = result;
    state.reads[0] = region.opaque_color();
    for (std::size_t e = 0; e < static_cast<std::size_t>(t.depths.nodes); ++e) state.reads[1 + e] = t.layers[e];
    const int masks = 1 + t.depths.nodes;
    if (t.masks.exists()) state.reads[static_cast<std::size_t>(masks)] = t.masks;
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes& background = loads.color(0);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            Rgba all{0, 0, 0, 1};
            for (int e = 1; e <= t.depths.nodes; ++e) {
                const ColorLanes& layer = loads.color(e);
                const auto node = static_cast<std::size_t>(e - 1);
                if (t.masks.exists() &&
                    (static_cast<std::uint8_t>(loads.color(masks)[node][i]) & t.lists.bit_of(in.pixel[i])) == 0)
                    continue;
                all = merged(all, {layer[0][i], layer[1][i], layer[2][i], layer[3][i]});
            }
            for (std::size_t c = 0; c < 3; ++c)
                out.color[0][c][i] = scalar::composited(all[static_cast<int>(c)], all[3], background[c][i]);
            out.color[0][3][i] = scalar::alpha_over(all[3], background[3][i]);
        }
    }));
}

void run(Region& region, const ListingInputs& inputs) {
    if (inputs.options.nodes > most_layers)
        throw Refused(region.profile(),
                      {"targets for more than 6 layers and their depths in one pass", "", "use --nodes 6"});
    const NodeTargets nodes = make_nodes(region, inputs.options);
    if (nodes.lists.are_pixels() && inputs.options.nodes > most_layers_with_masks)
        throw Refused(region.profile(),
                      {"targets for more than 4 layers, their depths and masks in one pass", "", "use --nodes 4"});
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    region.begin_iteration();
    insert_all(region, nodes);
    composite(region, nodes, result);
    region.publish(result);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "multi_layer",
                  .listed = 190,
                  .paper = "Salvi and Vaidyanathan 2014",
                  .section = "Multi-Layer Alpha Blending",
                  .summary = "the k nearest fragments so far, sorted as they come; one more merges the two farthest",
                  .pass_formula = "1",
                  .ties = TiePolicy::none,
                  .has_lists = true,
                  .compares_own_codes = true,
                  .geometry_passes = one_pass,
                  .run_with = run,
                  .features = {ordered_rmw, float_targets, fragment_programs},
                  .render_targets = 5}};
}

}  // namespace strata::peeling::listing::multi_layer
