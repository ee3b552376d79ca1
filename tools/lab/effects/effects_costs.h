// tools/lab/effects/effects_costs.h - measures the time of the effects of a plan.
//
// Rule     Every kind of run is repeated, alternating with the others, on warm caches; its time is the median. The cost
//          of a stage is the difference that a second stage of its kind makes, with a state that changes nothing; this
//          also measures stages that no state needs (pipeline/frame/effects.h). An omitted value is measured in the
//          same way. The cost of a value that passes need is the difference between two traversals of all fragments,
//          one with it and one without, times the number of those passes. Effects are timed without replay, because
//          Effects::all does not use it.
// Tests    tests/tools/lab/effects/effects_test.cpp
#pragma once
#include "tools/lab/bench/spread.h"

namespace strata::tools {

struct BenchJob;
struct EffectsPlan;

// Seconds of complete runs.
struct EffectTimes {
    Spread needed, all, as_asked;
};

// Sets EffectRow::seconds if it can be measured, and whether it exceeds the noise of the runs. Costs are differences of
// measured times; negative ones become 0.
[[nodiscard]] EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan);

}  // namespace strata::tools
