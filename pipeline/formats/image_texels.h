// pipeline/formats/image_texels.h - the words of an rgba8 target on their way into a finished image, past the caches:
// 16 bytes a pixel that no pass reads before the frame is done.
//
// Rule     A word becomes four codes, its lowest byte first.
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
// Call it after the last widen_words and before another thread is told that the codes are there: stores past the
// caches are not ordered by themselves.
void finish_words() noexcept;

}  // namespace strata::pipeline
