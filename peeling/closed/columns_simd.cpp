// peeling/closed/columns_simd.cpp - arrivals.h for every instruction set. Loops that vectorise are compiled again;
// where the pixels of a vector are neighbours with as many arrivals each, their words and counts are stored as vectors.
// How kernels are written: kernels.md. Tests: tests/peeling/closed/columns_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/closed/columns_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/closed/arrivals.h"
#include "peeling/programs/keys-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace {

using Words = hn::CappedTag<std::uint32_t, block_lanes>;
using Floats = hn::RebindToFloat<Words>;
using Signed = hn::RebindToSigned<Words>;
using WordVec = hn::Vec<Words>;
using WordMask = hn::Mask<Words>;
constexpr std::size_t vector_lanes = hn::MaxLanes(Words{});

HWY_INLINE WordVec counting(std::uint32_t first) { return hn::Add(hn::Set(Words{}, first), hn::Iota(Words{}, 0)); }

HWY_INLINE std::uint32_t bits_of(WordMask mask) {
    std::uint64_t bits = 0;
    hn::StoreMaskBits(Words{}, mask, reinterpret_cast<std::uint8_t*>(&bits));
    return static_cast<std::uint32_t>(bits);
}

// One batch on its way down.
template <bool by_shader_z>
class Appending {
  public:
    HWY_INLINE Appending(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive)
        : to_{to},
          in_{in},
          alive_{alive},
          count_{to.count},
          word_{to.word},
          stride_{to.stride},
          ranks_{to.ranks},
          places_{to.places} {}

    HWY_INLINE bool run() {
        for (std::size_t i = 0; i < lanes(in_); i += vector_lanes)
            if (!vector(i)) return false;
        return true;
    }

  private:
    // A vector of a batch's fragments. The common case is a run, neighbouring pixels that are all visible and equally
    // high: two stores. Else fragments go one by one. Lanes beyond the batch read pixel 0 and are dead.
    HWY_INLINE bool vector(std::size_t i) {
        const Words d;
        const WordMask in_batch = hn::Lt(hn::Iota(d, 0), hn::Set(d, static_cast<std::uint32_t>(lanes(in_) - i)));
        const WordMask lives = hn::And(in_batch, hn::Ne(hn::LoadU(d, alive_ + i), hn::Zero(d)));
        const WordVec pixel = hn::IfThenElseZero(in_batch, hn::LoadU(d, &in_.pixel[i]));
        const bool is_run = hn::AllTrue(d, hn::Eq(pixel, counting(in_.pixel[i])));
        const Keys<Words> keys = keys_at(i, surface_at(pixel, in_.pixel[i], is_run));
        const WordMask is_visible = hn::And(lives, keys.is_visible);
        if (by_shader_z && !hn::AllFalse(d, hn::And(is_visible, keys.is_denormal))) to_.has_denormals = true;
        if (is_run && hn::AllTrue(d, is_visible) && run_of(i, keys.key)) return true;
        HWY_ALIGN std::array<std::uint32_t, vector_lanes> key;
        hn::Store(keys.key, d, key.data());
        if (const std::uint32_t lost = bits_of(hn::AndNot(is_visible, lives)); lost != 0) hide(i, key.data(), lost);
        if (hn::AllTrue(d, is_visible)) {
            for (std::size_t lane = 0; lane < vector_lanes; ++lane)
                if (!one(i + lane, key[lane])) return false;
            return true;
        }
        for (std::uint32_t bits = bits_of(is_visible); bits != 0; bits &= bits - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
            if (!one(i + lane, key[lane])) return false;
        }
        return true;
    }

    // Keys of the opaque surface at the pixels: one value, neighbours, or a gather.
    HWY_INLINE WordVec surface_at(WordVec pixel, std::uint32_t first, bool is_run) const {
        const Words d;
        if (to_.same_opaque) return hn::Set(d, to_.opaque[0]);
        if (is_run) return hn::LoadU(d, to_.opaque + first);
        return hn::GatherIndex(d, to_.opaque, hn::BitCast(Signed{}, pixel));
    }

