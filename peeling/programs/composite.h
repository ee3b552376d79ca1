// peeling/programs/composite.h - composites all fragments of a pixel over its background in binary64: the true colour,
// with which the audit compares (peeling/reference/audit.md 1).
#pragma once
#include <array>
#include <span>

#include "peeling/programs/tie_order.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

// Blends OVER from the far end, in the order of `near_to_far` reversed: alpha c + (1 - alpha) D, each operation rounded
// to binary64, in this order (algorithms.md 17). `near_to_far` is sorted by exact depth, the first submitted of equal
// ones in front. Alpha: 1 - (1 - background alpha) (1 - alpha) ..., from the far end. The result is premultiplied, like
// the background.
[[nodiscard]] inline std::array<double, 4> composite(std::span<const KeyedFragment> fragments,
                                                     const FragmentOrder& near_to_far,
                                                     const pipeline::Rgba& background) {
    std::array<double, 4> color{background[0], background[1], background[2]};
    double through = 1.0 - double{background[3]};
    for (std::size_t i = near_to_far.size(); i-- > 0;) {
        const pipeline::Rgba& source = fragments[submission_index(near_to_far[i])].color;
        const double alpha = source[3];
        for (std::size_t c = 0; c < 3; ++c) color[c] = alpha * source[c] + (1.0 - alpha) * color[c];
        through *= 1.0 - alpha;
    }
    color[3] = 1.0 - through;
    return color;
}

}  // namespace strict
}  // namespace strata::peeling
