// rasterizer/coverage/small_triangles_simd.cpp - the kernels of small_triangles.h, compiled once per instruction set;
// that header defines their meaning. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/rasterizer/walk/tile_rasterizer_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/coverage/small_triangles_simd.cpp"
#include <algorithm>
#include <bit>

#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/coverage/small_coverage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Vectorized by the compiler for this instruction set.
[[gnu::flatten]] void set_up(const GroupRules& rules, TriangleGroup& group) noexcept {
    scalar::set_up_group(rules, group);
}
[[gnu::flatten]] void set_up_boxes(const GroupRules& rules, TriangleGroup& group) noexcept {
    scalar::set_up_boxes(rules, group);
}

// The indices of the set bits of every byte value, in ascending order. A table instead of a loop over bits: the covered
// columns of eight adjacent pixels are one load.
struct BitNumbers {
    std::uint8_t at[256][8];
};
constexpr BitNumbers bit_numbers = [] {
    BitNumbers numbers{};
    for (unsigned byte = 0; byte < 256; ++byte)
        for (unsigned bit = 0, n = 0; bit < 8; ++bit)
            if ((byte >> bit & 1) != 0) numbers.at[byte][n++] = static_cast<std::uint8_t>(bit);
    return numbers;
}();

// Appends the covered pixels among eight adjacent ones; the first has index `pixel` and position (x, y).
HWY_INLINE std::size_t append_eight(std::uint32_t covered, std::uint32_t pixel, std::uint32_t x, std::uint32_t y,
                                    std::size_t at, FragmentBatch& batch) {
    using Columns = hn::CappedTag<std::uint16_t, 8>;
    using Words = hn::CappedTag<std::uint32_t, 8>;
    const Columns d16;
    const Words d32;
    const std::uint8_t* const numbers = bit_numbers.at[covered];
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d32)) {
        const auto number = hn::PromoteTo(d32, hn::LoadU(hn::Rebind<std::uint8_t, Words>{}, numbers + i));
        hn::StoreU(hn::Add(number, hn::Set(d32, pixel)), d32, &batch.pixel[at + i]);
    }
    const auto column = hn::PromoteTo(d16, hn::LoadU(hn::Rebind<std::uint8_t, Columns>{}, numbers));
    hn::StoreU(hn::Add(column, hn::Set(d16, static_cast<std::uint16_t>(x))), d16, &batch.x[at]);
    hn::StoreU(hn::Set(d16, static_cast<std::uint16_t>(y)), d16, &batch.y[at]);
    return at + static_cast<std::size_t>(std::popcount(covered));
}

template <bool within_8>
HWY_INLINE void append(const SmallCoverage<within_8>& coverage, const TriangleGroup& g, std::size_t k,
                       const RegionOrigin& origin, FragmentBatch& batch) {
    using Words = hn::CappedTag<std::uint32_t, 8>;
    auto at = static_cast<std::size_t>(batch.count);
    const std::size_t end = at + static_cast<std::size_t>(coverage.pixels());
    for (std::size_t i = at; i < end; i += hn::Lanes(Words{}))
        hn::StoreU(hn::Set(Words{}, origin.primitive), Words{}, &batch.primitive[i]);
    std::uint32_t pixel = origin.row * origin.width + origin.column;
    for (std::uint32_t row = 0; row < g.height[k]; ++row, pixel += origin.width) {
        const std::uint32_t covered = coverage.row(row), x = g.x0[k], y = g.y0[k] + row;
        at = append_eight(covered & 0xff, pixel, x, y, at, batch);
        if (!within_8 && covered > 0xff) at = append_eight(covered >> 8, pixel + 8, x + 8, y, at, batch);
    }
    batch.count = static_cast<int>(end);
}

// A box of at most 8 by 8 pixels claims eight rows, a compile-time constant; rows below the box have no bits.
template <bool within_8>
HWY_INLINE bool emit_covered(const TriangleGroup& g, std::size_t k, const RegionOrigin& origin, PixelClaims& claims,
                             FragmentBatch& batch) {
    const SmallCoverage<within_8> coverage{g, k};
    if (coverage.pixels() == 0) return true;
    if (batch.count + coverage.pixels() > usable_capacity ||
        !claims.claim_rows({origin.row, origin.column}, g.width[k], coverage.rows(g.height[k]),
                           [&](std::uint32_t row) HWY_ATTR { return coverage.row(row); }))
        return false;
    append(coverage, g, k, origin, batch);
    return true;
}

bool emit(const TriangleGroup& g, std::size_t k, const RegionOrigin& origin, PixelClaims& claims,
          FragmentBatch& batch) noexcept {
    if (std::max(g.width[k], g.height[k]) <= 8) return emit_covered<true>(g, k, origin, claims, batch);
    return emit_covered<false>(g, k, origin, claims, batch);
}

}  // namespace

const SmallKernels* small_table() {
    static constexpr SmallKernels kernels{set_up, set_up_boxes, emit};
    return &kernels;
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
STRATA_EXPORT(small_table);

inline namespace strict {

const SmallKernels& small_kernels() noexcept {
    static constexpr SmallKernels scalar_reference{scalar::set_up_group, scalar::set_up_boxes, scalar::emit_small};
    return simd_is_scalar() ? scalar_reference : *kernel_of(HWY_DISPATCH_TABLE(small_table))();
}

}  // namespace strict
}  // namespace strata::rasterizer
#endif
