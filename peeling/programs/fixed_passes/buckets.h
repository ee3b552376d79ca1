// peeling/programs/fixed_passes/buckets.h - which of 16 buckets of a pixel's depths a fragment belongs to.
//
// Rule     trunc((d - near) / (far - near) 16), from 0 to 15; 0 where all depths are equal. 1 - d under reversed depth.
// Source   algorithms.md 24; Liu et al. 2009.
// Tests    tests/peeling/algorithms/bucket_peel_test.cpp
#pragma once
#include "peeling/programs/region_programs.h"

namespace strata::peeling {

inline constexpr std::size_t buckets = 16;

inline namespace strict {

// Of equal widths between the bounds, both of them included: binary32, each operation rounded.
[[nodiscard]] inline std::size_t bucket_of(bool reversed, float key, float minus_near, float far) noexcept {
    const float near = depth_behind_near(reversed, 0.0f - minus_near);
    const float width = depth_behind_near(reversed, far) - near;
    if (width == 0.0f) return 0;
    const float number = (depth_behind_near(reversed, key) - near) / width * static_cast<float>(buckets);
    if (!(number > 0.0f)) return 0;  // nearer than the first pass found, or NaN of infinite depths
    return number < static_cast<float>(buckets) ? static_cast<std::size_t>(number) : buckets - 1;
}

}  // namespace strict
}  // namespace strata::peeling
