// tools/strata/options/shell_words.h - quotes and parses words of a POSIX shell: a name with spaces or a $ remains one
// word.
//
// Rule     A word that contains only letters, digits and @%+=:,./_- is not quoted, any other word is in single quotes;
//          a single quote inside it is written '\''.
// Source   POSIX.1-2017, Shell Command Language 2.2.
// Tests    tests/tools/strata/program/recorded_command_test.cpp
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

[[nodiscard]] inline std::string shell_word(std::string_view word) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view{"@%+=:,./_-"}.find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return std::string(word);
    std::string quoted = "'";
    for (const char c : word)
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    return quoted + "'";
}

// The words of a line that shell_word() quoted; empty if it ends within quotes.
[[nodiscard]] inline std::optional<std::vector<std::string>> shell_words(std::string_view line) {
    std::vector<std::string> words;
    bool is_quoted = false, is_in_word = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == ' ' && !is_quoted) {
            is_in_word = false;
            continue;
        }
        if (!is_in_word) words.emplace_back();
        is_in_word = true;
        if (c == '\'')
            is_quoted = !is_quoted;
        else if (c == '\\' && !is_quoted && i + 1 < line.size())
            words.back() += line[++i];
        else
            words.back() += c;
    }
    if (is_quoted) return std::nullopt;
    return words;
}

}  // namespace strata::tools
