// pipeline/stages/layer_pixels.h - which pixels a quad over a saved layer visits: those where the layer has a fragment.
//
// Rule     A quad that blends a layer (PassState::layer) leaves pixels without a fragment of it as they are: its source is (0, 0, 0, 0)
//          there. Of codes that is so whatever they are; of floats UNDER and OVER make 0 of -0, and change NaN, infinities and
//          denormals that are flushed: batches with one of those are visited whole. The others are counted as if they had been.
// Source   execution.md 6.
// Tests    tests/pipeline/region/left_out_test.cpp, tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "pipeline/formats/format.h"
#include "pipeline/formats/lane_mask.h"
#include "pipeline/stages/lane_words.h"

namespace strata::pipeline {

// ~0 where a blend with (0, 0, 0, 0) may change a channel of the word; `flushed`: ~0 if denormals become 0. Widened halves are none.
template <ChannelType type>
[[nodiscard]] inline Word is_odd(Word word, Word flushed) noexcept {
    if constexpr (type == ChannelType::unorm8) return 0;
    if constexpr (type == ChannelType::half)
        return mask((word & 0x7c00u) == 0x7c00u) | mask((word & 0xffffu) == 0x8000u) |
               mask((word & 0x7c000000u) == 0x7c000000u) | mask((word & 0xffff0000u) == 0x80000000u);
    const Word exponent = word & 0x7f800000u;
    return mask(exponent == 0x7f800000u) | mask(word == 0x80000000u) |
           (flushed & mask(exponent == 0) & mask(word != 0));
}

// A sample of a colour target, and what blending does to denormals.
struct Blended {
    Texels color;
    Word flushed;
};

template <ChannelType type>
[[nodiscard]] bool has_odd(const Blended& to, std::size_t first, std::size_t count) noexcept {
    Word odd = 0;
    for (std::size_t word = 0; type != ChannelType::unorm8 && word < to.color.words(); ++word) {
        const Word* const words = to.color.plane(word).words + first;
        for (std::size_t i = 0; i < count; ++i) odd |= is_odd<type>(words[i], to.flushed);
    }
    return odd != 0;
}

// The pixels to visit, ascending, into `pixels`, which has spare words behind as many; how many they are. An odd value is seldom: a batch with one is visited whole.
template <ChannelType type>
[[nodiscard]] std::size_t find_pixels(const Word* depth, const Word* surface, const Blended& to, std::size_t area,
                                      Word* pixels) {
    std::size_t found = 0;
    for (std::size_t first = 0; first < area; first += rasterizer::batch_capacity) {
        const std::size_t count = std::min<std::size_t>(area - first, rasterizer::batch_capacity);
        if (has_odd<type>(to, first, count)) {
            std::iota(pixels + found, pixels + found + count, static_cast<Word>(first));
            found += count;
        } else {
            found += find_differing(depth, surface, first, count, pixels + found);
        }
    }
    return found;
}

// The same for a colour target's type.
[[nodiscard]] inline std::size_t find_pixels(ChannelType type, const Word* depth, const Word* surface,
                                             const Blended& to, std::size_t area, Word* pixels) {
    if (type == ChannelType::half) return find_pixels<ChannelType::half>(depth, surface, to, area, pixels);
    if (type == ChannelType::single) return find_pixels<ChannelType::single>(depth, surface, to, area, pixels);
    return find_pixels<ChannelType::unorm8>(depth, surface, to, area, pixels);
}

}  // namespace strata::pipeline
