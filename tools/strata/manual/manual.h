// tools/strata/manual/manual.h - what is written about commands and options, all of it made from their declarations:
// help in groups, pages for man, completions for shells.
// Tests    tests/tools/manual_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace strata::tools {

// Rare options are those that a first picture needs none of.
enum class Shown : std::uint8_t { usual, all };

// What --help prints: options by groups, and how many are left out.
[[nodiscard]] std::string help_of(CLI::App& command, Shown shown);

// The commands of the program, as they were added.
[[nodiscard]] std::vector<CLI::App*> commands_of(CLI::App& root);

// A page of section 1 in the language of man: of a command, or of the program where `command` is the root.
[[nodiscard]] std::string man_page(CLI::App& root, CLI::App& command);

enum class Shell : std::uint8_t { bash, zsh, fish };
[[nodiscard]] std::string completions(CLI::App& root, Shell shell);

// Words that an option can be given: of a choice, an algorithm, a device.
[[nodiscard]] std::vector<std::string> values_of(const CLI::Option& option);
// --long, or else -s.
[[nodiscard]] std::string typed_name(const CLI::Option& option);

}  // namespace strata::tools
