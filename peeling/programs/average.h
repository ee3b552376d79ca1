// peeling/programs/average.h - the resolve of weighted_average.
//
// Rule     C = (sums.rgb / sums.a) (1 - t) + background t with t = (1 - sums.a / n)^n as average_text-inl.h computes
//          them. Where n or sums.a is not above 0, C is the background. Alpha: 1 - t (1 - background alpha).
// Source   Bavoil and Myers 2008, "Weighted Average"; peeling/reference/algorithms.md 7, erratum E8. The test for
//          sums.a = 0 is an addition.
// Tests    tests/peeling/programs/programs_test.cpp
#pragma once
#include "peeling/programs/programs.h"
#include "peeling/programs/under.h"

namespace strata::peeling {
inline namespace strict {

// Resolves `count` lanes; n is the number of fragments.
void resolve_average(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& n,
                     const pipeline::ColorLanes& background, pipeline::ColorLanes& out, std::size_t count) noexcept;

namespace scalar {

// The operations of average_text-inl.h for one lane.
struct OneAverage {
    static constexpr float all(float v) noexcept { return v; }
    // n as an integer; 0 if n is not above 0. A binary32 count stops growing at 2^24, so the limit is never reached.
    static std::uint32_t whole(float n) noexcept {
        const float positive = n > 0.0f ? n : 0.0f;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(positive < 0x1p30f ? positive : 0x1p30f));
    }
    static constexpr bool any(std::uint32_t left) noexcept { return left != 0; }
    static constexpr std::uint32_t halved(std::uint32_t left) noexcept { return left >> 1; }
    static constexpr float if_odd(std::uint32_t left, float yes, float no) noexcept {
        return (left & 1u) != 0 ? yes : no;
    }
};

#include "peeling/programs/average_text-inl.h"

inline void resolve_average(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& n,
                            const pipeline::ColorLanes& background, pipeline::ColorLanes& out,
                            std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const float a = sums[3][i];
        const bool has = n[i] > 0.0f && a > 0.0f;
        const float t = transmittance(OneAverage{}, a, n[i]);
        for (std::size_t c = 0; c < 3; ++c)
            out[c][i] = has ? average_over(OneAverage{}, sums[c][i], a, t, background[c][i]) : background[c][i];
        out[3][i] = has ? alpha_over(t, background[3][i]) : background[3][i];
    }
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::peeling
