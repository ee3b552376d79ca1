// peeling/programs/fixed_passes/buckets.h - divides the depth range of a pixel's fragments into 16 buckets of equal
// width, for bucket_peel.
//
// Rule     The bucket of depth d is trunc((d - near) / (far - near) 16), limited to 0..15, and 0 if near = far. near
//          and far are the least and the greatest depth of the pixel. Under reversed depth 1 - d takes the place of d.
// Source   peeling/reference/algorithms.md 24; Liu et al. 2009.
// Tests    tests/peeling/algorithms/bucket_peel_test.cpp
#pragma once
#include "peeling/programs/region_programs.h"

namespace strata::peeling {

inline constexpr std::size_t buckets = 16;

inline namespace strict {

// The bucket of a fragment with this key, in binary32, each operation rounded. `minus_near` and `far` are the two
// channels of the min-max target: minus the least key, and the greatest.
[[nodiscard]] inline std::size_t bucket_of(bool reversed, float key, float minus_near, float far) noexcept {
    const float near = depth_behind_near(reversed, 0.0f - minus_near);
    const float width = depth_behind_near(reversed, far) - near;
    if (width == 0.0f) return 0;
    const float number = (depth_behind_near(reversed, key) - near) / width * static_cast<float>(buckets);
    if (!(number > 0.0f)) return 0;  // nearer than `near`, or NaN from infinite depths
    return number < static_cast<float>(buckets) ? static_cast<std::size_t>(number) : buckets - 1;
}

}  // namespace strict
}  // namespace strata::peeling
