// pipeline/stages/target_storage.cpp - storage, clears and reads of a render target's planes (target_storage.h).
#include "pipeline/stages/target_storage.h"

#include <algorithm>
#include <bit>

#include "pipeline/formats/narrow.h"
#include "pipeline/formats/packed.h"
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {

// The conversion of a write without blending (pipeline/reference/formats.md 7).
std::array<std::uint32_t, 4> color_codes(Format format, ColorRounding rounding, const Rgba& color) {
    std::array<std::uint32_t, 4> codes{};
    for (std::size_t c = 0; c < 4; ++c) {
        if (is_packed(format)) {
            codes[c] = packed_code(format, static_cast<int>(c), color[c], rounding);
            continue;
        }
        switch (info(format).type) {
            case ChannelType::unorm8:
                codes[c] = narrowed(format, static_cast<int>(c), to_unorm8(color[c], rounding.unorm));
                break;
            case ChannelType::half: codes[c] = to_half(color[c], rounding.half); break;
            case ChannelType::single: codes[c] = std::bit_cast<std::uint32_t>(color[c]); break;
            case ChannelType::unorm10:
            case ChannelType::depth:
            case ChannelType::stencil: break;
        }
    }
    return codes;
}

namespace {

int bits_per_channel(ChannelType type) noexcept {
    switch (type) {
        case ChannelType::unorm8:
        case ChannelType::stencil: return 8;
        case ChannelType::unorm10:
        case ChannelType::half: return 16;
        case ChannelType::single:
        case ChannelType::depth: break;
    }
    return 32;
}

Texels layout(Format format) noexcept { return {{}, info(format).channels, bits_per_channel(info(format).type)}; }

}  // namespace

TargetStorage::TargetStorage(Format format, int samples, std::size_t pixels, TargetWords memory)
    : format_{format}, samples_{samples}, pixels_{pixels}, layout_{layout(format)}, words_{std::move(memory)} {
    const std::size_t size = static_cast<std::size_t>(samples) * words_per_sample();
    if (words_.capacity() < size) words_.clear();  // clear first, so that resize copies nothing
    words_.resize(size);
}

// Const, because the contents are zeros for every first reader. A region belongs to one thread, so reads are never
// concurrent.
void TargetStorage::write_zeros() const noexcept {
    std::ranges::fill(words_, 0u);
    has_words_ = true;
}

void TargetStorage::gather(const Lanes<std::uint32_t>& pixel, int count, int sample, ColorCodes& codes) const {
    gather_codes(texels(sample), {pixel.data(), static_cast<std::size_t>(count)}, codes.data());
}

void TargetStorage::scatter(const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count, int sample,
                            unsigned mask, const ColorCodes& codes) {
    scatter_codes(texels(sample), {pixel.data(), static_cast<std::size_t>(count)}, alive.data(), mask, codes.data());
}

std::uint32_t TargetStorage::code(std::size_t pixel, int channel, int sample) const {
    const Field f = layout_.field(channel);
    return texels(sample).plane(f.word).words[pixel] >> f.shift & f.bits;
}

// A clear of all samples writes every word including spare ones, so zeros are not needed before it. A format with depth
// and stencil needs them, because this clear does not write the stencil.
void TargetStorage::fill(const std::array<std::uint32_t, 4>& codes, unsigned sample_mask) {
    const unsigned all_samples = (1u << samples_) - 1;
    // every word is written below
    if (stencil_word() == 0 && (sample_mask & all_samples) == all_samples) has_words_ = true;
    std::array<std::uint32_t, 4> words{};
    for (int c = 0; c < layout_.channels; ++c) {
        const Field f = layout_.field(c);
        words[f.word] |= (codes[static_cast<std::size_t>(c)] & f.bits) << f.shift;
    }
    for (std::size_t word = 0; word < layout_.words(); ++word) fill_word(words[word], word, sample_mask);
}

void TargetStorage::fill_stencil(std::uint8_t value, unsigned sample_mask) {
    fill_word(value, stencil_word(), sample_mask);
}

void TargetStorage::fill_word(std::uint32_t value, std::size_t word, unsigned sample_mask) {
    for (int sample = 0; sample < samples_; ++sample)
        if ((sample_mask >> sample & 1u) != 0)
            std::fill_n(texels(sample).plane(word).words, pixels_ + spare_words, value);
}

}  // namespace strata::pipeline
