// tools/strata/effects/effects_costs.h - how long the effects of a plan take.
//
// Rule     All runs warm, one after the other in turn, the median of each. A stage's cost is what the run takes longer when it
//          simulates the stage once more, or though nobody calls for it, with a state that changes nothing (pipeline/frame/effects.h);
//          likewise a value's that is left out. A value that is called for: walks over all fragments with and without it, times the
//          passes that have it. Replay is a saving of its own and does not join Effects::all: effects are timed without it.
// Tests    tests/tools/effects_test.cpp
#pragma once
namespace strata::tools {

struct BenchJob;
struct EffectsPlan;

// Median seconds of whole runs.
struct EffectTimes {
    double needed = 0, all = 0, as_asked = 0;
};

// Fills EffectRow::seconds where it can be measured. Costs are differences of measured times: one below 0 is noise, and 0.
[[nodiscard]] EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan);

}  // namespace strata::tools