    HWY_INLINE Keys<Words> keys_at(std::size_t i, WordVec surface) const {
        if constexpr (by_shader_z) {
            return keys_of_z(Words{}, hn::LoadU(Floats{}, &in_.shader_z[i]), surface);
        } else {
            return keys_of_code(Words{}, hn::LoadU(Words{}, &in_.code[i]), surface);
        }
    }

    // Neighbours with as many arrivals each; false, and nothing done, if they have not or there is no room.
    HWY_INLINE bool run_of(std::size_t i, WordVec key) {
        const Words d;
        const std::uint32_t pixel = in_.pixel[i], rank = count_[pixel];
        const WordVec ranks = hn::Set(d, rank);
        if (rank >= ranks_ || !hn::AllTrue(d, hn::Eq(hn::LoadU(d, count_ + pixel), ranks))) return false;
        hn::StoreU(hn::Add(ranks, hn::Set(d, 1)), d, count_ + pixel);
        auto* const words = reinterpret_cast<std::uint32_t*>(word_ + rank * stride_ + pixel);
        hn::StoreInterleaved2(counting(places_ + static_cast<std::uint32_t>(i)), key, d, words);
        return true;
    }

    HWY_INLINE bool one(std::size_t i, std::uint32_t key) {
        const std::uint32_t pixel = in_.pixel[i], rank = count_[pixel];
        if (rank >= ranks_) return false;
        count_[pixel] = rank + 1;
        word_[rank * stride_ + pixel] = std::uint64_t{key} << 32 | (places_ + i);
        return true;
    }

    HWY_INLINE void hide(std::size_t i, const std::uint32_t* key, std::uint32_t lost) {
        for (; lost != 0; lost &= lost - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(lost));
            const std::uint32_t pixel = in_.pixel[i + lane];
            ++to_.hidden[pixel];
            to_.at_surface[pixel] += !by_shader_z && key[lane] == to_.opaque[to_.same_opaque ? 0 : pixel] ? 1 : 0;
        }
    }

    Arrivals& to_;
    const pipeline::FragmentBatch& in_;
    const std::uint32_t* alive_;
    std::uint32_t* count_;  // what stands in `to`, where a store could not have changed it
    std::uint64_t* word_;
    std::size_t stride_;
    std::uint32_t ranks_, places_;
};

bool append_batch(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive) {
    if (!(to.by_shader_z ? Appending<true>{to, in, alive}.run() : Appending<false>{to, in, alive}.run())) return false;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < lanes(in); i += vector_lanes)
            hn::StoreU(hn::LoadU(Floats{}, &in.color[c][i]), Floats{}, to.color[c] + to.places + i);
    to.places += static_cast<std::uint32_t>(lanes(in));
    return true;
}

// The low halves of a level's words, kernels.md 8.
HWY_INLINE WordVec places_at(const ColumnBlock& block, std::size_t level, std::size_t lane) {
    WordVec place, key;
    hn::LoadInterleaved2(Words{}, reinterpret_cast<const std::uint32_t*>(block.levels + level * block_lanes + lane),
                         place, key);
    return place;
}

// Downwards from each level, until every column that has an earlier arrival has found it.
void arrived_before(const ColumnBlock& block, std::uint32_t* before) {
    const Words d;
    for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes) {
        const WordVec visible = hn::LoadU(d, &block.visible[lane]);
        WordVec first = hn::Set(d, ~0u);
        for (std::uint32_t k = 0; k < block.height; ++k) {
            const WordVec place = places_at(block, k, lane);
            WordMask open = hn::And(hn::Lt(hn::Set(d, k), visible), hn::Lt(first, place));
            WordVec levels = hn::Zero(d);
            for (std::uint32_t level = k; !hn::AllFalse(d, open); --level) {
                const WordMask found = hn::And(open, hn::Lt(places_at(block, level - 1, lane), place));
                levels = hn::IfThenElse(found, hn::Set(d, level), levels);
                open = hn::AndNot(found, open);
            }
            hn::StoreU(levels, d, before + k * block_lanes + lane);
            first = hn::Min(first, place);
        }
    }
}

