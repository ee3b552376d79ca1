// peeling/closed/block_passes_simd.cpp - the loops of block_passes.h for every instruction set: a vector of columns at
// a time.
// How kernels are written: kernels.md. Tests: tests/peeling/closed/columns_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/closed/block_passes_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/closed/block_passes.h"
#include "pipeline/formats/unorm8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, block_lanes>;
using Signed = hn::RebindToSigned<Words>;
using Floats = hn::RebindToFloat<Words>;
constexpr std::size_t vector_lanes = hn::MaxLanes(Words{});

using WordVec = hn::Vec<Words>;
using WordMask = hn::Mask<Words>;
using FloatVec = hn::Vec<Floats>;

// Codes are at most 255: exact in binary32, and positive as signed words.
HWY_INLINE FloatVec float_of(WordVec code) { return hn::ConvertTo(Floats{}, hn::BitCast(Signed{}, code)); }

HWY_INLINE FloatVec value_of(WordVec code) { return pipeline::HWY_NAMESPACE::unorm8_values(Words{}, code); }
HWY_INLINE WordVec code_of(FloatVec x) { return pipeline::HWY_NAMESPACE::unorm8_codes(Words{}, x); }

struct AllLanes {
    HWY_INLINE static FloatVec all(float v) { return hn::Set(Floats{}, v); }
};

#include "peeling/programs/under_text-inl.h"

// Unorm8Arithmetic::combine with BlendEquation::add. s F + d G is at most 2 * 255^2, exact in binary32, and is cut to
// 255^2; the shifts divide by 255 and round as fragment-stages.md 8.2 says.
template <pipeline::BlendRounding rounding>
HWY_INLINE WordVec blended(FloatVec s, FloatVec s_factor, FloatVec d, FloatVec d_factor) {
    const Signed di;
    const auto sum = hn::ConvertTo(di, hn::Add(hn::Mul(s, s_factor), hn::Mul(d, d_factor)));
    const auto biased =
        hn::Add(hn::Min(sum, hn::Set(di, 65025)), hn::Set(di, rounding == pipeline::BlendRounding::nearest ? 128 : 1));
    return hn::BitCast(Words{}, hn::ShiftRight<8>(hn::Add(biased, hn::ShiftRight<8>(biased))));
}

// Some columns of a block, and their front and back while the passes run.
template <pipeline::BlendRounding rounding>
class Columns {
  public:
    HWY_INLINE Columns(const ColumnBlock& block, std::size_t lane) : block_{block}, lane_{lane} {
        visible_ = hn::LoadU(Words{}, &block.visible[lane]);
        alive_ = hn::Add(visible_, hn::LoadU(Words{}, &block.hidden[lane]));
        is_full_ = hn::AllTrue(Words{}, hn::Eq(visible_, hn::Set(Words{}, block.height)));
    }
    HWY_INLINE void load(const BlockCodes& codes, WordVec (&to)[4]) const {
        for (std::size_t c = 0; c < 4; ++c) to[c] = hn::LoadU(Words{}, &codes[c][lane_]);
    }
    HWY_INLINE void store(const WordVec (&from)[4], BlockCodes& codes) const {
        for (std::size_t c = 0; c < 4; ++c) hn::StoreU(from[c], Words{}, &codes[c][lane_]);
    }

    HWY_INLINE void both_ends(BlockCodes& front_codes, BlockCodes& back_codes) const {
        WordVec front[4], back[4];
        load(front_codes, front);
        load(back_codes, back);
        for (std::uint32_t pass = 0; 2 * pass < block_.height; ++pass) {
            const WordMask has_near = hn::Lt(hn::Set(Words{}, 2 * pass), visible_);
            blend_near(take(level(pass), has_near), has_near, front);
            if (2 * pass + 1 == block_.height) break;  // no column has a far one any more
            const WordMask has_far = hn::Lt(hn::Set(Words{}, 2 * pass + 1), visible_);
            const WordVec place = is_full_ ? level(block_.height - 1 - pass) : far_places(pass, has_far);
            blend_far(take(place, has_far), back);
        }
        store(front, front_codes);
        store(back, back_codes);
    }

