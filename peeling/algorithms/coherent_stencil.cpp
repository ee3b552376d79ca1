// peeling/algorithms/coherent_stencil.cpp - coherent layer peeling A: sequences of fragments in order, found by
// counting in the stencil buffer. Carr, Mech and Miller 2008, section 5; peeling/reference/algorithms.md 10.
//
// Needs      an 8-bit stencil buffer, a depth buffer that programs can read, separate alpha blending.
// Passes     6 per iteration, and 1 that finds nothing left; ascending ceil(n/128) iterations, descending ceil(n/2) for
//            n <= 255. Of equal depths all are composited, the first submitted in front.
// Invariant  before an iteration everything up to `reached` is composited. More than 255 prefix minima only cost
//            additional passes (E19).
#include "peeling/algorithms/entry.h"
#include "peeling/loops/coherent.h"

namespace strata::peeling::listing::coherent_stencil {

using namespace pipeline;

namespace {

PassState find_in_what_is_left(const CoherentPeel& peel, Target target, const StencilFace& face) {
    PassState state = find_state(target, CompareFunc::less);
    state.stencil = {.enabled = true, .front = face, .back = {}};
    state.stencil_target = peel.stencil;
    state.reads = {peel.reached, peel.region.opaque_depth()};
    state.selection = select_remaining(peel);
    return state;
}

// Pass 1 finds the nearest fragment; the stencil counts the updates of the depth, including the last.
DrawCounts find_nearest(CoherentPeel& peel) {
    peel.region.clear(peel.nearest, {.depth = 1.0f});
    peel.region.clear(peel.stencil, {.stencil = 0});
    const StencilFace face{.func = CompareFunc::always, .ref = 0, .pass = StencilOp::incr};
    return peel.region.draw(
        find_in_what_is_left(peel, peel.nearest, face),
        [&](const FragmentBatch& in, const Loads& loads, Outputs& out) { keep_remaining(peel, in, loads, out); });
}

// Pass 2 makes the same updates again and counts the stencil down to 1, so it stops one update before the nearest
// fragment.
void find_previous(CoherentPeel& peel) {
    peel.region.clear(peel.previous, {.depth = 1.0f});  // the stencil is not cleared (E26)
    const StencilFace face{.func = CompareFunc::less, .ref = 1, .pass = StencilOp::decr};
    static_cast<void>(peel.region.draw(
        find_in_what_is_left(peel, peel.previous, face),
        [&](const FragmentBatch& in, const Loads& loads, Outputs& out) { keep_remaining(peel, in, loads, out); }));
}

}  // namespace

const FirstPasses passes{.geometry_passes = 2, .find_nearest = find_nearest, .find_previous = find_previous};

void run(Region& region) { peel_coherently(region, passes); }

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "coherent_stencil",
                      .listed = 100,
                      .paper = "Carr, Mech and Miller 2008",
                      .section = "section 5 (A)",
                      .summary = "runs of fragments in order, found by counting in the stencil buffer",
                      .pass_formula = "1 + 6 an iteration",
                      .ties = TiePolicy::first,
                      .exact = true,
                      .compares_own_codes = true,
                      .has_published_form = true,
                      .run = run,
                      .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::coherent_stencil
