// pipeline/formats/image_texels.h - writes the packed texels of an rgba8 target to a finished image with non-temporal
// stores: 16 bytes per pixel that are not read before the frame is finished.
//
// Rule     A packed texel becomes four codes, lowest byte first.
// Tests    tests/pipeline/formats/image_texels_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>

namespace strata::pipeline {

namespace scalar {

inline void widen_words(const std::uint32_t* words, std::size_t count, std::uint32_t* codes) noexcept {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 4; ++c) codes[4 * i + c] = words[i] >> (8 * c) & 0xffu;
}

}  // namespace scalar

void widen_words(const std::uint32_t* words, std::size_t count, std::uint32_t* codes) noexcept;
// Call it after the last widen_words and before another thread is notified that the codes are complete: non-temporal
// stores are not ordered by themselves.
void finish_words() noexcept;

}  // namespace strata::pipeline
