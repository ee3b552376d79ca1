// peeling/algorithms/hybrid.cpp - unordered meshes peeled, ordered ones composited between the peels. Carr, Mech and
// Miller 2008, Algorithm 1; peeling/reference/algorithms.md 9.
//
// Needs      a fragment program with discard, separate alpha blending; an ordered set whose submission order is front
//            to back at every pixel.
// Passes     3 N + 2 in N + 1 iterations for N layers of the unordered set alone. At equal depth the ordered set is in
//            front.
// Invariant  before iteration i everything up to the unordered layer i-2 is composited, and so are the ordered
//            fragments up to i-1.
#include "peeling/algorithms/entry.h"
#include "peeling/loops/peel_sets.h"

namespace strata::peeling::listing::hybrid {

// The list has two parts: the ordered set, then the unordered one (Algorithm::order).
void run(pipeline::Region& region) {
    const auto& parts = region.frame().transparent->parts;
    peel_sets(region, {.ordered = parts.at(0).primitives, .unordered = parts.at(1).primitives});
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "hybrid",
                      .listed = 95,
                      .paper = "Carr, Mech and Miller 2008",
                      .section = "Algorithm 1",
                      .summary = "unordered meshes peeled, an ordered set (--sorted) composited between the peels",
                      .pass_formula = "3 U + 2, U layers unordered",
                      .ties = TiePolicy::first,
                      .exact = true,
                      .order = ListOrder::sets,
                      .compares_own_codes = true,
                      .has_published_form = true,
                      .run = run,
                      .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::hybrid
