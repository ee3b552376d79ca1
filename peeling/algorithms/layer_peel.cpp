// peeling/algorithms/layer_peel.cpp - the baseline that Carr, Mech and Miller measure themselves against: a layer is found, then composited.
// Everitt 2001; Carr, Mech and Miller 2008, Table 1 (two geometry passes an iteration); algorithms.md 9 with nothing ordered.
//
// Needs      a fragment program with discard, separate alpha blending, a depth buffer that it can read.
// Passes     2 N + 1 in N + 1 iterations: the last one finds nothing. Equal depths: all, the first arrival in front.
// Invariant  before iteration i the layers 0 .. i-1 are composited or, the last of them, found.
#include "peeling/algorithms/runs.h"
#include "peeling/loops/peel_sets.h"

namespace strata::peeling {

void layer_peel(pipeline::Region& region) { peel_sets(region, {}); }

}  // namespace strata::peeling
