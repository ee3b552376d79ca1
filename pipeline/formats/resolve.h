// pipeline/formats/resolve.h - the samples of every pixel as one: pictures are added sample by sample, and none is
// kept.
//
// Rule     ResolveRule::codes_half_up: the mean of 8-bit codes, rounded half up, stored as the format stores codes.
// single, and float
//          formats by either rule: the sum in binary32 in the order of the samples, times 1/n, stored as a program's
//          colour is. Depth: the nearest of the samples.
// Source   fragment-stages.md 13.3. Tests    tests/pipeline/formats/resolve_test.cpp
#pragma once
#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/image.h"

namespace strata::pipeline {

class ColorResolve {
  public:
    // `samples` is the number of pictures to come: 1, 2, 4 or 8.
    ColorResolve(int samples, ResolveRule rule, ColorRounding rounding) noexcept
        : samples_{samples}, rule_{rule}, rounding_{rounding} {}

    // All of one format and size. What a sample does not have, it has as codes of 0: it is not added.
    void add(const Image& sample);
    [[nodiscard]] Image picture() &&;

  private:
    [[nodiscard]] bool adds_codes() const noexcept {
        return rule_ == ResolveRule::codes_half_up && info(sum_.format).type == ChannelType::unorm8;
    }

    int samples_;
    ResolveRule rule_;
    ColorRounding rounding_;
    Image sum_;  // of codes, or the bits of binary32
};

// Keeps the nearer of two depths at every pixel; an empty `nearest` becomes `sample`. Greater codes are nearer under
// reversed depth.
void add_nearest(const Image& sample, bool greater_is_nearer, Image& nearest);

}  // namespace strata::pipeline
