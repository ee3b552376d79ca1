// peeling/programs/fixed_passes/sample_lists.h - sorts and composites the fragments that a pixel has in the samples of
// several targets.
//
// Rule     Samples with a given code are empty. The others are composited UNDER in binary32, nearest first, equal codes
//          in the order of the samples, and the background is added with the remaining transmittance.
// Numbers  Colours are four channels of 8, 16 or 32 bits, as targets of a frame's colour format have them.
// Tests    tests/peeling/programs/sample_lists_test.cpp
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "peeling/programs/under.h"
#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/frame/pass.h"
#include "pipeline/stages/lane_words.h"
#include "rasterizer/base/vector.h"

namespace strata::peeling {

// One sample of every pixel of a region.
struct SamplePlanes {
    const std::uint32_t* codes;  // depth codes
    pipeline::Texels color;
};

class SampleLists {
  public:
    SampleLists(std::vector<SamplePlanes> samples, std::uint32_t empty, pipeline::ColorRounding rounding)
        : samples_{std::move(samples)}, empty_{empty}, rounding_{rounding} {
        words_.reserve(samples_.size());
    }
    // The pixel's colour over its colour in `background`.
    [[nodiscard]] Rgba composite(std::uint32_t pixel, const pipeline::Texels& background);
    // (code, sample index) of the fragments composited last, nearest first.
    [[nodiscard]] std::span<const std::uint64_t> order() const noexcept { return words_; }

  private:
    template <class Decode>
    [[nodiscard]] Rgba composite_as(std::uint32_t pixel, const pipeline::Texels& background) const noexcept;

    std::vector<SamplePlanes> samples_;
    std::vector<std::uint64_t> words_;
    std::uint32_t empty_;
    pipeline::ColorRounding rounding_;
};

namespace sample_formats {

// Converts a channel's code to a value; `bits` is its width.
template <pipeline::UnormRounding rounding>
struct ByteChannels {
    static constexpr std::size_t bits = 8;
    static float value(std::uint32_t code) noexcept { return pipeline::code_value<rounding>(code); }
};
template <pipeline::HalfRounding rounding>
struct HalfChannels {
    static constexpr std::size_t bits = 16;
    static float value(std::uint32_t code) noexcept {
        return pipeline::half_value<rounding>(static_cast<std::uint16_t>(code));
    }
};
struct SingleChannels {
    static constexpr std::size_t bits = 32;
    static float value(std::uint32_t code) noexcept { return std::bit_cast<float>(code); }
};

template <class Decode>
[[nodiscard]] Rgba decoded(const pipeline::Texels& from, std::uint32_t pixel) noexcept {
    constexpr std::size_t channels_of_word = 32 / Decode::bits;
    Rgba color;
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t word = from.plane(c / channels_of_word).words[pixel];
        color[c] = Decode::value(word >> (c % channels_of_word * Decode::bits) & (~0u >> (32 - Decode::bits)));
    }
    return color;
}

}  // namespace sample_formats

template <class Decode>
Rgba SampleLists::composite_as(std::uint32_t pixel, const pipeline::Texels& background) const noexcept {
    Rgba front{0, 0, 0, 1};
    for (const std::uint64_t word : words_) {
        const Rgba color = sample_formats::decoded<Decode>(samples_[static_cast<std::uint32_t>(word)].color, pixel);
        for (std::size_t c = 0; c < 3; ++c) front[c] += front[3] * (color[3] * color[c]);
        front[3] *= 1.0f - color[3];
    }
    const Rgba behind = sample_formats::decoded<Decode>(background, pixel);
    for (std::size_t c = 0; c < 3; ++c) front[c] += front[3] * behind[c];
    front[3] = scalar::alpha_over(front[3], behind[3]);
    return front;
}

inline Rgba SampleLists::composite(std::uint32_t pixel, const pipeline::Texels& background) {
    using namespace sample_formats;
    words_.clear();
    for (std::size_t s = 0; s < samples_.size(); ++s)
        if (const std::uint32_t code = samples_[s].codes[pixel]; code != empty_)
            words_.push_back(std::uint64_t{code} << 32 | s);
    std::ranges::sort(words_);
    using enum pipeline::UnormRounding;
    using enum pipeline::HalfRounding;
    if (background.bits_per_channel == 32) return composite_as<SingleChannels>(pixel, background);
    if (background.bits_per_channel == 16 && rounding_.half == no_infinity)
        return composite_as<HalfChannels<no_infinity>>(pixel, background);
    if (background.bits_per_channel == 16) return composite_as<HalfChannels<nearest_even>>(pixel, background);
    switch (rounding_.unorm) {
        case half_up: return composite_as<ByteChannels<half_up>>(pixel, background);
        case product_even: return composite_as<ByteChannels<product_even>>(pixel, background);
        case product_even_wide: break;
    }
    return composite_as<ByteChannels<product_even_wide>>(pixel, background);
}

}  // namespace strata::peeling
