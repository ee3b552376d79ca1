// tools/strata/compare/tolerances.h - the options that `compare` and `diagnose` share: the layout of a raw candidate
// file, and the tolerated differences.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>

#include "tools/oracle/compare/compare.h"

namespace strata::tools {

void add_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout);            // --layout
void add_candidate_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout);  // --candidate-layout
// Names in --tolerance that are not kinds of differences must be names of targets: throws CLI::ValidationError for any
// other name.
void check_targets(const oracle::Tolerances& tolerances, const std::vector<std::string>& targets);
// Adds --candidate-alpha.
void add_alpha_option(CLI::App& app, std::optional<oracle::AlphaForm>& form);
void state_alpha(oracle::Picture& picture, const std::optional<oracle::AlphaForm>& form);
void add_tolerance_option(CLI::App& app, oracle::Tolerances& tolerances);  // --tolerance
void add_channels_option(CLI::App& app, oracle::Tolerances& tolerances);   // --channels

}  // namespace strata::tools
