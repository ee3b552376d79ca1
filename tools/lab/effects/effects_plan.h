// tools/lab/effects/effects_plan.h - the plan of a run: every effect of this machine, simulated or left out, who
// calls for it, and how many fragments go through it.
//
// Rule     The passes are those that the pipeline decided (pipeline/frame/effects.h), logged in a small literal run
//          of the same scene and view; their number and their fragments are those of the whole run in literal
//          execution.
// Tests    tests/tools/effects_test.cpp
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
    std::string why;                                      // what needs it, or that nothing does
    std::uint64_t passes = 0;                             // geometry passes that simulate it
    std::uint64_t fragments = 0;                          // that go through it in these, in literal execution
    pipeline::Effect effect_id = pipeline::Effect::none;  // of those whose cost can be measured
    std::optional<double> seconds;  // what it costs in the whole run; where it is left out, what that saved
    bool is_noise = false;          // `seconds` is less than the runs vary by
};

struct EffectsPlan {
    std::vector<EffectRow> rows;
    pipeline::TileCensus tiles;
    std::uint64_t geometry_passes = 0;  // of the rows' own sum; equal to the run's
    pipeline::PreparedDraw drawn;       // the transparent list
};

// `run` is the whole run that the numbers are for. The algorithm must not be refused.
[[nodiscard]] EffectsPlan plan_effects(const BenchJob& job, const BenchRun& run);

}  // namespace strata::tools
