// pipeline/formats/resolve.h - resolves several samples per pixel to one. Images are added one sample at a time, and
// none is stored.
//
// Rule     ResolveRule::codes_half_up: the mean of 8-bit codes, rounded half up, stored as the format stores codes.
//          ResolveRule::single, and float formats with either rule: the sum in binary32 in sample order, times 1/n,
//          stored like a program's colour. Depth: the nearest of the samples.
// Source   pipeline/reference/fragment-stages.md 13.3.
// Tests    tests/pipeline/formats/resolve_test.cpp
#pragma once
#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/image.h"

namespace strata::pipeline {

class ColorResolve {
  public:
    // `samples` is the number of images that will be added: 1, 2, 4 or 8.
    ColorResolve(int samples, ResolveRule rule, ColorRounding rounding) noexcept
        : samples_{samples}, rule_{rule}, rounding_{rounding} {}

    // All images must have the same format and size. A part that a sample does not cover has codes of 0 and adds
    // nothing.
    void add(Image sample);
    [[nodiscard]] Image picture() &&;

  private:
    [[nodiscard]] bool adds_codes() const noexcept {
        return rule_ == ResolveRule::codes_half_up && info(sum_.format).type == ChannelType::unorm8 &&
               !is_packed(sum_.format);
    }

    int samples_;
    ResolveRule rule_;
    ColorRounding rounding_;
    Image sum_;  // sums of codes, or bits of binary32 sums
};

// Quincunx, for 8-bit codes of two samples, a corner and the centre: the centre has the weight 1/2 and each of the
// pixel's four corners 1/8; the sum is rounded half up. The corners on the right and below are samples of the next
// pixels; in the last column and row, the pixel's own corner sample takes their place. Rows are those of memory
// (fragment-stages.md 13.4).
[[nodiscard]] Image quincunx(const Image& corner, const Image& centre);

// Keeps the nearer of two depths, the lesser code or key, at every pixel; an empty `nearest` becomes `sample`.
void add_nearest(Image sample, Image& nearest);

}  // namespace strata::pipeline