// scalar::Levels. Not inline by itself: the loops of arrivals.h, which belong to no instruction set, come between it
// and its callers.
struct VectorLevels {
    using Wide = hn::CappedTag<std::uint64_t, block_lanes>;
    static constexpr std::size_t step = hn::MaxLanes(Wide{});

    static void exchange(std::uint64_t* a, std::uint64_t* b) {
        for (std::size_t lane = 0; lane < block_lanes; lane += step) {
            const auto x = hn::LoadU(Wide{}, a + lane), y = hn::LoadU(Wide{}, b + lane);
            hn::StoreU(hn::Min(x, y), Wide{}, a + lane);
            hn::StoreU(hn::Max(x, y), Wide{}, b + lane);
        }
    }
    static bool in_order(const std::uint64_t* a, const std::uint64_t* b) {
        for (std::size_t lane = 0; lane < block_lanes; lane += step)
            if (!hn::AllFalse(Wide{}, hn::Lt(hn::LoadU(Wide{}, b + lane), hn::LoadU(Wide{}, a + lane)))) return false;
        return true;
    }
    static bool find_heights(const Arrivals& from, std::size_t pixel, ColumnBlock& block) {
        const Words d;
        WordVec highest = hn::Zero(d), hidden = hn::Zero(d);
        for (std::size_t lane = 0; lane < block_lanes; lane += vector_lanes) {
            const WordVec height = hn::LoadU(d, from.count + pixel + lane),
                          behind = hn::LoadU(d, from.hidden + pixel + lane);
            hn::StoreU(height, d, &block.visible[lane]);
            hn::StoreU(behind, d, &block.hidden[lane]);
            hn::StoreU(hn::LoadU(d, from.at_surface + pixel + lane), d, &block.at_surface[lane]);
            highest = hn::Max(highest, height);
            hidden = hn::Or(hidden, behind);
        }
        block.height = hn::GetLane(hn::MaxOfLanes(d, highest));
        return block.height > 0 || !hn::AllTrue(d, hn::Eq(hidden, hn::Zero(d)));
    }
    static std::uint32_t nearest(const std::uint64_t* level) {
        auto least = hn::LoadU(Wide{}, level);
        for (std::size_t lane = step; lane < block_lanes; lane += step)
            least = hn::Min(least, hn::LoadU(Wide{}, level + lane));
        return static_cast<std::uint32_t>(hn::GetLane(hn::MinOfLanes(Wide{}, least)) >> 32);
    }
    static void load(const std::uint64_t* words, const LaneWords& visible, std::uint32_t k, std::uint64_t* level) {
        for (std::size_t lane = 0; lane < block_lanes; lane += step) {
            const auto height = hn::PromoteTo(Wide{}, hn::LoadU(hn::Rebind<std::uint32_t, Wide>{}, &visible[lane]));
            const auto is_in = hn::Lt(hn::Set(Wide{}, k), height);
            hn::StoreU(hn::IfThenElse(is_in, hn::LoadU(Wide{}, words + lane), hn::Set(Wide{}, ~std::uint64_t{0})),
                       Wide{}, level + lane);
        }
    }
    // Columns of equal height begin at one rank, so that levels are plain loads; others are gathered.
    static void load_from_end(const Arrivals& from, std::size_t pixel, const LaneWords& visible, std::size_t height,
                              std::uint64_t* levels) {
        const bool is_full = std::ranges::all_of(visible, [height](std::uint32_t own) { return own == height; });
        for (std::size_t k = 0; is_full && k < height; ++k)
            for (std::size_t lane = 0; lane < block_lanes; lane += step)
                hn::StoreU(hn::LoadU(Wide{}, from.word + (height - 1 - k) * from.stride + pixel + lane), Wide{},
                           levels + k * block_lanes + lane);
        if (!is_full) gather_from_end(from, pixel, visible, height, levels);
    }
    // `index` steps down a rank a level. It falls below `least` once a column has ended: then the load is clamped and
    // ~0 taken.
    static void gather_from_end(const Arrivals& from, std::size_t pixel, const LaneWords& visible, std::size_t height,
                                std::uint64_t* levels) {
        using Index = hn::RebindToSigned<Wide>;
        const auto least = hn::Set(Index{}, static_cast<std::int64_t>(pixel)), none = hn::Set(Index{}, -1);
        const auto stride = hn::Set(Index{}, static_cast<std::int64_t>(from.stride));
        for (std::size_t lane = 0; lane < block_lanes; lane += step) {
            HWY_ALIGN std::int64_t last[step];
            for (std::size_t i = 0; i < step; ++i)
                last[i] = (std::int64_t{visible[lane + i]} - 1) * static_cast<std::int64_t>(from.stride) +
                          static_cast<std::int64_t>(pixel + lane + i);
            auto index = hn::Load(Index{}, last);
            for (std::size_t k = 0; k < height; ++k, index = hn::Sub(index, stride)) {
                const auto is_in = hn::RebindMask(Wide{}, hn::Lt(none, hn::Sub(index, least)));
                const auto word = hn::GatherIndex(Wide{}, from.word, hn::Max(index, least));
                hn::StoreU(hn::IfThenElse(is_in, word, hn::Set(Wide{}, ~std::uint64_t{0})), Wide{},
                           levels + k * block_lanes + lane);
            }
        }
    }
    // Neighbouring levels with equal upper halves. The words ~0 above a column's end equal each other and do not count.
    static void find_ties(const std::uint64_t* levels, std::size_t height, LaneWords& has_ties) {
        const auto none = hn::Set(Wide{}, ~std::uint64_t{0});
        for (std::size_t lane = 0; lane < block_lanes; lane += step) {
            auto tied = hn::Zero(Wide{}), before = none;
            for (std::size_t k = 0; k < height; ++k) {
                const auto word = hn::LoadU(Wide{}, levels + k * block_lanes + lane);
                const auto same = hn::Eq(hn::ShiftRight<32>(hn::Xor(word, before)), hn::Zero(Wide{}));
                tied = hn::Or(tied, hn::IfThenZeroElse(hn::Eq(word, none), hn::VecFromMask(Wide{}, same)));
                before = word;
            }
            hn::StoreU(hn::TruncateTo(hn::Rebind<std::uint32_t, Wide>{}, tied), hn::Rebind<std::uint32_t, Wide>{},
                       &has_ties[lane]);
        }
    }
};

