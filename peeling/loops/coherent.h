// peeling/loops/coherent.h - the parts of coherent layer peeling that its two formulations (coherent_stencil,
// coherent_blend) share. Carr, Mech and Miller 2008, sections 4 to 6; peeling/reference/algorithms.md 10 and 11, errata
// E15 to E23.
//
// Rule     An iteration composites, in submission order, a run: the fragments from the nearest one not yet composited
//          (`nearest`, the paper's D(sn)) on, as long as they are submitted in depth order. The run ends before the
//          nearest deeper fragment that was submitted before `nearest` (`previous`), and before the nearest fragment
//          that is submitted later out of order (`breaker`). The least of these two depths and the opaque depth is
//          `reached`; fragments exactly there are composited last, and the next iteration starts behind it.
// Tests    tests/peeling/sequences/sequences_test.cpp, algorithms/coherent_test.cpp, published_test.cpp
#pragma once
#include "peeling/programs/depth_range.h"

namespace strata::peeling {

// The targets and counts of one peel. Depth targets contain codes, and all comparisons below are of codes.
struct CoherentPeel {
    explicit CoherentPeel(pipeline::Region& r)
        : region{r},
          published{r.frame().formulation == pipeline::Formulation::published},
          full_counts{r},
          composited{r},
          ties{r} {
        region.set_name(accumulated, "accumulated");
        region.set_name(stencil, "stencil");
        region.set_name(nearest, "nearest");
        region.set_name(previous, "previous");
        region.set_name(breaker, "breaker");
        region.set_name(reached, "reached");
        region.set_name(last_in_order, "last_in_order");
        region.clear(accumulated, {.color = {0, 0, 0, 1}});
        region.clear(reached, {.depth = 0.0f});  // as published: strict comparisons lose depth 0 (E23)
        from_the_start = !published;
    }

    pipeline::Region& region;
    bool published;
    bool from_the_start = true;  // nothing is composited yet: no lower bound
    pipeline::Target accumulated = region.make_color();
    pipeline::Target stencil = region.make(pipeline::Format::s8);
    pipeline::Target nearest = region.make_depth(), previous = region.make_depth(), breaker = region.make_depth();
    pipeline::Target reached = region.make_depth();        // D(sc): everything up to this depth is composited
    pipeline::Target last_in_order = region.make_depth();  // the depth buffer of pass 3
    pipeline::Target shifted;  // coherent_blend: rgb = the depth before `nearest`, alpha = `nearest`
    PixelSet full_counts;      // pixels where pass 3 counted to 128
    PixelSet composited;       // in this iteration; only kept as published
    BoundTies ties;
};

// Passes 1 and 2, the only ones in which the formulations differ.
struct FirstPasses {
    int geometry_passes = 0;
    pipeline::DrawCounts (*find_nearest)(CoherentPeel&) = nullptr;  // its query says whether anything is left
    void (*find_previous)(CoherentPeel&) = nullptr;
};

// The range of passes 1 and 2: behind everything composited, before the opaque surface. Reads 0 and 1 are `reached` and
// the opaque depth.
inline void keep_remaining(const CoherentPeel& peel, const pipeline::FragmentBatch& in, const pipeline::Loads& loads,
                           pipeline::Outputs& out) noexcept {
    if (!peel.from_the_start) keep_behind(in, loads.depth(0), out);
    keep_before(in, loads.depth(1), out);
}

// The same range as a selection.
[[nodiscard]] inline pipeline::FragmentSelection select_remaining(const CoherentPeel& peel) {
    return {.keeps = pipeline::KeptFragments::interval,
            .near = pipeline::KeyBound::beyond(peel.from_the_start ? pipeline::Target{} : peel.reached),
            .far = {pipeline::KeyBound::beyond(peel.region.opaque_depth())}};
}

// The state of a pass that finds a depth in `target`, within the range that its program keeps.
[[nodiscard]] inline pipeline::PassState find_state(pipeline::Target target, pipeline::CompareFunc func) {
    pipeline::PassState state;
    state.depth = {.enabled = true, .func = func, .write = true};
    state.depth_target = target;
    state.needs = code_only;
    return state;
}

namespace listing::coherent_stencil {
extern const FirstPasses passes;
}
namespace listing::coherent_blend {
extern const FirstPasses passes;
}

// Passes 3 to 6, with `reached` computed between them; call them in this order, after the first passes.
void count_run(CoherentPeel& peel);
void find_breaker(CoherentPeel& peel);
void find_reached(CoherentPeel& peel);
pipeline::DrawCounts composite_run(CoherentPeel& peel);
pipeline::DrawCounts composite_end(CoherentPeel& peel);

// Peels until nothing is left and publishes the result.
void peel_coherently(pipeline::Region& region, const FirstPasses& first);

}  // namespace strata::peeling
