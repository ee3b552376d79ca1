// pipeline/formats/color_rounding.h - how binary32 colours are rounded to the codes of a target, per type of channel.
#pragma once
#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {

struct ColorRounding {
    HalfRounding half = HalfRounding::nearest_even;
    UnormRounding unorm = UnormRounding::half_up;

    // For uses where only halves matter, or where 8-bit codes round half up.
    constexpr ColorRounding(HalfRounding h, UnormRounding u = UnormRounding::half_up) noexcept : half{h}, unorm{u} {}
    friend bool operator==(const ColorRounding&, const ColorRounding&) = default;
};

// How the samples of a pixel are combined to one colour: the mean of 8-bit codes, half up; or a sum in binary32, sample
// by sample, times 1/n, rounded like a program's colour. Float formats always use the latter
// (pipeline/reference/fragment-stages.md 13.3).
enum class ResolveRule : std::uint8_t { codes_half_up, single };

}  // namespace strata::pipeline
