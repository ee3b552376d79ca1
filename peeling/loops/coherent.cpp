// peeling/loops/coherent.cpp - passes 3 to 6 and the loop of coherent layer peeling (coherent.h).
#include "peeling/loops/coherent.h"

#include "peeling/programs/region_programs.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

constexpr int later_passes = 4;  // passes 3 to 6

// Both faces have the same test: the stencil counts fragments of either facing. The reference is the left operand of
// `func`.
StencilTest stencil_test(CompareFunc func, std::uint8_t ref, StencilOp fail, StencilOp depth_fail, StencilOp pass) {
    return {.enabled = true,
            .front = {.func = func, .ref = ref, .fail = fail, .depth_fail = depth_fail, .pass = pass},
            .back = {}};
}

// The range of passes 3 and 4: from the nearest fragment, inclusive (E17), to `previous`, exclusive.
void keep_after_nearest(const FragmentBatch& in, const Loads& loads, Outputs& out) noexcept {
    keep_from(in, loads.depth(0), out);
    keep_before(in, loads.depth(1), out);
    keep_before(in, loads.depth(2), out);
}

// The same range as a selection.
FragmentSelection selects_after_nearest(const CoherentPeel& peel) {
    return {.keeps = KeptFragments::interval,
            .near = KeyBound::at(peel.nearest),
            .far = {KeyBound::beyond(peel.previous), KeyBound::beyond(peel.region.opaque_depth())}};
}

// For the report of a listing that does not terminate: the pixels where the last iteration composited a fragment.
void note_composited(CoherentPeel& peel, const FragmentBatch& in, const Outputs& out) {
    if (!peel.published) return;
    for (std::size_t i = 0; i < lanes(in); ++i)
        if (out.alive[i] != 0) peel.composited.add(in.pixel[i]);
}

}  // namespace

// Pass 3 counts, in the stencil, the fragments that are submitted in depth order. The first fragment out of order
// inverts the count. The stencil test (128 > count) then fails for every later fragment, as it also does once the count
// reaches 128.
void count_run(CoherentPeel& peel) {
    Region& region = peel.region;
    region.clear(peel.last_in_order, {.depth = 0.0f});
    region.clear(peel.stencil, {.stencil = 0});
    PassState state = find_state(peel.last_in_order, CompareFunc::greater);
    state.stencil = stencil_test(CompareFunc::greater, 128, StencilOp::keep, StencilOp::invert, StencilOp::incr);
    state.stencil_target = peel.stencil;
    state.reads = {peel.nearest, peel.previous, region.opaque_depth()};
    state.selection = selects_after_nearest(peel);
    static_cast<void>(region.draw(state, keep_after_nearest));
    const std::uint32_t* const stencil = region.storage(peel.stencil).stencil(0);
    for (std::uint32_t pixel = 0; pixel < region.elements(); ++pixel)
        if (stencil[pixel] == 128) peel.full_counts.add(pixel);
}

// Pass 4: the nearest fragment behind those that pass 3 counted. Failing the stencil test counts up to 255.
void find_breaker(CoherentPeel& peel) {
    Region& region = peel.region;
    region.clear(peel.breaker, {.depth = 1.0f});  // the stencil is not cleared: it holds pass 3's count
    PassState state = find_state(peel.breaker, CompareFunc::less);
    state.stencil = stencil_test(CompareFunc::equal, 255, StencilOp::incr, StencilOp::keep, StencilOp::keep);
    state.stencil_target = peel.stencil;
    state.reads = {peel.nearest, peel.previous, region.opaque_depth()};
    state.selection = selects_after_nearest(peel);
    static_cast<void>(region.draw(state, keep_after_nearest));
}

// The end of the run, which is D(sc) of the next iteration.
void find_reached(CoherentPeel& peel) {
    PassState state = find_state(peel.reached, CompareFunc::always);
    state.reads = {peel.previous, peel.breaker, peel.region.opaque_depth()};
    static_cast<void>(peel.region.full_screen(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.replaces_depth = true;
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.depth[i] = std::min({loads.depth(0)[i], loads.depth(1)[i], loads.depth(2)[i]});
    }));
    peel.from_the_start = false;
}

