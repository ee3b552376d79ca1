// tools/strata/options/old_words.h - accepts the spellings of commands and options of version 0.1.0.
//
// Rule     Old words are replaced before parsing. A renamed option causes a warning; a command that became part of
//          another one does not. Both will be removed in version 0.3.
// Tests    tests/tools/old_words_test.cpp
#pragma once
#include <string>
#include <vector>

namespace strata::tools {

// Replaces old spellings in a command line without the program name; returns one warning for each option.
[[nodiscard]] std::vector<std::string> replace_old_words(std::vector<std::string>& words);

// The index of the command, after any message options; words.size() if there is no command.
[[nodiscard]] std::size_t command_at(const std::vector<std::string>& words);

}  // namespace strata::tools
