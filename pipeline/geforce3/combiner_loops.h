// pipeline/geforce3/combiner_loops.h - the loops of the register combiners over the fragments of a batch, for
// combiner.cpp: one source, vectorized by the compiler for every instruction set.
//
// Rule     pipeline/reference/combiners.md 2 and 3, in units of 1/255. Every loop writes `count` values of `to`.
// Numbers  Registers are -255 to 255, the colour sum is up to 510: sums of products are below 2^20.
// Tests    tests/pipeline/geforce3/combiner_test.cpp, on every instruction set
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "pipeline/formats/unorm8.h"
#include "pipeline/geforce3/combiner.h"

namespace strata::pipeline {

// NV2A's half is 128, not 127.5 (chip-fragment.md 9).
inline constexpr std::int32_t combiner_one = 255, combiner_half = 128;

// A mapping of an input: scale clamp(e, least, greatest) + offset.
struct CombinerMap {
    std::int32_t least, greatest, scale, offset;
};
[[nodiscard]] constexpr CombinerMap map_of(CombinerMapping mapping) noexcept {
    constexpr std::int32_t one = combiner_one, half = combiner_half;
    constexpr std::int32_t low = std::numeric_limits<std::int32_t>::min(),
                           high = std::numeric_limits<std::int32_t>::max();
    switch (mapping) {
        case CombinerMapping::unsigned_identity: return {0, high, 1, 0};
        case CombinerMapping::unsigned_invert: return {0, one, -1, one};
        case CombinerMapping::expand_normal: return {0, high, 2, -one};
        case CombinerMapping::expand_negate: return {0, high, -2, one};
        case CombinerMapping::half_bias_normal: return {0, high, 1, -half};
        case CombinerMapping::half_bias_negate: return {0, high, -1, half};
        case CombinerMapping::signed_identity: return {low, high, 1, 0};
        case CombinerMapping::signed_negate: break;
    }
    return {low, high, -1, 0};
}

// An input of a portion: the register's channel for each output channel, and the mapping.
struct CombinerOperand {
    std::array<const std::int32_t*, 4> channel;
    CombinerMap map;
};

// The scaling of a portion's rounded sum: (((rounded - bias) << left) + right) >> right, clamped to -1..1; a half
// rounds up.
struct CombinerScaling {
    std::int32_t bias = 0, left = 0, right = 0;
};

// The operands A to D of rgb = A B + (1 - A) C + D, in one channel.
using CombinerMix = std::array<CombinerOperand, 4>;

struct CombinerLoops {
    void (*load)(const float* from, std::int32_t* to, std::size_t count) noexcept;
    // x y in output channel `c`, or the dot product of their rgb.
    void (*multiply)(const CombinerOperand& x, const CombinerOperand& y, CombinerProduct kind, std::size_t c,
                     std::int32_t* to, std::size_t count) noexcept;
    // Rounds a sum of products to 1/255 and scales it.
    void (*settle)(const CombinerScaling& scaling, const std::int32_t* from, std::int32_t* to,
                   std::size_t count) noexcept;
    void (*mix)(const CombinerMix& operands, std::size_t c, float* to, std::size_t count) noexcept;
};

// The loops of the selected instruction set.
[[nodiscard]] const CombinerLoops& combiner_loops() noexcept;

inline namespace strict {
namespace scalar {

[[nodiscard]] constexpr std::int32_t mapped(const CombinerMap& map, std::int32_t e) noexcept {
    return map.scale * std::min(std::max(e, map.least), map.greatest) + map.offset;
}

// Rounds a sum of products in units of 1/255^2 to 1/255, to nearest, a half away from 0.
[[nodiscard]] constexpr std::int32_t rounded(std::int32_t sum) noexcept {
    const std::int32_t sign = sum >> 31;
    const auto size = static_cast<std::uint32_t>((sum ^ sign) - sign);
    return (static_cast<std::int32_t>((size + combiner_one / 2) / std::uint32_t{combiner_one}) ^ sign) - sign;
}

inline void load(const float* from, std::int32_t* __restrict to, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) to[i] = to_unorm8(from[i]);
}

inline void multiply(const CombinerOperand& x, const CombinerOperand& y, CombinerProduct kind, std::size_t c,
                     std::int32_t* __restrict to, std::size_t count) noexcept {
    const CombinerMap a = x.map, b = y.map;
    const bool is_dot = kind == CombinerProduct::dot;
    for (std::size_t part = is_dot ? 0 : c; part < (is_dot ? 3 : c + 1); ++part) {
        const std::int32_t* const from = x.channel[part];
        const std::int32_t* const by = y.channel[part];
        const std::int32_t kept = is_dot && part > 0 ? -1 : 0;
        for (std::size_t i = 0; i < count; ++i) to[i] = (to[i] & kept) + mapped(a, from[i]) * mapped(b, by[i]);
    }
}

inline void settle(const CombinerScaling& scaling, const std::int32_t* from, std::int32_t* to,
                   std::size_t count) noexcept {
    const auto [bias, left, right] = scaling;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t x = (((rounded(from[i]) - bias) << left) + right) >> right;
        to[i] = std::min(std::max(x, -combiner_one), combiner_one);
    }
}

// Both products are summed exactly and rounded once; D is added after the rounding.
inline void mix(const CombinerMix& operands, std::size_t c, float* __restrict to, std::size_t count) noexcept {
    const std::array map{operands[0].map, operands[1].map, operands[2].map, operands[3].map};
    const std::array from{operands[0].channel[c], operands[1].channel[c], operands[2].channel[c],
                          operands[3].channel[c]};
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t weight = mapped(map[0], from[0][i]);
        const std::int32_t sum =
            weight * mapped(map[1], from[1][i]) + (combiner_one - weight) * mapped(map[2], from[2][i]);
        const std::int32_t code = rounded(sum) + mapped(map[3], from[3][i]);
        to[i] = unorm8_value(static_cast<std::uint32_t>(std::min(std::max(code, 0), combiner_one)));
    }
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