// Pass 5 composites the run without its end.
DrawCounts composite_run(CoherentPeel& peel) {
    PassState state = composite_state(peel.accumulated);
    state.reads = {peel.nearest, peel.reached};
    state.selection = {
        .keeps = KeptFragments::interval, .near = KeyBound::at(peel.nearest), .far = {KeyBound::beyond(peel.reached)}};
    return peel.region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_from(in, loads.depth(0), out);
        keep_before(in, loads.depth(1), out);
        composite_under(in, out);
        note_composited(peel, in, out);
    });
}

// Pass 6 composites the fragments exactly at the end, unless that is the opaque surface. As published they are
// composited even then, and again in every iteration (E22).
DrawCounts composite_end(CoherentPeel& peel) {
    PassState state = composite_state(peel.accumulated);
    state.reads = {peel.reached, peel.region.opaque_depth()};
    state.selection = {
        .keeps = KeptFragments::interval, .near = KeyBound::at(peel.reached), .far = {KeyBound::at(peel.reached)}};
    peel.ties.start();
    return peel.region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_at(in, loads.depth(0), out);
        if (!peel.published) keep_before(in, loads.depth(1), out);
        composite_under(in, out);
        peel.ties.add(in, out);
        note_composited(peel, in, out);
    });
}

namespace {

// Passes 2 to 6 (peeling/reference/algorithms.md 10.1). The count is the paper's query, over both passes that
// composite.
Count finish_iteration(CoherentPeel& peel, const FirstPasses& first) {
    peel.composited.clear();
    first.find_previous(peel);
    count_run(peel);
    find_breaker(peel);
    find_reached(peel);
    const DrawCounts run = composite_run(peel);
    return run.passed + composite_end(peel).passed;
}

// With the errata resolved, pass 1 of the next iteration already shows that nothing is left.
void peel_until_nothing_is_left(CoherentPeel& peel, const FirstPasses& first) {
    Region& region = peel.region;
    if (region.limit_reached()) return;
    DrawCounts found = first.find_nearest(peel);
    while (region.any(found.passed, Idle::yes) && !region.limit_reached(first.geometry_passes + later_passes)) {
        region.begin_iteration();
        static_cast<void>(finish_iteration(peel, first));
        found = first.find_nearest(peel);
    }
}

// Counts the pixels where `reached` has moved beyond `farthest`; not a pass of the emulated device. If there are none,
// a listing that continues would composite the same fragments forever.
Count progress(CoherentPeel& peel, Target farthest) {
    PassState state = find_state(farthest, CompareFunc::greater);
    state.reads[0] = peel.reached;
    return peel.region
        .full_screen(state,
                     [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                         out.replaces_depth = true;
                         std::copy_n(loads.depth(0).begin(), lanes(in), out.depth.begin());
                     })
        .passed;
}

// The paper's exit: queries during compositing.
void peel_until_nothing_is_composited(CoherentPeel& peel, const FirstPasses& first) {
    Region& region = peel.region;
    Target farthest;
    if (peel.published) farthest = region.make_depth();
    while (!region.limit_reached(first.geometry_passes + later_passes)) {
        region.begin_iteration();
        static_cast<void>(first.find_nearest(peel));
        const Count composited = finish_iteration(peel, first);
        if (!region.any(composited, peel.published ? Idle::no : Idle::yes)) break;
        if (!peel.published || region.any(progress(peel, farthest), Idle::no)) continue;
        peel.composited.report(region, Fault::endless, "the same fragments in every further iteration: stopped (E22)");
        break;
    }
}

}  // namespace

void peel_coherently(Region& region, const FirstPasses& first) {
    CoherentPeel peel{region};
    const bool paper = peel.published || region.frame().termination.rule == TerminationRule::paper;
    (paper ? peel_until_nothing_is_composited : peel_until_nothing_is_left)(peel, first);
    peel.full_counts.report(region, Fault::count_limit, "pass 3 counts to 128: longer runs take more iterations (E20)");
    peel.ties.report(region);
    publish_over_background(region, peel.accumulated, region.opaque_color());
}

}  // namespace strata::peeling