    HWY_INLINE void front_alone(BlockCodes& front_codes) const {
        WordVec front[4];
        load(front_codes, front);
        for (std::uint32_t pass = 0; pass < block_.height; ++pass)
            blend_front(take(level(pass), hn::Lt(hn::Set(Words{}, pass), visible_)), front);
        store(front, front_codes);
    }

  private:
    struct Color {
        FloatVec channel[4];
    };

    // Places of level k, near to far.
    HWY_INLINE WordVec level(std::size_t k) const {
        WordVec place, key;
        hn::LoadInterleaved2(Words{}, reinterpret_cast<const std::uint32_t*>(block_.levels + k * block_lanes + lane_),
                             place, key);
        return place;
    }
    // Places of level visible - 1 - pass of each column: ends lie at different levels, so they are gathered.
    HWY_INLINE WordVec far_places(std::uint32_t pass, WordMask has) const {
        const Words d;
        const WordVec level = hn::IfThenElseZero(has, hn::Sub(visible_, hn::Set(d, pass + 1)));
        const WordVec column = hn::Add(hn::Set(d, static_cast<std::uint32_t>(lane_)), hn::Iota(d, 0));
        const WordVec word = hn::ShiftLeft<1>(hn::Add(hn::ShiftLeft<4>(level), column));
        return hn::GatherIndex(d, reinterpret_cast<const std::uint32_t*>(block_.levels), hn::BitCast(Signed{}, word));
    }

    // With gathers, or where the places are one or follow each other, without.
    HWY_INLINE Color take(WordVec place, WordMask has) const {
        const Words d;
        const Floats df;
        place = hn::IfThenElseZero(has, place);
        const std::uint32_t first = hn::GetLane(place);
        const bool is_run = hn::AllTrue(d, hn::Eq(place, hn::Add(hn::Set(d, first), hn::Iota(d, 0))));
        const bool is_one = hn::AllTrue(d, hn::Eq(place, hn::Set(d, first)));
        Color color;
        for (std::size_t c = 0; c < 4; ++c) {
            color.channel[c] = is_one   ? hn::Set(df, block_.color[c][first])
                               : is_run ? hn::LoadU(df, block_.color[c] + first)
                                        : hn::GatherIndex(df, block_.color[c], hn::BitCast(Signed{}, place));
            color.channel[c] = hn::IfThenElseZero(hn::RebindMask(df, has), color.channel[c]);
        }
        return color;
    }

    // As scalar::blend_near. A column whose only fragment is the near one has no other to pass the old front through; a
    // column that has ended keeps it, because 0 members differ from its number of fragments.
    HWY_INLINE void blend_near(const Color& color, WordMask has, WordVec (&front)[4]) const {
        const FloatVec alpha = color.channel[3], through = let_through(AllLanes{}, value_of(front[3]));
        const WordVec own = hn::IfThenElseZero(has, hn::Set(Words{}, 1));
        const WordMask others = hn::Ne(alive_, own);
        for (std::size_t c = 0; c < 4; ++c) {
            const FloatVec blended = c == 3 ? covered(AllLanes{}, through, alpha)
                                            : under(value_of(front[c]), through, alpha, color.channel[c]);
            front[c] = hn::Max(hn::IfThenElseZero(others, front[c]), hn::IfThenElseZero(has, code_of(blended)));
        }
    }

    // As scalar::blend_far; a column without a far fragment takes alpha 0, and keeps its back.
    HWY_INLINE static void blend_far(const Color& color, WordVec (&back)[4]) {
        const WordVec code = code_of(color.channel[3]);
        const WordMask is_there = hn::Ne(code, hn::Zero(Words{}));
        const FloatVec alpha = float_of(code), rest = hn::Sub(hn::Set(Floats{}, 255.0f), alpha);
        for (std::size_t c = 0; c < 3; ++c) {
            const WordVec over = blended<rounding>(float_of(code_of(color.channel[c])), alpha, float_of(back[c]), rest);
            back[c] = hn::IfThenElse(is_there, over, back[c]);
        }
    }

