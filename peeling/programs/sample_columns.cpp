// peeling/programs/sample_columns.cpp - a pixel's samples from the words of their targets. The format is chosen once a pixel.
#include "peeling/programs/sample_columns.h"

#include <bit>

#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/fragments/sort_arrivals.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// How a channel's code is read; `bits` is its width.
struct Bytes {
    static constexpr std::size_t bits = 8;
    static float value(std::uint32_t code) noexcept { return unorm8_value(code); }
};
struct BytesByProduct {
    static constexpr std::size_t bits = 8;
    static float value(std::uint32_t code) noexcept { return unorm8_product(code); }
};
struct Halves {
    static constexpr std::size_t bits = 16;
    static float value(std::uint32_t code) noexcept { return half_to_float(static_cast<std::uint16_t>(code)); }
};
struct Singles {
    static constexpr std::size_t bits = 32;
    static float value(std::uint32_t code) noexcept { return std::bit_cast<float>(code); }
};

template <class Decode>
Rgba decoded(const Texels& from, std::uint32_t pixel) noexcept {
    constexpr std::size_t channels_of_word = 32 / Decode::bits;
    Rgba color;
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t word = from.plane(c / channels_of_word).words[pixel];
        color[c] = Decode::value(word >> (c % channels_of_word * Decode::bits) & (~0u >> (32 - Decode::bits)));
    }
    return color;
}

}  // namespace

template <class Decode>
Rgba SampleColumns::composite_as(std::uint32_t pixel, const Texels& background) const noexcept {
    Rgba front{0, 0, 0, 1};
    for (const std::uint64_t word : words_) {
        const Rgba color = decoded<Decode>(samples_[static_cast<std::uint32_t>(word)].color, pixel);
        for (std::size_t c = 0; c < 3; ++c) front[c] += front[3] * (color[3] * color[c]);
        front[3] *= 1.0f - color[3];
    }
    const Rgba behind = decoded<Decode>(background, pixel);
    for (std::size_t c = 0; c < 3; ++c) front[c] += front[3] * behind[c];
    front[3] = 1.0f;
    return front;
}

Rgba SampleColumns::composite(std::uint32_t pixel, const Texels& background) {
    words_.clear();
    for (std::size_t s = 0; s < samples_.size(); ++s)
        if (const std::uint32_t code = samples_[s].codes[pixel]; code != empty_)
            words_.push_back(std::uint64_t{code} << 32 | s);
    sort_arrivals(words_);
    if (background.bits_per_channel == 32) return composite_as<Singles>(pixel, background);
    if (background.bits_per_channel == 16) return composite_as<Halves>(pixel, background);
    if (rounding_ == UnormRounding::product_even) return composite_as<BytesByProduct>(pixel, background);
    return composite_as<Bytes>(pixel, background);
}

}  // namespace strata::peeling
