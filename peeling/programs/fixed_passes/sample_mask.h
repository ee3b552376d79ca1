// peeling/programs/fixed_passes/sample_mask.h - chooses at random which samples of its pixel a fragment covers, for the
// algorithm stochastic: an integer hash, and a sample mask whose number of bits follows from alpha.
//
// Rule     mix(v) is v ^= v >> 16; v *= 7feb352d; v ^= v >> 15; v *= 846ca68b; v ^= v >> 16. hash = mix(mix(mix(x +
//          2^16 y) + triangle) + seed). Of S samples a fragment with alpha a covers n = trunc(a S + trunc(hash / 2^8)
//          2^-24), in binary32, at most S. Every set of n samples has the same probability: sample after sample, a new
//          hash decides whether it is one of those that are left to choose.
// Source   Enderton et al. 2010, 3.1 (stratified alpha); the paper names no hash, and lowbias32 of Wellons (2018), a
//          bijection of 32 bits, is assumed.
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

// The mask of a fragment: bit s is set if it covers sample s. `samples` is 1 to 8, `hash` as returned by sample_hash.
[[nodiscard]] inline std::uint32_t sample_mask(float alpha, int samples, std::uint32_t hash) noexcept {
    const float chance = static_cast<float>(hash >> 8) * 0x1p-24f;
    const float wanted = std::min(alpha * static_cast<float>(samples) + chance, static_cast<float>(samples));
    int left = wanted >= 1.0f ? static_cast<int>(wanted) : 0;
    std::uint32_t mask = 0;
    for (int s = 0; s < samples; ++s) {
        hash = mixed(hash + 1u);
        const auto rest = static_cast<std::uint64_t>(samples - s);  // `left` of these remaining samples are still to be
                                                                    // chosen
        if ((hash * rest >> 32) >= static_cast<std::uint64_t>(left)) continue;
        mask |= 1u << s;
        --left;
    }
    return mask;
}

}  // namespace strict
}  // namespace strata::peeling
