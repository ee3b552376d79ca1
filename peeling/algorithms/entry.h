// peeling/algorithms/entry.h - functions for an algorithm's registry entry, with which each file of this folder ends.
//
// Rule     peeling/algorithms/NAME.cpp is one listing: its head states paper, needs, passes and invariant; namespace
//          listing::NAME holds its passes and `std::vector<Algorithm> entries()`. The build finds the files by itself
//          (listings.cpp.in); no list has to be edited.
// Tests    tests/peeling/passes_test.cpp, frame/refusals_test.cpp
#pragma once
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/region/region.h"

namespace strata::peeling::listing {

using pipeline::DepthKey;
using enum pipeline::Feature;
using rasterizer::DepthPath;

// Geometry passes for N layers under exact termination: one, two, or one per layer and one that finds nothing.
inline int one_pass(int) { return 1; }
inline int two_passes(int) { return 2; }
inline int every_layer_and_one(int layers) { return layers + 1; }

}  // namespace strata::peeling::listing
