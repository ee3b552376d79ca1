// tools/strata/tolerances.h - the options that `compare` and `diagnose` share: how a candidate's file is laid out, what is forgiven.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>

#include "tools/oracle/compare.h"

namespace strata::tools {

void add_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout);  // --layout
void add_tolerance_option(CLI::App& app, oracle::Tolerances& tolerances);         // --tolerance

}  // namespace strata::tools
