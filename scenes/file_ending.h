// scenes/file_ending.h - what a file's name ends in, by which its format is chosen.
#pragma once
#include <algorithm>
#include <string_view>

namespace strata::scenes {

// `ending` is in small letters; the path's may be in either case.
[[nodiscard]] inline bool has_ending(std::string_view path, std::string_view ending) noexcept {
    if (path.size() < ending.size()) return false;
    return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [](char wanted, char c) { return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
}

}  // namespace strata::scenes
