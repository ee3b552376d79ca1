// peeling/programs/sums.h - targets in which passes add, and the sums that exceed their numbers.
//
// Rule     Sums are stored in binary32 where the frame's colours are, else in halves. A sum beyond the greatest number
//          becomes infinity; where halves are rounded toward zero it stops at 65504, and where they have no infinity at
//          131008 (pipeline/formats/half.h).
// Tests    tests/peeling/saturation_test.cpp
#pragma once
#include <limits>

#include "pipeline/device/profile.h"
#include "pipeline/formats/half.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

[[nodiscard]] inline bool has_wide_sums(const pipeline::Region& region) noexcept {
    return region.frame().color_format == pipeline::Format::rgba32f;
}

// A target with four sums, or with one.
[[nodiscard]] inline pipeline::Target make_sums(pipeline::Region& region) {
    return region.make(has_wide_sums(region) ? pipeline::Format::rgba32f : pipeline::Format::rgba16f);
}
[[nodiscard]] inline pipeline::Target make_sum(pipeline::Region& region) {
    return region.make(has_wide_sums(region) ? pipeline::Format::r32f : pipeline::Format::r16f);
}

// The least value of a sum that was cut: sums below it are whole.
[[nodiscard]] inline float least_overflow(const pipeline::Region& region, pipeline::Target target) {
    const bool is_half = pipeline::info(region.storage(target).format()).type == pipeline::ChannelType::half;
    const pipeline::HalfRounding rounding = region.frame().profile->half_rounding;
    const std::uint16_t greatest = pipeline::stopping_half(rounding);
    if (!is_half || greatest == 0) return std::numeric_limits<float>::infinity();
    return pipeline::half_value(greatest, rounding);
}

}  // namespace strata::peeling
