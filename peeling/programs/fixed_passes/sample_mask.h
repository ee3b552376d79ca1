// peeling/programs/fixed_passes/sample_mask.h - the samples that a fragment covers by chance: an integer hash, and a
// mask of as many samples as alpha says.
//
// Rule     hash: three rounds of v ^= v >> 16; v *= 7feb352d; v ^= v >> 15; v *= 846ca68b; v ^= v >> 16 over x + 2^16
//          y, the triangle and the seed, each round's input added to the last one's result. Of S samples a fragment
//          covers n = trunc(a S + (hash / 2^8) 2^-24), in binary32, at most S; which ones, the hash's hashes choose one
//          after the other without preference.
// Source   Enderton et al. 2010, 3.1 (stratified alpha); the mixing function is Wellons's lowbias32 (2018), a bijection
//          of 32 bits [A].
// Tests    tests/peeling/algorithms/stochastic_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

[[nodiscard]] constexpr std::uint32_t mixed(std::uint32_t v) noexcept {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

[[nodiscard]] constexpr std::uint32_t sample_hash(std::uint32_t x, std::uint32_t y, std::uint32_t primitive,
                                                  std::uint32_t seed) noexcept {
    return mixed(mixed(mixed(x + (y << 16)) + primitive) + seed);
}

// Bit s: sample s, of 1 to 8.
[[nodiscard]] inline std::uint32_t sample_mask(float alpha, int samples, std::uint32_t hash) noexcept {
    const float chance = static_cast<float>(hash >> 8) * 0x1p-24f;
    const float wanted = std::min(alpha * static_cast<float>(samples) + chance, static_cast<float>(samples));
    int left = wanted >= 1.0f ? static_cast<int>(wanted) : 0;
    std::uint32_t mask = 0;
    for (int s = 0; s < samples; ++s) {
        hash = mixed(hash + 1u);
        const auto rest = static_cast<std::uint64_t>(samples - s);  // sample s is one of `left` among these
        if ((hash * rest >> 32) >= static_cast<std::uint64_t>(left)) continue;
        mask |= 1u << s;
        --left;
    }
    return mask;
}

}  // namespace strict
}  // namespace strata::peeling
