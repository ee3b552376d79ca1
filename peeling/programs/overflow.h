// peeling/programs/overflow.h - finds sums that exceeded the numbers of their target.
//
// Rule     A sum beyond the greatest number becomes infinity; where halves are rounded toward zero it stops at 65504,
//          and where they have no infinity at 131008 (pipeline/formats/half.h).
// Tests    tests/peeling/saturation_test.cpp
#pragma once
#include <limits>

#include "pipeline/device/profile.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// The least value of a sum that was cut: sums below it are whole.
[[nodiscard]] inline float least_overflow(const pipeline::Region& region, pipeline::Target target) {
    using pipeline::HalfRounding;
    const bool is_half = pipeline::info(region.storage(target).format()).type == pipeline::ChannelType::half;
    const HalfRounding rounding = region.frame().profile->half_rounding;
    if (!is_half || rounding == HalfRounding::nearest_even) return std::numeric_limits<float>::infinity();
    return rounding == HalfRounding::toward_zero ? 65504.0f : 131008.0f;
}

}  // namespace strata::peeling
