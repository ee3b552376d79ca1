// peeling/loops/block_passes.h - the passes of dual peeling and of peeling front to back over a block of per-pixel
// lists: the scalar references of block_passes_simd.cpp.
//
// Rule     Pass i takes depth i of a list from the front and, of dual, depth i from its back, until they meet. Lists
// are
//          independent: the scalar reference processes one after another, the vectors process many at once. Dual front:
//          the UNDER of under_text-inl.h, stored under MAX with the front that other fragments pass through. Dual back:
//          the code of the far colour, OVER the stored back, where its alpha is not 0. Front to back: the stored layer
//          (c a, a), blended by blend_mode::under.
// Ties     Dual: fragments of one depth are one group, MAX over the values that each of them would store. Front to
//          back: the first of them, the others are lost.
// Tests    tests/peeling/loops/block_passes_test.cpp; tests/peeling/execution/execution_test.cpp
#pragma once
#include <algorithm>

#include "peeling/loops/list_block.h"
#include "peeling/programs/programs.h"
#include "peeling/programs/under.h"
#include "pipeline/stages/stored_color.h"

namespace strata::peeling {

using BlockCodes = std::array<BlockLanes, 4>;  // codes of a target by channel

// The rules of a block's passes.
struct BlockRules {
    pipeline::ColorRules color;
    std::uint32_t most_passes = ~0u;  // limit on passes that peel
};

// With colours from 0 to this value and alphas from 0 to 1 no sum exceeds the range of half, and MAX keeps one of the
// two values.
inline constexpr float most_plain_color = 1024.0f;

inline namespace strict {
namespace scalar {

using Color = std::array<float, 4>;
using Codes = std::array<std::uint32_t, 4>;

// Not premultiplied, as rasterized.
[[nodiscard]] inline Color color_at(const ListBlock& block, std::size_t lane, std::size_t k) noexcept {
    return block.color[block.index(lane, k)];
}

[[nodiscard]] inline Codes list(const BlockCodes& codes, std::size_t lane) noexcept {
    return {codes[0][lane], codes[1][lane], codes[2][lane], codes[3][lane]};
}
inline void put_column(const Codes& list, std::size_t lane, BlockCodes& codes) noexcept {
    for (std::size_t c = 0; c < 4; ++c) codes[c][lane] = list[c];
}

// False for colours that MAX does not order (on float targets negative values, -0 and NaN), and for those whose sums
// may exceed the range of half.
[[nodiscard]] inline bool is_plain(const Color& color) noexcept {
    const auto is_at_most = [](float value, float most) {
        return std::bit_cast<std::uint32_t>(value) <= std::bit_cast<std::uint32_t>(most);
    };
    return is_at_most(color[0], most_plain_color) && is_at_most(color[1], most_plain_color) &&
           is_at_most(color[2], most_plain_color) && is_at_most(color[3], 1.0f);
}

// The passes of one list on one kind of target.
template <class Rules>
class ColumnPasses {
  public:
    ColumnPasses(const ListBlock& block, std::size_t lane, const BlockRules& rules)
        : block_{block}, lane_{lane}, most_{rules.most_passes}, target_{rules.color} {}

    void both_ends(Codes& front, Codes& back) const {
        std::uint32_t near = 0, far = block_.visible[lane_];
        for (std::uint32_t pass = 0; near < far && pass < most_; ++pass) {
            const std::uint32_t first = near, behind = far;
            near = block_.end_of_depth(lane_, near, far);
            blend_near(first, near, front);
            if (near == far) break;
            far = block_.begin_of_depth(lane_, near, far - 1);
            blend_far(far, behind, back);
        }
    }

    // A pass after the last layer blends an empty one, which no further such pass changes.
    void near_end(Codes& front) const {
        const std::uint32_t end = block_.visible[lane_];
        std::uint32_t layers = 0;
        for (std::uint32_t k = 0; k < end && layers < most_; k = block_.end_of_depth(lane_, k, end), ++layers)
            blend_under(color_at(block_, lane_, k), front);
        if (layers < most_) blend_under({}, front);
    }

    [[nodiscard]] bool has_plain_colors() const {
        for (std::uint32_t k = 0; k < block_.visible[lane_]; ++k)
            if (!is_plain(color_at(block_, lane_, k))) return false;
        return true;
    }

  private:
    // Every fragment outside [begin, end) passes the old front through, and MAX keeps it. If there is none, MAX meets
    // the cleared target, 0 (peeling/reference/algorithms.md 5.4).
    void blend_near(std::uint32_t begin, std::uint32_t end, Codes& front) const {
        Codes next = block_.visible[lane_] + block_.hidden[lane_] > end - begin ? front : Codes{};
        const float through = let_through(OneFloat{}, target_.value(front[3]));
        for (std::uint32_t k = begin; k < end; ++k) {
            const Color color = color_at(block_, lane_, k);
            for (std::size_t c = 0; c < 4; ++c) {
                const float blended = c == 3 ? covered(OneFloat{}, through, color[3])
                                             : under(target_.value(front[c]), through, color[3], color[c]);
                next[c] = std::max(next[c], target_.max_code(blended));
            }
        }
        front = next;
    }

    // OVER of the dumped colour; its quad discards pixels whose dump has alpha 0 (algorithms.md 5.1).
    void blend_far(std::uint32_t begin, std::uint32_t end, Codes& back) const {
        Codes dump{};
        for (std::uint32_t k = begin; k < end; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                dump[c] = std::max(dump[c], target_.max_code(color_at(block_, lane_, k)[c]));
        const float alpha = target_.operand(dump[3]), rest = target_.rest(alpha);
        for (std::size_t c = 0; c < 3 && dump[3] != 0; ++c)
            back[c] = target_.add(target_.operand(dump[c]), alpha, target_.operand(back[c]), rest);
    }

    // blend_mode::under of a layer that was stored.
    void blend_under(const Color& color, Codes& front) const {
        const float alpha = target_.operand(target_.code(color[3])), through = target_.operand(front[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const float layer = target_.operand(target_.code(color[c] * color[3]));
            front[c] = target_.add(layer, through, target_.operand(front[c]), target_.one);
        }
        front[3] = target_.add(alpha, 0.0f, through, target_.rest(alpha));
    }

    const ListBlock& block_;
    std::size_t lane_;
    std::uint32_t most_;
    pipeline::scalar::StoredColor<Rules> target_;
};

// Peels the lists that contain a depth twice, or all of them.
[[nodiscard]] inline bool peel_both_ends(const ListBlock& block, bool tied_alone, BlockCodes& front_codes,
                                         BlockCodes& back_codes, const BlockRules& rules) {
    bool is_plain = true;
    pipeline::with_rules(rules.color, [&]<class Rules>(Rules) {
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            if (tied_alone && block.has_ties[lane] == 0) continue;
            const ColumnPasses<Rules> passes{block, lane, rules};
            Codes front = list(front_codes, lane), back = list(back_codes, lane);
            passes.both_ends(front, back);
            put_column(front, lane, front_codes);
            put_column(back, lane, back_codes);
            is_plain &= rules.color.type == pipeline::ChannelType::unorm8 || passes.has_plain_colors();
        }
    });
    return is_plain;
}

inline void peel_near_end(const ListBlock& block, BlockCodes& codes, const BlockRules& rules) {
    pipeline::with_rules(rules.color, [&]<class Rules>(Rules) {
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            Codes front = list(codes, lane);
            ColumnPasses<Rules>{block, lane, rules}.near_end(front);
            put_column(front, lane, codes);
        }
    });
}

template <class Rules>
void composite(const pipeline::scalar::StoredColor<Rules>& target, const BlockCodes& front, const BlockCodes& back,
               FrontAlpha meaning, std::uint32_t* words) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const float through = through_front(meaning, target.value(front[3][lane]));
        words[lane] = 0xff000000u;
        for (std::size_t c = 0; c < 3; ++c) {
            const float behind = target.value(back[c][lane]);
            words[lane] |= target.code(composited(target.value(front[c][lane]), through, behind)) << (8 * c);
        }
    }
}

}  // namespace scalar
}  // namespace strict

// All passes of the block. `front` and `back` contain the initial codes and receive the results. Returns false if MAX
// does not order the colours; the codes are then unspecified.
[[nodiscard]] bool peel_both_ends(const ListBlock& block, BlockCodes& front, BlockCodes& back, const BlockRules& rules);
// The same from the front alone, of any colours.
void peel_near_end(const ListBlock& block, BlockCodes& front, const BlockRules& rules);
// The codes of sixteen texels of an rgba8 target, red in the low byte.
[[nodiscard]] inline BlockCodes codes_of(const std::uint32_t* words) noexcept {
    BlockCodes codes;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) codes[c][lane] = words[lane] >> (8 * c) & 0xffu;
    return codes;
}
// Stores in an rgba8 target the result of a peel's last quad: the front over the colour behind it, alpha 1.
void composite_block(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, const BlockRules& rules,
                     std::uint32_t* words);

}  // namespace strata::peeling
