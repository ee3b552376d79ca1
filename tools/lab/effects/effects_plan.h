// tools/lab/effects/effects_plan.h - the plan of a run: every effect of the device, simulated or omitted, the state
// that needs it, and the number of its fragments.
//
// Rule     The passes are logged, with the pipeline's decisions (pipeline/frame/effects.h), in a small literal run
//          of the same scene and view; their number and their fragments are those of the whole run in literal
//          execution.
// Tests    tests/tools/lab/effects/effects_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/effects.h"
#include "tools/lab/bench/bench_jobs.h"

namespace strata::tools {

struct EffectRow {
    std::string effect;
    bool is_simulated = false;
    std::string why;                                      // the state that needs it, or that none does
    std::uint64_t passes = 0;                             // geometry passes that simulate it
    std::uint64_t fragments = 0;                          // fragments in these passes, in literal execution
    pipeline::Effect effect_id = pipeline::Effect::none;  // set if the cost can be measured
    std::optional<double> seconds;                        // the cost in the whole run, or the time saved by omitting it
    bool is_noise = false;                                // `seconds` is less than the variation of the runs
};

struct EffectsPlan {
    std::vector<EffectRow> rows;
    pipeline::TileCensus tiles;
    std::uint64_t geometry_passes = 0;  // summed over the rows; equal to the run's
    pipeline::PreparedDraw drawn;       // the transparent list
};

// `run` is the complete run to which the numbers apply. The algorithm must not be refused.
[[nodiscard]] EffectsPlan plan_effects(const BenchJob& job, const BenchRun& run);

}  // namespace strata::tools
