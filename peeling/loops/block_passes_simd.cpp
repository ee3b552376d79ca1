// peeling/loops/block_passes_simd.cpp - the loops of block_passes.h for every instruction set, one list per lane. How
// kernels are written: rasterizer/reference/kernels.md. Tests: tests/peeling/loops/block_passes_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/loops/block_passes_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/loops/block_passes.h"
#include "pipeline/stages/stored_color-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace pipeline::HWY_NAMESPACE;

static_assert(block_lanes == most_lanes);
constexpr std::size_t vector_lanes = hn::MaxLanes(Words{});

struct AllLanes {
    HWY_INLINE static FloatVec all(float v) { return hn::Set(Floats{}, v); }
};

#include "peeling/programs/under_text-inl.h"

// Some lists of a block, with their front and back during the passes. Dual peeling is of lists without ties.
template <class Rules>
class BlockLists {
  public:
    using Target = StoredColors<Rules>;
    using Held = typename Target::Held;

    HWY_INLINE BlockLists(const ListBlock& block, std::size_t lane, const BlockRules& rules)
        : block_{block}, lane_{lane}, most_{rules.most_passes}, target_{rules.color} {
        visible_ = hn::LoadU(Words{}, &block.visible[lane]);
        alive_ = hn::Add(visible_, hn::LoadU(Words{}, &block.hidden[lane]));
        is_full_ = hn::AllTrue(Words{}, hn::Eq(visible_, hn::Set(Words{}, block.height)));
    }
    HWY_INLINE void load(const BlockCodes& codes, Held (&to)[4]) const {
        for (std::size_t c = 0; c < 4; ++c) to[c] = target_.held(hn::LoadU(Words{}, &codes[c][lane_]));
    }
    // A channel that nothing was blended onto keeps its code, including codes of NaN and denormals.
    HWY_INLINE void store(WordMask blended, const Held (&from)[4], std::size_t channels, BlockCodes& codes) const {
        for (std::size_t c = 0; c < channels; ++c) {
            const WordVec old = hn::LoadU(Words{}, &codes[c][lane_]);
            hn::StoreU(hn::IfThenElse(blended, target_.codes(from[c]), old), Words{}, &codes[c][lane_]);
        }
    }

    // False if MAX does not order the colours.
    HWY_INLINE bool both_ends(BlockCodes& front_codes, BlockCodes& back_codes) const {
        Held front[4], back[4];
        load(front_codes, front);
        load(back_codes, back);
        WordVec most_color = hn::Zero(Words{}), most_alpha = most_color;
        WordMask is_blended = hn::Eq(most_color, hn::Set(Words{}, 1));
        const auto meet = [&](const Color& color) HWY_ATTR {
            if constexpr (!Target::is_float) return;
            for (std::size_t c = 0; c < 3; ++c)
                most_color = hn::Max(most_color, hn::BitCast(Words{}, color.channel[c]));
            most_alpha = hn::Max(most_alpha, hn::BitCast(Words{}, color.channel[3]));
        };
        for (std::uint32_t pass = 0; 2 * pass < block_.height && pass < most_; ++pass) {
            const WordMask has_near = hn::Lt(hn::Set(Words{}, 2 * pass), visible_);
            const Color near = take(level(pass), has_near);
            meet(near);
            blend_near(near, has_near, front);
            if (2 * pass + 1 == block_.height) break;  // no list has a far fragment left
            const WordMask has_far = hn::Lt(hn::Set(Words{}, 2 * pass + 1), visible_);
            const WordVec index = is_full_ ? level(block_.height - 1 - pass) : far_indices(pass, has_far);
            const Color far = take(index, has_far);
            meet(far);
            is_blended = hn::Or(is_blended, blend_far(far, back));
        }
        store(hn::Ne(visible_, hn::Zero(Words{})), front, 4, front_codes);
        store(is_blended, back, 3, back_codes);  // BACK has no alpha of its own
        const auto is_at_most = [](WordVec bits, float most) HWY_ATTR {
            const WordVec bound = hn::BitCast(Words{}, hn::Set(Floats{}, most));
            return hn::AllTrue(Words{}, hn::Eq(hn::Max(bits, bound), bound));
        };
        return is_at_most(most_color, most_plain_color) && is_at_most(most_alpha, 1.0f);
    }

