// peeling/programs/sample_columns.h - the fragments that samples of many targets hold of a pixel: sorted, and composited.
//
// Rule     Samples of one code are empty. The others are composited UNDER in binary32, nearest first, equal codes in the order of
//          the samples, and what is left of the light falls on the background.
// Numbers  Colours are four channels of 8, 16 or 32 bits, as targets of a frame's colour format have them.
// Tests    tests/peeling/programs/sample_columns_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/formats/unorm8.h"
#include "pipeline/frame/pass.h"
#include "pipeline/stages/lane_words.h"

namespace strata::peeling {

// One sample of every pixel of a region.
struct SamplePlanes {
    const std::uint32_t* codes;  // of depth
    pipeline::Texels color;
};

class SampleColumns {
  public:
    SampleColumns(std::vector<SamplePlanes> samples, std::uint32_t empty, pipeline::UnormRounding rounding)
        : samples_{std::move(samples)}, empty_{empty}, rounding_{rounding} {
        words_.reserve(samples_.size());
    }
    // The pixel's colour over the one that `background` holds.
    [[nodiscard]] pipeline::Rgba composite(std::uint32_t pixel, const pipeline::Texels& background);
    // (code, number of the sample) of what was composited last, nearest first.
    [[nodiscard]] std::span<const std::uint64_t> order() const noexcept { return words_; }

  private:
    template <class Decode>
    [[nodiscard]] pipeline::Rgba composite_as(std::uint32_t pixel, const pipeline::Texels& background) const noexcept;

    std::vector<SamplePlanes> samples_;
    std::vector<std::uint64_t> words_;
    std::uint32_t empty_;
    pipeline::UnormRounding rounding_;
};

}  // namespace strata::peeling
