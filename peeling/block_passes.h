// peeling/block_passes.h - the passes of a peel over sixteen columns without equal depths, from their sorted fragments and on UNORM8
// targets: the scalar twins of block_passes_simd.cpp.
//
// Rule     Pass i takes row i from the front of a column, dual peeling also row i from its back, until they meet.
//          Dual front: the UNDER of min_max.h, stored under MAX with the front that other fragments pass through. Dual back: the
//          code of the far colour, OVER what is there, where its alpha is not 0. Front to back: the code of the colour times
//          alpha, UNDER what is there.
// Tests    tests/peeling/columns_test.cpp; tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>

#include "peeling/columns.h"
#include "pipeline/blend_unorm8.h"
#include "pipeline/unorm8.h"

namespace strata::peeling {

using BlockCodes = std::array<std::array<std::uint32_t, block_lanes>, 4>;

// One block of Columns, and what its pixels have shown so far.
struct PeelBlock {
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
inline void take_row(const PeelBlock& block, const LaneWords& row, const LaneWords& has, LaneColor& out, std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        const std::size_t place = (row[lane] & has[lane]) * block_lanes + lane;
        const std::size_t slot = (block.order[place] & has[lane]) * block_lanes + lane;  // an empty place has no arrival
        for (std::size_t c = 0; c < 4; ++c)
            out[c][lane] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(block.color[c][slot]) & has[lane]);
    }
}

// Which rows pass `pass` takes, and which columns still have them.
[[gnu::always_inline]] inline void near_rows(const PeelBlock& block, std::uint32_t pass, LaneWords& row, LaneWords& has,
                                             std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        row[lane] = pass;
        has[lane] = pipeline::mask(2 * pass < block.visible[lane]);
    }
}
[[gnu::always_inline]] inline void front_rows(const PeelBlock& block, std::uint32_t pass, LaneWords& row, LaneWords& has,
                                              std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        row[lane] = pass;
        has[lane] = pipeline::mask(pass < block.visible[lane]);
    }
}
[[gnu::always_inline]] inline void far_rows(const PeelBlock& block, std::uint32_t pass, LaneWords& row, LaneWords& has,
                                            std::size_t n) noexcept {
    for (std::size_t lane = 0; lane < n; ++lane) {
        row[lane] = block.visible[lane] - 1 - pass;
        has[lane] = pipeline::mask(2 * pass + 1 < block.visible[lane]);
    }
}

[[gnu::always_inline]] inline void blend_near(PeelBlock& block, const LaneColor& color,
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
[[gnu::always_inline]] inline void blend_far(PeelBlock& block, const LaneColor& color, std::size_t n) noexcept {
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

// blend_mode::under; columns that have no fragment any more blend zeros, which change nothing.
template <pipeline::BlendRounding rounding>
[[gnu::always_inline]] inline void blend_front(PeelBlock& block, const LaneColor& color, std::size_t n) noexcept {
    using Arithmetic = pipeline::Unorm8Arithmetic<rounding>;
    using enum pipeline::BlendEquation;
    const auto value = [](std::uint32_t code) { return static_cast<float>(static_cast<std::int32_t>(code)); };
    const auto code = [](float x) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(x)); };
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < n; ++lane) {
            const float source = value(pipeline::to_unorm8(color[c][lane] * color[3][lane]));
            const float under = Arithmetic::template combine<add>(source, value(block.front[3][lane]),
                                                                  value(block.front[c][lane]), Arithmetic::one);
            block.front[c][lane] = code(under);
        }
    for (std::size_t lane = 0; lane < n; ++lane) {
        const float alpha = value(pipeline::to_unorm8(color[3][lane]));
        block.front[3][lane] = code(Arithmetic::template combine<add>(alpha, Arithmetic::zero, value(block.front[3][lane]),
                                                                      Arithmetic::one_minus(alpha)));
    }
}

namespace scalar {

template <pipeline::BlendRounding rounding>
void peel_both_ends(PeelBlock& block, std::size_t n) noexcept {
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

template <pipeline::BlendRounding rounding>
void peel_front(PeelBlock& block, std::size_t n) noexcept {
    LaneWords row, has;
    LaneColor color;
    for (std::uint32_t pass = 0; pass < block.depth; ++pass) {
        front_rows(block, pass, row, has, n);
        take_row(block, row, has, color, n);
        blend_front<rounding>(block, color, n);
    }
}

}  // namespace scalar
}  // namespace strict

// All passes of the block. `front` and `back` hold what was there before.
void peel_both_ends(PeelBlock& block, pipeline::BlendRounding rounding);
void peel_front(PeelBlock& block, pipeline::BlendRounding rounding);  // `back` and `alive` are not looked at

}  // namespace strata::peeling