    // As scalar::blend_front; a column that has ended takes colour 0, which is neutral under UNDER.
    HWY_INLINE static void blend_front(const Color& color, WordVec (&front)[4]) {
        const FloatVec all = hn::Set(Floats{}, 255.0f), let_through = float_of(front[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const WordVec source = code_of(hn::Mul(color.channel[c], color.channel[3]));
            front[c] = blended<rounding>(float_of(source), let_through, float_of(front[c]), all);
        }
        const FloatVec alpha = float_of(code_of(color.channel[3]));
        front[3] = blended<rounding>(alpha, hn::Zero(Floats{}), let_through, hn::Sub(all, alpha));
    }

    const ColumnBlock& block_;
    std::size_t lane_;
    WordVec visible_, alive_;
    bool is_full_;
};

void both_ends(const ColumnBlock& block, BlockCodes& front, BlockCodes& back, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes)
        if (rounding == nearest)
            Columns<nearest>{block, lane}.both_ends(front, back);
        else
            Columns<truncate>{block, lane}.both_ends(front, back);
}

void front_alone(const ColumnBlock& block, BlockCodes& front, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes)
        if (rounding == nearest)
            Columns<nearest>{block, lane}.front_alone(front);
        else
            Columns<truncate>{block, lane}.front_alone(front);
}

void codes(const std::uint32_t* words, BlockCodes& out) {
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes) {
        const WordVec word = hn::LoadU(Words{}, words + lane);
        for (int c = 0; c < 4; ++c)
            hn::StoreU(hn::And(hn::ShiftRightSame(word, 8 * c), hn::Set(Words{}, 0xffu)), Words{},
                       &out[static_cast<std::size_t>(c)][lane]);
    }
}

// algorithms.md 0.4, with the codes packed to a word a pixel, red lowest.
void last_quad(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, std::uint32_t* words) {
    const Words d;
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes) {
        const FloatVec alpha = value_of(hn::LoadU(d, &front[3][lane]));
        const FloatVec through = meaning == FrontAlpha::covers ? let_through(AllLanes{}, alpha) : alpha;
        WordVec word = hn::Set(d, 0xff000000u);
        for (std::size_t c = 0; c < 3; ++c) {
            const FloatVec near = value_of(hn::LoadU(d, &front[c][lane])),
                           behind = value_of(hn::LoadU(d, &back[c][lane]));
            const WordVec code = code_of(composited(near, through, behind));
            word = hn::Or(word, hn::ShiftLeftSame(code, static_cast<int>(8 * c)));
        }
        hn::StoreU(word, d, words + lane);
    }
}

}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::peeling {
HWY_EXPORT(both_ends);
HWY_EXPORT(front_alone);
HWY_EXPORT(codes);
HWY_EXPORT(last_quad);

void peel_both_ends(const ColumnBlock& block, BlockCodes& front, BlockCodes& back, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    if (!simd_is_scalar()) return kernel_of(HWY_DISPATCH_TABLE(both_ends))(block, front, back, rounding);
    if (rounding == nearest)
        scalar::peel_both_ends<nearest>(block, front, back);
    else
        scalar::peel_both_ends<truncate>(block, front, back);
}

void peel_front(const ColumnBlock& block, BlockCodes& front, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    if (!simd_is_scalar()) return kernel_of(HWY_DISPATCH_TABLE(front_alone))(block, front, rounding);
    if (rounding == nearest)
        scalar::peel_front<nearest>(block, front);
    else
        scalar::peel_front<truncate>(block, front);
}

BlockCodes codes_of(const std::uint32_t* words) {
    BlockCodes result;
    if (simd_is_scalar())
        scalar::codes_of(words, result);
    else
        kernel_of(HWY_DISPATCH_TABLE(codes))(words, result);
    return result;
}

void composite_block(const BlockCodes& front, const BlockCodes& back, FrontAlpha meaning, std::uint32_t* words) {
    if (simd_is_scalar()) return scalar::composite(front, back, meaning, words);
    kernel_of(HWY_DISPATCH_TABLE(last_quad))(front, back, meaning, words);
}

}  // namespace strata::peeling
#endif