    // Of tied fragments the first is taken: layers are then counted list by list.
    HWY_INLINE void near_end(BlockCodes& front_codes, bool has_ties) const {
        Held front[4];
        load(front_codes, front);
        const WordVec most = hn::Set(Words{}, most_);
        WordVec key_before = hn::Zero(Words{}), layers = has_ties ? key_before : visible_;
        const std::uint32_t end = has_ties ? block_.height : std::min(block_.height, most_);
        for (std::uint32_t pass = 0; pass < end; ++pass) {
            WordVec key;
            const WordVec index = level(pass, key);
            WordMask has = hn::Lt(hn::Set(Words{}, pass), visible_);
            if (has_ties) {
                if (pass > 0) has = hn::And(has, hn::Ne(key, key_before));
                has = hn::And(has, hn::Lt(layers, most));
                layers = hn::Add(layers, hn::IfThenElseZero(has, hn::Set(Words{}, 1)));
            }
            key_before = key;
            blend_under(take(index, has), has, front);
        }
        const WordMask all = hn::Eq(visible_, visible_);
        blend_under(take(visible_, hn::Not(all)), hn::Lt(layers, most), front);
        store(all, front, 4, front_codes);
    }

  private:
    struct Color {
        FloatVec channel[4];
    };

    // Entries of level k, near to far.
    HWY_INLINE WordVec level(std::size_t k) const {
        WordVec key;
        return level(k, key);
    }
    HWY_INLINE WordVec level(std::size_t k, WordVec& key) const {
        WordVec index;
        hn::LoadInterleaved2(Words{}, reinterpret_cast<const std::uint32_t*>(block_.levels + k * block_lanes + lane_),
                             index, key);
        return index;
    }
    // Indices of level visible - 1 - pass of each list: the far ends are at different levels, so they are gathered.
    HWY_INLINE WordVec far_indices(std::uint32_t pass, WordMask has) const {
        const Words d;
        const WordVec level = hn::IfThenElseZero(has, hn::Sub(visible_, hn::Set(d, pass + 1)));
        const WordVec list = hn::Add(hn::Set(d, static_cast<std::uint32_t>(lane_)), hn::Iota(d, 0));
        const WordVec word = hn::ShiftLeft<1>(hn::Add(hn::ShiftLeft<4>(level), list));
        return hn::GatherIndex(d, reinterpret_cast<const std::uint32_t*>(block_.levels), hn::BitCast(Signed{}, word));
    }

    // The colours at the indices: a plain load where the indices are consecutive, else gathers.
    HWY_INLINE Color take(WordVec index, WordMask has) const {
        const Words d;
        const Floats df;
        index = hn::IfThenElseZero(has, index);
        const std::uint32_t first = hn::GetLane(index);
        const bool is_run = hn::AllTrue(d, hn::Eq(index, hn::Add(hn::Set(d, first), hn::Iota(d, 0))));
        Color color;
        const float* const channels = block_.color[0].data();
        if (is_run) {
            hn::LoadInterleaved4(df, channels + 4 * std::size_t{first}, color.channel[0], color.channel[1],
                                 color.channel[2], color.channel[3]);
        } else {
            const auto offset = hn::BitCast(Signed{}, hn::ShiftLeft<2>(index));
            for (std::size_t c = 0; c < 4; ++c) color.channel[c] = hn::GatherIndex(df, channels + c, offset);
        }
        for (std::size_t c = 0; c < 4; ++c)
            color.channel[c] = hn::IfThenElseZero(hn::RebindMask(df, has), color.channel[c]);
        return color;
    }

    // As blend_near of the scalar reference. A list whose only fragment is the near one has no other fragment to pass
    // the old front through. A list that has ended keeps its front, because 0 members differ from its number of
    // fragments.
    HWY_INLINE void blend_near(const Color& color, WordMask has, Held (&front)[4]) const {
        const FloatVec alpha = color.channel[3], through = let_through(AllLanes{}, target_.value(front[3]));
        const WordVec own = hn::IfThenElseZero(has, hn::Set(Words{}, 1));
        const WordMask others = hn::Ne(alive_, own);
        for (std::size_t c = 0; c < 4; ++c) {
            const FloatVec blended = c == 3 ? covered(AllLanes{}, through, alpha)
                                            : under(target_.value(front[c]), through, alpha, color.channel[c]);
            front[c] = greater(where(others, front[c]), where(has, target_.stored(blended)));
        }
    }

    // As blend_far of the scalar reference. A list without a far fragment takes alpha 0 and keeps its back. Returns the
    // mask of lists that have changed.
    HWY_INLINE WordMask blend_far(const Color& color, Held (&back)[4]) const {
        const Held dump = target_.stored(color.channel[3]);
        const WordMask is_there = is_set(dump);
        const FloatVec alpha = target_.operand(dump), rest = target_.rest(alpha);
        for (std::size_t c = 0; c < 3; ++c) {
            const FloatVec far = target_.operand(target_.stored(color.channel[c]));
            back[c] = choose(is_there, target_.add(far, alpha, target_.operand(back[c]), rest), back[c]);
        }
        return is_there;
    }

