// tools/strata/effects/effects_costs.h - how long the effects of a plan take.
//
// Rule     Every kind of run is repeated, the kinds taking turns on warm caches; its time is the median. A stage costs
//          the difference that one more stage of its kind makes, with a state that changes nothing; that measures
//          stages which nobody calls for, too (pipeline/frame/effects.h). A value that is left out is measured in the
//          same way. A value that passes do call for costs the difference between two walks over all fragments, one
//          with it and one without, times the number of those passes. Effects are timed without replay, since
//          Effects::all does not use it.
// Tests    tests/tools/effects_test.cpp
#pragma once
namespace strata::tools {

struct BenchJob;
struct EffectsPlan;

// Median seconds of whole runs.
struct EffectTimes {
    double needed = 0, all = 0, as_asked = 0;
};

// Fills EffectRow::seconds where it can be measured. Costs are differences of measured times: one below 0 is noise,
// and 0.
[[nodiscard]] EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan);

}  // namespace strata::tools
