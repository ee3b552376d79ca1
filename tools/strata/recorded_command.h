// tools/strata/recorded_command.h - the command that a picture keeps, taken apart again.
// Tests    tests/tools/manual_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace strata::tools {

// strata, its command, and the words behind it. InputError if the file keeps none.
[[nodiscard]] std::vector<std::string> recorded_words(const std::string& file);

// `render --from FILE`, or layers: the words of the file's command take the place of the two.
void expand_from(std::vector<std::string>& words);

// For --help; expand_from has taken it before options are parsed.
void add_from_option(CLI::App& app);

}  // namespace strata::tools
