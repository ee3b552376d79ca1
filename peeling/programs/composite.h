// peeling/programs/composite.h - all of a pixel's fragments over its background, in binary64: the truth image. audit.md 1.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "peeling/programs/fragment_lists.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

// The first arrival of equal depths stays in front.
[[nodiscard]] inline std::vector<KeyedFragment> by_exact_depth(std::span<const KeyedFragment> fragments) {
    std::vector<KeyedFragment> sorted(fragments.begin(), fragments.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const KeyedFragment& a, const KeyedFragment& b) { return a.exact_code < b.exact_code; });
    return sorted;
}

// OVER from the far end.
[[nodiscard]] inline std::array<double, 3> composite(std::span<const KeyedFragment> near_to_far,
                                                     const pipeline::Rgba& background) {
    std::array<double, 3> color{background[0], background[1], background[2]};
    for (std::size_t i = near_to_far.size(); i-- > 0;) {
        const pipeline::Rgba& source = near_to_far[i].color;
        const double alpha = source[3];
        for (std::size_t c = 0; c < 3; ++c) color[c] = alpha * source[c] + (1.0 - alpha) * color[c];
    }
    return color;
}

}  // namespace strict
}  // namespace strata::peeling
