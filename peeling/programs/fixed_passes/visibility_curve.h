// peeling/programs/fixed_passes/visibility_curve.h - the transmittance of a pixel as a function of depth, approximated
// by a step function of at most k steps, for the algorithm adaptive.
//
// Rule     Steps (nodes) are sorted by depth; `through` is the transmittance from a node's depth on. If there are k +
//          1, the node is removed whose removal changes the area under the curve least. Binary32, each operation
//          rounded.
// Source   peeling/reference/algorithms.md 19.2; Salvi et al. 2011.
// Tests    tests/peeling/algorithms/multi_layer_test.cpp
#pragma once
#include <array>

#include "peeling/programs/algorithm_options.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/region_programs.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

// A pixel's curve, with room for one node more than it may keep. Empty nodes have the depth no_node.
struct VisibilityCurve {
    std::array<float, most_nodes + 1> depth{}, through{};
};

// Removes the node whose removal changes the area under the curve least. From the depth of the node before it on, the
// curve then has the transmittance of the removed node. `count` is k.
inline void compress(VisibilityCurve& curve, std::size_t count, bool reversed) noexcept {
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
inline void insert(VisibilityCurve& curve, std::size_t count, bool reversed, float depth, float through) noexcept {
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

}  // namespace strict
}  // namespace strata::peeling
