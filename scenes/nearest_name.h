// scenes/nearest_name.h - the known name that is nearest to `name`.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace strata::scenes {

// The candidate with the smallest edit distance (insert, delete, replace, exchange of neighbours; the first of equals),
// or "" if even that one is no near miss: more than a third of its letters differ, and more than one of two.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

// "'nam' (did you mean 'name'?)", without the question if nothing is near.
[[nodiscard]] std::string quoted_with_suggestion(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace strata::scenes
