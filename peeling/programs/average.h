// peeling/programs/average.h - the resolve of weighted_average.
//
// Rule     C = (sums.rgb / sums.a) (1 - t) + background t with t = (1 - sums.a / n)^n, all in binary32; the power by repeated
//          squaring from the lowest bit of n, every product rounded. The background where n or sums.a is not above 0.
// Source   Bavoil and Myers 2008, "Weighted Average"; algorithms.md 7, erratum E8. The guard for sums.a = 0 is ours.
// Tests    tests/peeling/programs/programs_test.cpp
#pragma once
#include "peeling/programs/programs.h"

namespace strata::peeling {
inline namespace strict {

// Lanes of count pixels; n is the number of fragments.
void resolve_average(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& n,
                     const pipeline::ColorLanes& background, pipeline::ColorLanes& out, std::size_t count) noexcept;

namespace scalar {

// n as an integer, 0 for what is not above 0. A binary32 count stops growing at 2^24, so the limit is never met.
[[gnu::always_inline]] inline std::uint32_t whole_count(float n) noexcept {
    const float positive = n > 0.0f ? n : 0.0f;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(positive < 0x1p30f ? positive : 0x1p30f));
}

inline void resolve_average(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& n,
                            const pipeline::ColorLanes& background, pipeline::ColorLanes& out,
                            std::size_t count) noexcept {
    using pipeline::select;
    pipeline::Lanes<std::uint32_t> left;
    pipeline::Lanes<float> base, power;
    std::uint32_t any_bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
        left[i] = whole_count(n[i]);
        any_bits |= left[i];
        base[i] = 1.0f - sums[3][i] / n[i];
        power[i] = 1.0f;
    }
    for (; any_bits != 0; any_bits >>= 1)
        for (std::size_t i = 0; i < count; ++i) {
            power[i] = select(pipeline::mask((left[i] & 1u) != 0), power[i] * base[i], power[i]);
            left[i] >>= 1;
            base[i] = base[i] * base[i];
        }
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) {
            const float color = (sums[c][i] / sums[3][i]) * (1.0f - power[i]) + background[c][i] * power[i];
            const std::uint32_t has = pipeline::mask(n[i] > 0.0f) & pipeline::mask(sums[3][i] > 0.0f);
            out[c][i] = select(has, color, background[c][i]);
        }
    for (std::size_t i = 0; i < count; ++i) out[3][i] = 1.0f;
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::peeling
