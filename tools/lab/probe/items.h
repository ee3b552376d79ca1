// tools/lab/probe/items.h - options that probe and infer share: the scenes, and the y direction.
#pragma once
#include "tools/lab/probe/kit/kit.h"
#include "tools/strata/options/option.h"

namespace strata::tools {

// The kit, or the given number of unseen scenes instead.
[[nodiscard]] inline std::vector<probe::Item> items_of(int unseen) {
    return unseen > 0 ? probe::unseen_scenes(0, unseen) : probe::kit();
}

inline void add_orientation(CLI::App& app, std::optional<probe::YDirection>& target, const std::string& help) {
    static const std::vector<Choice<probe::YDirection>> choices{{"up", probe::YDirection::up},
                                                                {"down", probe::YDirection::down}};
    add_choice(app, target, "--y", choices, help);
}

inline void add_unseen(CLI::App& app, int& target) {
    add_option(app, target,
               {"--unseen", "N", "instead of the kit: N scenes that no field was thought of for",
                "a whole number from 1 to 1000"},
               [](std::string_view text) {
                   const auto count = to_int(text);
                   return count && *count >= 1 && *count <= 1000 ? count : std::nullopt;
               });
}

}  // namespace strata::tools
