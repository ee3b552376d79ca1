// tools/strata/options/algorithm_options.h - --weight ... --stochastic-seed: what single algorithms let a caller
// choose.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "peeling/programs/algorithm_options.h"

namespace strata::tools {

void add_algorithm_options(CLI::App& app, peeling::AlgorithmOptions& options);

// Those that differ from their defaults, each with its value, in the order of reports.md 7.
[[nodiscard]] std::vector<std::string> words_of(const peeling::AlgorithmOptions& options);

}  // namespace strata::tools
