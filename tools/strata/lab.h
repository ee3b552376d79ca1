// tools/strata/lab.h - the experiments: commands of the program strata-lab, which `strata NAME` runs.
//
// Rule     Building strata compiles no experiment. It knows their names and what they do; `strata cost ...` becomes
//          `strata-lab cost ...`, the same process, with the file strata-lab beside its own. What needs every option of
//          every command (completions, all manual pages) is the lab's to write, too, where it is there.
// Tests    tests/tools/lab_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// Adds the command of that name with its description.
CLI::App* add_lab_command(CLI::App& root, std::string_view name);

// Are these words for the lab? `words` begin with a command or with options of messages.
[[nodiscard]] bool is_for_lab(const std::vector<std::string>& words);

// Runs strata-lab in this process; only a failure returns: SystemError, with the command that builds it if it is not
// there.
[[noreturn]] void run_lab(const std::vector<std::string>& words);

}  // namespace strata::tools
