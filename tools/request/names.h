// tools/request/names.h - formats lists of names for messages.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scenes/nearest_name.h"

namespace strata::tools {

// Returns "'wrong' (did you mean 'right'?)"; without the question if no name is similar.
[[nodiscard]] inline std::string found_but_near(std::string_view wrong, const std::vector<std::string>& names) {
    return scenes::quoted_with_suggestion(wrong, std::vector<std::string_view>(names.begin(), names.end()));
}

// Returns "a, b or c".
[[nodiscard]] inline std::string one_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

}  // namespace strata::tools
