// tools/oracle/folders/name_pattern.h - a pattern of paths that says which part is the name of a picture.
//
// Rule     A pattern contains {name} once, which stands for one or more characters, as many as fit. A star stands for
//          any characters except a slash. The pattern fits whole paths.
// Tests    tests/tools/oracle/folders/name_pattern_test.cpp
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::oracle {

struct NamePattern {
    std::string before{}, after{};  // of {name}
};

// "{name}-actual.png". Empty for a text that contains {name} never or twice.
[[nodiscard]] std::optional<NamePattern> name_pattern(std::string_view text);
// Patterns with commas between: "{name}-expected.png,{name}-actual.png". Empty unless each of them is one.
[[nodiscard]] std::optional<std::vector<NamePattern>> name_patterns(std::string_view text);
// The name in a path: "menu" of "menu-actual.png". Empty if the pattern does not fit.
[[nodiscard]] std::optional<std::string> name_in(std::string_view path, const NamePattern& pattern);

}  // namespace strata::oracle
