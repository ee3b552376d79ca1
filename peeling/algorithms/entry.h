// peeling/algorithms/entry.h - what the entry of an algorithm is written with: each file of this folder ends with its
// own.
//
// Rule     peeling/algorithms/NAME.cpp is one listing: its head says paper, needs, passes and invariant; namespace
//          listing::NAME holds its passes and `std::vector<Algorithm> entries()`. The build finds the files; nothing
//          else lists them (listings.cpp.in).
// Tests    tests/peeling/refusals_test.cpp, passes_test.cpp
#pragma once
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/region/region.h"

namespace strata::peeling::listing {

using pipeline::DepthKey;
using enum pipeline::Feature;
using rasterizer::DepthPath;

// Geometry passes of a frame of N layers under exact termination: a single one; a pass a layer and one that finds
// nothing.
inline int one_pass(int) { return 1; }
inline int every_layer_and_one(int layers) { return layers + 1; }

}  // namespace strata::peeling::listing
