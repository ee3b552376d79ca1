// peeling/dual_pass.h - dual peeling of sixteen columns without equal depths, from their sorted fragments: the scalar twin of
// dual_pass_simd.cpp.
//
// Rule     Pass i takes row i from the front of a column and row i from its back, until they meet. Front: the UNDER of
//          min_max.h, stored as UNORM8 under MAX with the front that other fragments pass through. Back: the code of the
//          far colour, OVER what is there, where its alpha is not 0.
// Tests    tests/peeling/columns_test.cpp; tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>

#include "peeling/columns.h"
#include "pipeline/blend_unorm8.h"
#include "pipeline/unorm8.h"

namespace strata::peeling {

using BlockCodes = std::array<std::array<std::uint32_t, block_lanes>, 4>;

// One block of Columns, and what its pixels have shown so far.
struct DualBlock {
    const std::uint16_t* order;                   // rows of sixteen
    std::array<const float*, 4> color;            // by arrival
    std::array<std::uint32_t, block_lanes> visible, alive;
    std::uint32_t depth;
    BlockCodes front, back;                       // UNORM8 codes
};

inline namespace strict {

using LaneWords = std::array<std::uint32_t, block_lanes>;
using LaneColor = std::array<std::array<float, block_lanes>, 4>;

// `n` is block_lanes, but the compiler must not know it: it would take the loops apart before it looks for vectors.
// The colours of the fragments that stand in row[lane]; 0 where `has` is.
inline void take_row(const DualBlock& block, const LaneWords& row, const LaneWords& has, LaneColor& out, std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        const std::size_t place = (row[lane] & has[lane]) * block_lanes + lane;
        const std::size_t slot = (block.order[place] & has[lane]) * block_lanes + lane;  // an empty place has no arrival
        for (std::size_t c = 0; c < 4; ++c)
            out[c][lane] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(block.color[c][slot]) & has[lane]);
    }
}

// Which rows pass `pass` takes, and which columns still have them.
[[gnu::always_inline]] inline void near_rows(const DualBlock& block, std::uint32_t pass, LaneWords& row, LaneWords& has,
                                             std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        row[lane] = pass;
        has[lane] = pipeline::mask(2 * pass < block.visible[lane]);
    }
}
[[gnu::always_inline]] inline void far_rows(const DualBlock& block, std::uint32_t pass, LaneWords& row, LaneWords& has,
                                            std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        row[lane] = block.visible[lane] - 1 - pass;
        has[lane] = pipeline::mask(2 * pass + 1 < block.visible[lane]);
    }
}

[[gnu::always_inline]] inline void blend_near(DualBlock& block, const LaneColor& color,
                                              const LaneWords& has, std::size_t n) noexcept {
    std::array<float, block_lanes> let_through;
    for (std::size_t lane = 0; lane < n; ++lane)
        let_through[lane] = 1.0f - static_cast<float>(static_cast<std::int32_t>(block.front[3][lane])) / 255.0f;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t lane = 0; lane < n; ++lane) {
            const float front = static_cast<float>(static_cast<std::int32_t>(block.front[c][lane])) / 255.0f;
            const float under = front + let_through[lane] * (color[3][lane] * color[c][lane]);
            const float covered = 1.0f - let_through[lane] * (1.0f - color[3][lane]);
            const std::uint32_t code = pipeline::to_unorm8(c == 3 ? covered : under) & has[lane];
            const std::uint32_t passed = block.front[c][lane] & pipeline::mask(block.alive[lane] > (has[lane] & 1u));
            block.front[c][lane] = std::max(passed, code);
        }
}

template <pipeline::BlendRounding rounding>
[[gnu::always_inline]] inline void blend_far(DualBlock& block, const LaneColor& color, std::size_t n) noexcept {
    using Arithmetic = pipeline::Unorm8Arithmetic<rounding>;
    const auto value = [](std::uint32_t code) { return static_cast<float>(static_cast<std::int32_t>(code)); };
    std::array<float, block_lanes> alpha;
    for (std::size_t lane = 0; lane < n; ++lane) alpha[lane] = value(pipeline::to_unorm8(color[3][lane]));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < n; ++lane) {
            const float source = value(pipeline::to_unorm8(color[c][lane])), stored = value(block.back[c][lane]);
            const float over = Arithmetic::template combine<pipeline::BlendEquation::add>(
                source, alpha[lane], stored, Arithmetic::one_minus(alpha[lane]));
            const auto code = static_cast<std::uint32_t>(static_cast<std::int32_t>(over));
            block.back[c][lane] = pipeline::select(pipeline::mask(alpha[lane] != 0.0f), code, block.back[c][lane]);
        }
}

template <pipeline::BlendRounding rounding>
inline void peel_block(DualBlock& block, std::size_t n) noexcept {
    LaneWords row, has;
    LaneColor color;
    for (std::uint32_t pass = 0; 2 * pass < block.depth; ++pass) {
        near_rows(block, pass, row, has, n);
        take_row(block, row, has, color, n);
        blend_near(block, color, has, n);
        far_rows(block, pass, row, has, n);
        take_row(block, row, has, color, n);
        blend_far<rounding>(block, color, n);
    }
}

}  // namespace strict

// Runs every pass of the block.
void peel_dual_block(DualBlock& block, pipeline::BlendRounding rounding);

}  // namespace strata::peeling
