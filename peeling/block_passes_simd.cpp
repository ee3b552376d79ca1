// peeling/block_passes_simd.cpp - block_passes.h compiled once an instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/block_passes_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "peeling/block_passes.h"
#include "rasterizer/simd.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// take_row with gathers.
HWY_INLINE void gather_row(const PeelBlock& block, const LaneWords& row, const LaneWords& has, LaneColor& out) {
    const hn::CappedTag<std::int32_t, block_lanes> di;
    const hn::Rebind<float, decltype(di)> df;
    const hn::Rebind<std::uint16_t, decltype(di)> du;
    HWY_ALIGN std::array<std::uint16_t, block_lanes> arrival;
    for (std::size_t lane = 0; lane < block_lanes; ++lane)
        arrival[lane] = static_cast<std::uint16_t>(block.order[(row[lane] & has[lane]) * block_lanes + lane] & has[lane]);
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::Lanes(di)) {
        const auto first = hn::PromoteTo(di, hn::Load(du, arrival.data() + lane));
        const auto slot = hn::Add(hn::ShiftLeft<4>(first), hn::Iota(di, static_cast<std::int32_t>(lane)));
        const auto kept = hn::BitCast(df, hn::LoadU(di, reinterpret_cast<const std::int32_t*>(&has[lane])));
        for (std::size_t c = 0; c < 4; ++c)
            hn::StoreU(hn::And(hn::GatherIndex(df, block.color[c], slot), kept), df, &out[c][lane]);
    }
}

// The loops of namespace scalar with it.
template <pipeline::BlendRounding rounding>
HWY_INLINE void both_ends_rounded(PeelBlock& block, std::size_t n) {
    LaneWords row, has;
    LaneColor color;
    for (std::uint32_t pass = 0; 2 * pass < block.depth; ++pass) {
        near_rows(block, pass, row, has, n);
        gather_row(block, row, has, color);
        blend_near(block, color, has, n);
        far_rows(block, pass, row, has, n);
        gather_row(block, row, has, color);
        blend_far<rounding>(block, color, n);
    }
}

template <pipeline::BlendRounding rounding>
HWY_INLINE void front_rounded(PeelBlock& block, std::size_t n) {
    LaneWords row, has;
    LaneColor color;
    for (std::uint32_t pass = 0; pass < block.depth; ++pass) {
        front_rows(block, pass, row, has, n);
        gather_row(block, row, has, color);
        blend_front<rounding>(block, color, n);
    }
}

void both_ends(PeelBlock& block, pipeline::BlendRounding rounding, std::size_t n) {
    using enum pipeline::BlendRounding;
    if (rounding == nearest) both_ends_rounded<nearest>(block, n);
    else both_ends_rounded<truncate>(block, n);
}

void front(PeelBlock& block, pipeline::BlendRounding rounding, std::size_t n) {
    using enum pipeline::BlendRounding;
    if (rounding == nearest) front_rounded<nearest>(block, n);
    else front_rounded<truncate>(block, n);
}

}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::peeling {
HWY_EXPORT(both_ends);
HWY_EXPORT(front);

void peel_both_ends(PeelBlock& block, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    if (!simd_is_scalar()) return HWY_DYNAMIC_DISPATCH(both_ends)(block, rounding, block_lanes);
    if (rounding == nearest) scalar::peel_both_ends<nearest>(block, block_lanes);
    else scalar::peel_both_ends<truncate>(block, block_lanes);
}

void peel_front(PeelBlock& block, pipeline::BlendRounding rounding) {
    using enum pipeline::BlendRounding;
    if (!simd_is_scalar()) return HWY_DYNAMIC_DISPATCH(front)(block, rounding, block_lanes);
    if (rounding == nearest) scalar::peel_front<nearest>(block, block_lanes);
    else scalar::peel_front<truncate>(block, block_lanes);
}

}  // namespace strata::peeling
#endif
