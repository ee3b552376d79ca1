// scenes/file_ending.h - tests the ending of a file's name, by which its format is chosen.
#pragma once
#include <algorithm>
#include <string_view>

namespace strata::scenes {

// `ending` must be in lower case; the case of `path` does not matter.
[[nodiscard]] inline bool has_ending(std::string_view path, std::string_view ending) noexcept {
    if (path.size() < ending.size()) return false;
    return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [](char wanted, char c) { return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
}

}  // namespace strata::scenes
