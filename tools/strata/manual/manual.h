// tools/strata/manual/manual.h - texts about commands and options, generated from their declarations: help in groups,
// and bash completions.
// Tests    tests/tools/strata/program/manual_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace strata::tools {

// Whether --help lists the rare options, too. An option is rare if a first picture does not need it.
enum class HelpDetail : std::uint8_t { usual, all };

// The text of --help: options in groups, and the number of options that are not listed.
[[nodiscard]] std::string help_of(CLI::App& command, HelpDetail shown);

// The commands of the program, in the order in which they were added.
[[nodiscard]] std::vector<CLI::App*> commands_of(CLI::App& root);

// A bash script; zsh reads it by bashcompinit.
[[nodiscard]] std::string completions(CLI::App& root);

// The values that an option accepts, if they form a list: choices, algorithms, devices.
[[nodiscard]] std::vector<std::string> values_of(const CLI::Option& option);
// The long name (--long), or the short one (-s) if there is no long name.
[[nodiscard]] std::string typed_name(const CLI::Option& option);

}  // namespace strata::tools
