// tools/strata/options/algorithm_options.h - declares the options of single algorithms, --weight to --stochastic-seed.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "peeling/programs/algorithm_options.h"

namespace strata::tools {

void add_algorithm_options(CLI::App& app, peeling::AlgorithmOptions& options);

// The options that differ from their defaults, each followed by its value, in the order of scenes/reference/reports.md
// 7.
[[nodiscard]] std::vector<std::string> words_of(const peeling::AlgorithmOptions& options);

}  // namespace strata::tools
