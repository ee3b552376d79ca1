// tools/lab/effects/effects_costs.h - how long the effects of a plan take.
//
// Rule     Every kind of run is repeated, the kinds taking turns on warm caches; its time is the median. A stage costs
//          the difference that one more stage of its kind makes, with a state that changes nothing; that measures
//          stages which no state needs, too (pipeline/frame/effects.h). A value that is left out is measured in the
//          same way. A value that passes do call for costs the difference between two walks over all fragments, one
//          with it and one without, times the number of those passes. Effects are timed without replay, since
//          Effects::all does not use it.
// Tests    tests/tools/effects_test.cpp
#pragma once
#include "tools/lab/bench/spread.h"

namespace strata::tools {

struct BenchJob;
struct EffectsPlan;

// Seconds of whole runs.
struct EffectTimes {
    Spread needed, all, as_asked;
};

// Fills EffectRow::seconds where it can be measured, and whether it is more than the noise of the runs. Costs are
// differences of measured times; one below 0 is 0.
[[nodiscard]] EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan);

}  // namespace strata::tools
