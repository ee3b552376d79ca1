// peeling/programs/fixed_passes/node_depths.h - the depths of the k nodes that multi_layer and adaptive keep per pixel,
// in one or two rgba32f targets.
//
// Rule     The depth of node e is in channel e mod 4 of target e / 4, as the float of depth_float.h. An empty node has
//          the depth no_node, which is behind every depth.
// Tests    tests/peeling/algorithms/multi_layer_test.cpp
#pragma once
#include <array>
#include <string>

#include "peeling/programs/depth_float.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

struct NodeDepths {
    int nodes = 0;
    std::array<pipeline::Target, 2> targets{};
    [[nodiscard]] std::size_t target_count() const noexcept { return static_cast<std::size_t>(nodes + 3) / 4; }
};

[[nodiscard]] inline NodeDepths make_node_depths(pipeline::Region& region, const ListElements& lists, int nodes) {
    NodeDepths depths{nodes, {}};
    for (std::size_t t = 0; t < depths.target_count(); ++t) {
        depths.targets[t] = lists.make(pipeline::Format::rgba32f);
        region.set_name(depths.targets[t], "depths");
        region.clear(depths.targets[t], {.color = pipeline::Rgba(no_node)});
    }
    return depths;
}

// The state of a pass over the visible fragments whose program reads and writes the nodes of its pixel in submission
// order. The depths are the first colour targets and the first loads.
[[nodiscard]] inline pipeline::PassState node_state(const pipeline::Region& region, const NodeDepths& depths) {
    pipeline::PassState state;
    state.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.needs = code_with_color;
    state.ordered_rmw = true;
    for (std::size_t t = 0; t < depths.target_count(); ++t) state.color[t] = state.reads[t] = depths.targets[t];
    return state;
}

[[nodiscard]] inline float depth_of_node(const pipeline::Loads& loads, std::size_t node, std::size_t lane) noexcept {
    return loads.color(static_cast<int>(node / 4))[node % 4][lane];
}

}  // namespace strata::peeling
