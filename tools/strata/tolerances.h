// tools/strata/tolerances.h - the options that `compare` and `diagnose` share: how a candidate's file is laid out, what
// is forgiven.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>

#include "tools/oracle/compare.h"

namespace strata::tools {

void add_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout);  // --layout
// Names of --tolerance that are no kinds are those of targets: throws CLI::ValidationError for one that is none of
// these.
void check_targets(const oracle::Tolerances& tolerances, const std::vector<std::string>& targets);
// --candidate-alpha; and what it says of a picture's colours.
void add_alpha_option(CLI::App& app, std::optional<oracle::AlphaForm>& form);
void state_alpha(oracle::Picture& picture, const std::optional<oracle::AlphaForm>& form);
void add_tolerance_option(CLI::App& app, oracle::Tolerances& tolerances);  // --tolerance
void add_channels_option(CLI::App& app, oracle::Tolerances& tolerances);   // --channels

}  // namespace strata::tools
