// peeling/programs/fixed_passes/visibility_curve.h - what a pixel lets through down to each depth, as a step function
// of few steps.
//
// Rule     Steps are sorted by depth; one more than fits removes the step whose area is least. Binary32, each operation
//          rounded.
// Source   algorithms.md 19.2; Salvi et al. 2011.
// Tests    tests/peeling/algorithms/multi_layer_test.cpp
#pragma once
#include <array>

#include "peeling/programs/algorithm_options.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/region_programs.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

// One node more than there are: the curve before it is compressed.
struct VisibilityCurve {
    std::array<float, most_nodes + 1> depth{}, through{};
};

// Removes the node whose area is least: the step before it takes its transmittance.
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

// A new step goes before all nodes that are not nearer, and dims whatever is behind it.
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
