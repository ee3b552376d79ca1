// tools/lab/effects/effects.h - strata bench --per-effect: the effects that a run simulates, the state that needs them,
// and their cost.
#pragma once
#include "tools/lab/bench/bench_jobs.h"

namespace strata::tools {

// Prints a table, or with `json` one document, of the scene's algorithms, each timed `repeat` times; returns 2 if all
// are refused.
[[nodiscard]] int show_effects(const BenchScene& scene, int repeat, bool json);

}  // namespace strata::tools
