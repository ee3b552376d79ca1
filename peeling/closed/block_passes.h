// peeling/closed/block_passes.h - the passes of a peel over a block of columns without equal depths, on UNORM8 targets: the scalar twins
// of block_passes_simd.cpp.
//
// Rule     Pass i takes level i of a column from the front, dual peeling also level i from its back, until they meet.
//          Columns do not meet: the twins go from column to column, the vectors through many side by side; what is
//          beyond a column's end changes nothing. Dual front: the UNDER of under_text-inl.h, stored under MAX with the
//          front that other fragments pass through. Dual back: the code of the far colour, OVER what is there, where
//          its alpha is not 0. Front to back: the code of the colour times alpha, UNDER what is there.
// Tests    tests/peeling/closed/columns_test.cpp; tests/peeling/execution_test.cpp
#pragma once
#include <algorithm>
#include <bit>

#include "peeling/closed/columns.h"
#include "peeling/programs/programs.h"
#include "peeling/programs/under.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/stages/blend_unorm8.h"

namespace strata::peeling {

using BlockCodes = std::array<LaneWords, 4>;  // UNORM8 codes by channel

inline namespace strict {
namespace scalar {

using Color = std::array<float, 4>;
using Codes = std::array<std::uint32_t, 4>;

// Straight, as the rasterizer gave it.
[[nodiscard]] inline Color color_at(const ColumnBlock& block, std::size_t lane, std::size_t k) noexcept {
    const std::uint32_t place = block.place(lane, k);
    return {block.color[0][place], block.color[1][place], block.color[2][place], block.color[3][place]};
}

// `others`: how many more fragments the pixel has, before and behind. Each of them passes the old front through, and
// MAX keeps it; without one the cleared target, 0, is what MAX meets (algorithms.md 5.4).
inline void blend_near(const Color& color, std::uint32_t others, Codes& front) noexcept {
    const float through = let_through(OneFloat{}, pipeline::unorm8_value(front[3]));
    for (std::size_t c = 0; c < 4; ++c) {
        const float blended = c == 3 ? covered(OneFloat{}, through, color[3])
                                     : under(pipeline::unorm8_value(front[c]), through, color[3], color[c]);
        front[c] = std::max(others > 0 ? front[c] : 0u, std::uint32_t{pipeline::to_unorm8(blended)});
    }
}

// t = s F + d G as blend_unorm8.h combines codes.
template <pipeline::BlendRounding rounding>
[[nodiscard]] std::uint32_t add(std::uint32_t s, std::uint32_t s_factor, std::uint32_t d,
                                std::uint32_t d_factor) noexcept {
    const auto value = [](std::uint32_t code) { return static_cast<float>(code); };
    return static_cast<std::uint32_t>(
        pipeline::Unorm8Arithmetic<rounding>::template combine<pipeline::BlendEquation::add>(
            value(s), value(s_factor), value(d), value(d_factor)));
}

// OVER of the dumped colour; its quad discards pixels whose dump has alpha 0 (algorithms.md 5.1).
template <pipeline::BlendRounding rounding>
void blend_far(const Color& color, Codes& back) noexcept {
    const std::uint32_t alpha = pipeline::to_unorm8(color[3]);
    for (std::size_t c = 0; c < 3 && alpha != 0; ++c)
        back[c] = add<rounding>(pipeline::to_unorm8(color[c]), alpha, back[c], 255 - alpha);
}

// blend_mode::under.
template <pipeline::BlendRounding rounding>
void blend_front(const Color& color, Codes& front) noexcept {
    for (std::size_t c = 0; c < 3; ++c)
        front[c] = add<rounding>(pipeline::to_unorm8(color[c] * color[3]), front[3], front[c], 255);
    const std::uint32_t alpha = pipeline::to_unorm8(color[3]);
    front[3] = add<rounding>(alpha, 0, front[3], 255 - alpha);
}

[[nodiscard]] inline Codes column(const BlockCodes& codes, std::size_t lane) noexcept {
    return {codes[0][lane], codes[1][lane], codes[2][lane], codes[3][lane]};
}
inline void put_column(const Codes& column, std::size_t lane, BlockCodes& codes) noexcept {
    for (std::size_t c = 0; c < 4; ++c) codes[c][lane] = column[c];
}

template <pipeline::BlendRounding rounding>
void peel_both_ends(const ColumnBlock& block, BlockCodes& front_codes, BlockCodes& back_codes) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const std::uint32_t n = block.visible[lane];
        Codes front = column(front_codes, lane), back = column(back_codes, lane);
        for (std::uint32_t pass = 0; 2 * pass < n; ++pass) {
            blend_near(color_at(block, lane, pass), n + block.hidden[lane] - 1, front);
            if (2 * pass + 1 < n) blend_far<rounding>(color_at(block, lane, n - 1 - pass), back);
        }
        put_column(front, lane, front_codes);
        put_column(back, lane, back_codes);
    }
}

// Front to back, near to far: level k is layer k, because a block here holds no depth twice.
template <pipeline::BlendRounding rounding>
void peel_front(const ColumnBlock& block, BlockCodes& codes) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        Codes front = column(codes, lane);
        for (std::uint32_t k = 0; k < block.visible[lane]; ++k) blend_front<rounding>(color_at(block, lane, k), front);
        put_column(front, lane, codes);
    }
}

inline void codes_of(const std::uint32_t* words, BlockCodes& codes) noexcept {
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) codes[c][lane] = words[lane] >> (8 * c) & 0xffu;
}

inline void composite(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning,
                      std::uint32_t* words) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const float through = through_front(meaning, pipeline::unorm8_value(front[3][lane]));
        words[lane] = 0xff000000u;
        for (std::size_t c = 0; c < 3; ++c) {
            const float behind = pipeline::unorm8_value(back[c][lane]);
            const std::uint32_t code =
                pipeline::to_unorm8(composited(pipeline::unorm8_value(front[c][lane]), through, behind));
            words[lane] |= code << (8 * c);
        }
    }
}

}  // namespace scalar
}  // namespace strict

// All passes of the block. `front` and `back` hold what was there before.
void peel_both_ends(const ColumnBlock& block, BlockCodes& front, BlockCodes& back, pipeline::BlendRounding rounding);
void peel_front(const ColumnBlock& block, BlockCodes& front, pipeline::BlendRounding rounding);
// Sixteen words of an rgba8 target, red lowest.
[[nodiscard]] BlockCodes codes_of(const std::uint32_t* words);
// Stores there what the last quad of a peel stores: the front over the colour behind it, alpha 1.
void composite_block(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, std::uint32_t* words);

}  // namespace strata::peeling
