// tools/strata/options/option_readers.h - refuses options that were given and that nothing reads.
//
// Rule     Some options are read by single algorithms, some have no effect in a mode of a command such as golden
//          --check. An option without effect is an error that names it: its user expects another result.
// Tests    tests/tools/strata/program/option_readers_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/strata/options/options.h"

namespace strata::tools {

// Throws CLI::ValidationError if an option was given that none of the algorithms reads.
void refuse_unread(const CLI::App& app, const Algorithms& algorithms, const PictureRequest& request);

// Throws CLI::ValidationError if an option or argument was given that is not in `read`, for example "--size has no
// effect with --check". Options of messages are always read.
void refuse_others(const CLI::App& app, const std::vector<std::string_view>& read, const std::string& why);

}  // namespace strata::tools