    // As blend_under of the scalar reference. An 8-bit list that has ended takes colour 0, which changes nothing; a
    // float list keeps its front.
    HWY_INLINE void blend_under(const Color& color, WordMask has, Held (&front)[4]) const {
        const FloatVec through = target_.operand(front[3]);
        const auto kept = [&](Held next, Held old)
                              HWY_ATTR { return Target::is_float ? choose(has, next, old) : next; };
        for (std::size_t c = 0; c < 3; ++c) {
            const FloatVec layer = target_.operand(target_.stored(hn::Mul(color.channel[c], color.channel[3])));
            front[c] = kept(target_.add(layer, through, target_.operand(front[c]), target_.one()), front[c]);
        }
        const FloatVec alpha = target_.operand(target_.stored(color.channel[3]));
        front[3] = kept(target_.add(alpha, hn::Zero(Floats{}), through, target_.rest(alpha)), front[3]);
    }

    const ListBlock& block_;
    std::size_t lane_;
    std::uint32_t most_;
    Target target_;
    WordVec visible_, alive_;
    bool is_full_;
};

bool both_ends(const ListBlock& block, BlockCodes& front, BlockCodes& back, const BlockRules& rules) {
    bool is_plain = true;
    pipeline::with_rules(rules.color, [&]<class Rules>(Rules) HWY_ATTR {
        for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes)
            is_plain &= BlockLists<Rules>{block, lane, rules}.both_ends(front, back);
    });
    return is_plain;
}

void near_end(const ListBlock& block, BlockCodes& front, const BlockRules& rules) {
    const bool has_ties = block.has_any_tie();
    pipeline::with_rules(rules.color, [&]<class Rules>(Rules) HWY_ATTR {
        for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes)
            BlockLists<Rules>{block, lane, rules}.near_end(front, has_ties);
    });
}

// The blending of peeling/reference/algorithms.md 0.4, with the codes packed into one word per pixel, red in the low
// byte.
template <pipeline::UnormRounding to_code>
void last_quad_by(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, std::uint32_t* words) {
    using Target = StoredColors<pipeline::Unorm8Rules<pipeline::BlendRounding::nearest, to_code>>;  // no blending here
    const Words d;
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes) {
        const auto value = [lane](const BlockLanes& codes)
                               HWY_ATTR { return Target::value(hn::LoadU(Words{}, &codes[lane])); };
        const FloatVec alpha = value(front[3]);
        const FloatVec through = meaning == FrontAlpha::covers ? let_through(AllLanes{}, alpha) : alpha;
        WordVec word = hn::Set(d, 0xff000000u);
        for (std::size_t c = 0; c < 3; ++c) {
            const WordVec code = Target::stored(composited(value(front[c]), through, value(back[c])));
            word = hn::Or(word, hn::ShiftLeftSame(code, static_cast<int>(8 * c)));
        }
        hn::StoreU(word, d, words + lane);
    }
}

void last_quad(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, const BlockRules& rules,
               std::uint32_t* words) {
    using enum pipeline::UnormRounding;
    switch (rules.color.rounding.unorm) {
        case half_up: return last_quad_by<half_up>(front, back, meaning, words);
        case product_even: return last_quad_by<product_even>(front, back, meaning, words);
        case product_even_wide: return last_quad_by<product_even_wide>(front, back, meaning, words);
    }
}

}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::peeling {
STRATA_EXPORT(both_ends);
STRATA_EXPORT(near_end);
STRATA_EXPORT(last_quad);

// Lists with ties are rare and left to the scalar reference.
bool peel_both_ends(const ListBlock& block, BlockCodes& front, BlockCodes& back, const BlockRules& rules) {
    if (simd_is_scalar()) return scalar::peel_both_ends(block, false, front, back, rules);
    const auto kernel = kernel_of(HWY_DISPATCH_TABLE(both_ends));
    if (!block.has_any_tie()) return kernel(block, front, back, rules);
    BlockCodes tied_front = front, tied_back = back;
    bool is_plain = kernel(block, front, back, rules);
    is_plain &= scalar::peel_both_ends(block, true, tied_front, tied_back, rules);
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        if (block.has_ties[lane] == 0) continue;
        scalar::put_column(scalar::list(tied_front, lane), lane, front);
        scalar::put_column(scalar::list(tied_back, lane), lane, back);
    }
    return is_plain;
}

void peel_near_end(const ListBlock& block, BlockCodes& front, const BlockRules& rules) {
    if (simd_is_scalar()) return scalar::peel_near_end(block, front, rules);
    kernel_of(HWY_DISPATCH_TABLE(near_end))(block, front, rules);
}

void composite_block(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, const BlockRules& rules,
                     std::uint32_t* words) {
    if (!simd_is_scalar()) return kernel_of(HWY_DISPATCH_TABLE(last_quad))(front, back, meaning, rules, words);
    pipeline::with_rules(rules.color, [&]<class Rules>(Rules) {
        scalar::composite(pipeline::scalar::StoredColor<Rules>{rules.color}, front, back, meaning, words);
    });
}

}  // namespace strata::peeling
#endif
