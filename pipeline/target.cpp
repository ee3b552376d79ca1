#include "pipeline/target.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace strata::pipeline {

namespace {

// Calls body with the number of channels as a constant, so that the copy loops have no inner loop left.
template <class Body>
void with_channels(int channels, Body&& body) {
    if (channels == 4) return body(std::integral_constant<std::size_t, 4>{});
    if (channels == 2) return body(std::integral_constant<std::size_t, 2>{});
    body(std::integral_constant<std::size_t, 1>{});
}

template <class T>
void gather_texels(const T* base, int channels, const Lanes<std::uint32_t>& pixel, int count, ColorCodes& codes) {
    with_channels(channels, [&](auto constant) {
        constexpr std::size_t n = decltype(constant)::value;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            for (std::size_t c = 0; c < n; ++c) codes[c][i] = base[pixel[i] * n + c];
    });
}

template <class T>
void scatter_texels(T* base, int channels, const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive,
                    int count, unsigned mask, const ColorCodes& codes) {
    with_channels(channels, [&](auto constant) {
        constexpr std::size_t n = decltype(constant)::value;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            if (alive[i] == 0) continue;
            for (std::size_t c = 0; c < n; ++c)
                if (mask >> c & 1u) base[pixel[i] * n + c] = static_cast<T>(codes[c][i]);
        }
    });
}

// Four 8-bit channels travel as one word: r in the low byte, as they lie in memory.
static_assert(std::endian::native == std::endian::little);

void gather_words(const std::uint8_t* base, const Lanes<std::uint32_t>& pixel, int count, ColorCodes& codes) {
    Lanes<std::uint32_t> word;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        std::memcpy(&word[i], base + std::size_t{4} * pixel[i], 4);
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) codes[c][i] = word[i] >> (8 * c) & 0xffu;
}

void scatter_words(std::uint8_t* base, const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count,
                   unsigned mask, const ColorCodes& codes) {
    std::uint32_t written = 0;
    for (std::size_t c = 0; c < 4; ++c)
        if (mask >> c & 1u) written |= 0xffu << (8 * c);
    Lanes<std::uint32_t> word;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        word[i] = codes[0][i] | codes[1][i] << 8 | codes[2][i] << 16 | codes[3][i] << 24;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        std::uint8_t* const texel = base + std::size_t{4} * pixel[i];
        std::uint32_t old;
        std::memcpy(&old, texel, 4);
        const std::uint32_t changed = written & alive[i];
        const std::uint32_t merged = (word[i] & changed) | (old & ~changed);
        std::memcpy(texel, &merged, 4);
    }
}

// One sample plane holds `plane` pixels.
template <class T>
void fill_texels(std::vector<T>& texels, std::size_t channels, std::size_t plane, const std::array<std::uint32_t, 4>& codes,
                 unsigned sample_mask) {
    const std::size_t stride = plane * channels;
    for (std::size_t sample = 0; sample * stride < texels.size(); ++sample) {
        if ((sample_mask >> sample & 1u) == 0) continue;
        T* const begin = texels.data() + sample * stride;
        if (channels == 1 || std::all_of(codes.begin(), codes.begin() + static_cast<std::ptrdiff_t>(channels),
                                         [&](std::uint32_t code) { return code == codes[0]; })) {
            std::fill(begin, begin + stride, static_cast<T>(codes[0]));
            continue;
        }
        with_channels(static_cast<int>(channels), [&](auto constant) {
            constexpr std::size_t n = decltype(constant)::value;
            for (std::size_t i = 0; i < plane; ++i)
                for (std::size_t c = 0; c < n; ++c) begin[i * n + c] = static_cast<T>(codes[c]);
        });
    }
}

}  // namespace

TargetStorage::TargetStorage(Format format, int samples, std::size_t pixels)
    : format_{format}, samples_{samples}, pixels_{pixels} {
    const std::size_t texels = pixels * static_cast<std::size_t>(samples);
    const std::size_t values = texels * static_cast<std::size_t>(info(format).channels);
    switch (info(format).type) {
        case ChannelType::unorm8: bytes_.resize(values); break;
        case ChannelType::half: halves_.resize(values); break;
        case ChannelType::single: words_.resize(values); break;
        case ChannelType::depth: words_.resize(texels); break;
        case ChannelType::stencil: break;
    }
    if (has_stencil(format)) bytes_.resize(texels);
}

void TargetStorage::gather(const Lanes<std::uint32_t>& pixel, int count, int sample, ColorCodes& codes) const {
    const int channels = info(format_).channels;
    const std::size_t base = plane(sample) * static_cast<std::size_t>(channels);
    switch (info(format_).type) {
        case ChannelType::unorm8: return gather_words(bytes_.data() + base, pixel, count, codes);
        case ChannelType::half: return gather_texels(halves_.data() + base, channels, pixel, count, codes);
        case ChannelType::single:
        case ChannelType::depth: return gather_texels(words_.data() + base, channels, pixel, count, codes);
        case ChannelType::stencil: return gather_texels(bytes_.data() + base, channels, pixel, count, codes);
    }
}

void TargetStorage::scatter(const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count, int sample,
                            unsigned mask, const ColorCodes& codes) {
    const int channels = info(format_).channels;
    const std::size_t base = plane(sample) * static_cast<std::size_t>(channels);
    switch (info(format_).type) {
        case ChannelType::unorm8: return scatter_words(bytes_.data() + base, pixel, alive, count, mask, codes);
        case ChannelType::half:
            return scatter_texels(halves_.data() + base, channels, pixel, alive, count, mask, codes);
        case ChannelType::single:
        case ChannelType::depth:
            return scatter_texels(words_.data() + base, channels, pixel, alive, count, mask, codes);
        case ChannelType::stencil:
            return scatter_texels(bytes_.data() + base, channels, pixel, alive, count, mask, codes);
    }
}

std::uint32_t TargetStorage::code(std::size_t pixel, int channel, int sample) const {
    const std::size_t texel = plane(sample) + pixel;
    const std::size_t value = texel * static_cast<std::size_t>(info(format_).channels) + static_cast<std::size_t>(channel);
    switch (info(format_).type) {
        case ChannelType::unorm8: return bytes_[value];
        case ChannelType::half: return halves_[value];
        case ChannelType::single: return words_[value];
        case ChannelType::depth: return words_[texel];
        case ChannelType::stencil: return bytes_[texel];
    }
    return 0;  // unreachable: the enum is closed
}

void TargetStorage::fill(const std::array<std::uint32_t, 4>& codes, unsigned sample_mask) {
    const auto channels = static_cast<std::size_t>(info(format_).channels);
    switch (info(format_).type) {
        case ChannelType::unorm8: return fill_texels(bytes_, channels, pixels_, codes, sample_mask);
        case ChannelType::half: return fill_texels(halves_, channels, pixels_, codes, sample_mask);
        case ChannelType::single:
        case ChannelType::depth: return fill_texels(words_, channels, pixels_, codes, sample_mask);
        case ChannelType::stencil: return fill_stencil(static_cast<std::uint8_t>(codes[0]), sample_mask);
    }
}

void TargetStorage::fill_stencil(std::uint8_t value, unsigned sample_mask) {
    fill_texels(bytes_, 1, pixels_, {value, 0, 0, 0}, sample_mask);
}

}  // namespace strata::pipeline
