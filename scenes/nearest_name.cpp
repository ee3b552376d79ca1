// scenes/nearest_name.cpp - suggestions by edit distance.
#include "scenes/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace strata::scenes {
namespace {

// Optimal string alignment, row by row; names are truncated to 64 letters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    // The limit bounds time and memory, because the name may be any text of a file.
    a = a.substr(0, 64);
    b = b.substr(0, 64);
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    // cost[i][j] is the distance between the first i letters of a and the first j of b; from or to nothing it
    // is the length of the other.
    for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
            // Two swapped neighbours are one typing error and cost 1, where replacing both would cost 2.
            const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (exchanged) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost[a.size()][b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
    std::string_view best;
    std::size_t best_distance = 0;
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(name, candidate);
        // At most a third of the candidate's letters may differ, or one of two. Only a smaller distance replaces the
        // best, so the first of equals is kept.
        const std::size_t most = candidate.size() == 2 ? 1 : candidate.size() / 3;
        if (distance > most || candidate.empty() || (!best.empty() && distance >= best_distance)) continue;
        best = candidate;
        best_distance = distance;
    }
    return best;
}

std::string quoted_with_suggestion(std::string_view name, std::span<const std::string_view> candidates) {
    // Keeps error messages to one short line however long the name is.
    const std::string_view shown = name.substr(0, 64), nearest = nearest_name(name, candidates);
    return nearest.empty() ? fmt::format("'{}'", shown) : fmt::format("'{}' (did you mean '{}'?)", shown, nearest);
}

}  // namespace strata::scenes
