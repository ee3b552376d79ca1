// tools/strata/lab.h - starts the experiments, which are commands of the program strata-lab, for `strata NAME`.
//
// Rule     Building strata does not compile the experiments. It knows only their names and descriptions; `strata cost
//          ...` becomes `strata-lab cost ...` in the same process, with the file strata-lab from strata's own folder.
//          If strata-lab exists, it also writes the completions and manual pages, which need every option of every
//          command.
// Tests    tests/tools/lab/lab_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// Adds the experiment of that name with its description.
CLI::App* add_lab_command(CLI::App& root, std::string_view name);

// True if strata-lab must handle these words. `words` begin with a command or with message options.
[[nodiscard]] bool is_for_lab(const std::vector<std::string>& words);

// Replaces this process with strata-lab; returns only by an exception: SystemError, which names the command that builds
// strata-lab if it is missing.
[[noreturn]] void run_lab(const std::vector<std::string>& words);

}  // namespace strata::tools
