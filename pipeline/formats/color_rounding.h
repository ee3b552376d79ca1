// pipeline/formats/color_rounding.h - how binary32 colours become the codes of a target, for each type of channel.
#pragma once
#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {

struct ColorRounding {
    HalfRounding half = HalfRounding::nearest_even;
    UnormRounding unorm = UnormRounding::half_up;

    // Where halves alone matter, or 8-bit codes are rounded half up.
    constexpr ColorRounding(HalfRounding h, UnormRounding u = UnormRounding::half_up) noexcept : half{h}, unorm{u} {}
    friend bool operator==(const ColorRounding&, const ColorRounding&) = default;
};

}  // namespace strata::pipeline
