// peeling/loops/peel_sets.h - the loop of Algorithm 1 for hybrid and layer_peel: unordered geometry is peeled layer by
// layer, and ordered geometry is composited between two peels. Carr, Mech and Miller 2008, section 3;
// peeling/reference/algorithms.md 9, errata E23 and E24.
//
// Rule     An iteration finds the nearest unordered layer strictly behind the last one (`peeled`), composites the
//          ordered fragments up to it, then composites the layer, by equality of depth. As published, ordered fragments
//          at the layer's own depth, and all fragments at depth 0, are lost, and unordered ones at the opaque surface
//          are composited in every iteration.
// Tests    tests/peeling/sequences/sequences_test.cpp, published_test.cpp
#pragma once
#include <optional>

#include "pipeline/region/region.h"

namespace strata::peeling {

// Empty ranges: one unordered set, which is the whole list.
struct PeelSets {
    std::optional<pipeline::PrimitiveRange> ordered, unordered;
};

// Composites both sets over the region and publishes the result.
void peel_sets(pipeline::Region& region, const PeelSets& sets);

}  // namespace strata::peeling
