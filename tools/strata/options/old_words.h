// tools/strata/options/old_words.h - how commands and options were spelled in version 0.1.0, for those who type them
// still.
//
// Rule     Words are replaced before they are parsed. An option that has another name now gives a warning, a command
//          that has become a part of another one does not. Both go with version 0.3.
// Tests    tests/tools/old_words_test.cpp
#pragma once
#include <string>
#include <vector>

namespace strata::tools {

// Replaces old spellings in a command line without the program's own name; answers a sentence for each option.
[[nodiscard]] std::vector<std::string> replace_old_words(std::vector<std::string>& words);

// Where the command stands, behind options of messages; words.size() without one.
[[nodiscard]] std::size_t command_at(const std::vector<std::string>& words);

}  // namespace strata::tools
