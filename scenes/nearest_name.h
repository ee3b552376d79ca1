// scenes/nearest_name.h - suggests the known name nearest to a misspelled one.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace strata::scenes {

// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours; the first of equals), or
// "" if that is too far: more than a third of the candidate's letters, or more than one letter of a two-letter name.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

// "'nam' (did you mean 'name'?)", without the question if no candidate is near.
[[nodiscard]] std::string quoted_with_suggestion(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace strata::scenes