[[gnu::flatten]] bool take_sorted(const Arrivals& from, std::size_t pixel, ColumnBlock& block, std::uint64_t* levels) {
    return take_levels<VectorLevels>(from, pixel, block, levels);
}

}  // namespace
}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::peeling {
STRATA_EXPORT(append_batch);
STRATA_EXPORT(take_sorted);
STRATA_EXPORT(arrived_before);

bool append(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive) noexcept {
    if (lanes(in) > to.most_places - to.places) return false;
    if (!simd_is_scalar()) return kernel_of(HWY_DISPATCH_TABLE(append_batch))(to, in, alive);
    return to.by_shader_z ? scalar::append<true>(to, in, alive) : scalar::append<false>(to, in, alive);
}

bool take_block(const Arrivals& from, std::size_t pixel, ColumnBlock& block, std::uint64_t* levels) noexcept {
    if (simd_is_scalar()) return take_levels<scalar::Levels>(from, pixel, block, levels);
    return kernel_of(HWY_DISPATCH_TABLE(take_sorted))(from, pixel, block, levels);
}

void find_arrived_before(const ColumnBlock& block, std::uint32_t* before) noexcept {
    if (simd_is_scalar()) return scalar::find_arrived_before(block, before);
    kernel_of(HWY_DISPATCH_TABLE(arrived_before))(block, before);
}

}  // namespace strata::peeling
#endif
