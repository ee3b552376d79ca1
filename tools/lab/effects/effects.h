// tools/lab/effects/effects.h - strata bench --per-effect: which effects a run simulates, who asks for them, what they
// cost.
#pragma once
#include "tools/lab/bench/bench_jobs.h"

namespace strata::tools {

// Prints a table, or with `json` one document, of the scene's algorithms, each timed `repeat` times; 2 if all are
// refused.
[[nodiscard]] int show_effects(const BenchScene& scene, int repeat, bool json);

}  // namespace strata::tools
