// peeling/algorithms/layer_peel.cpp - the baseline of Carr, Mech and Miller: one pass finds a layer, a second one
// composites it. Everitt 2001; Carr, Mech and Miller 2008, Table 1 (two geometry passes per iteration);
// peeling/reference/algorithms.md 9 without an ordered set.
//
// Needs      a fragment program with discard, separate alpha blending, a depth buffer that it can read.
// Passes     2 N + 1 in N + 1 iterations: the last one finds nothing. Of equal depths all are composited, the first
//            submitted in front.
// Invariant  before iteration i the layers 0 .. i-2 are composited and layer i-1 is found.
#include "peeling/algorithms/entry.h"
#include "peeling/loops/peel_sets.h"

namespace strata::peeling::listing::layer_peel {

void run(pipeline::Region& region) { peel_sets(region, {}); }

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "layer_peel",
                  .listed = 90,
                  .paper = "Carr, Mech and Miller 2008",
                  .section = "section 2, Table 1",
                  .summary = "a pass finds the nearest layer left, another composites it: the baseline of Carr's paper",
                  .pass_formula = "2 N + 1",
                  .ties = TiePolicy::first,
                  .exact = true,
                  .compares_own_codes = true,
                  .has_published_form = true,
                  .geometry_passes = [](int layers) { return 2 * layers + 1; },
                  .run = run,
                  .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::layer_peel
