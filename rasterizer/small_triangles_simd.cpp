// rasterizer/small_triangles_simd.cpp - the kernels of small_triangles.h for every instruction set; their meaning stands
// there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/small_triangles_simd.cpp"
#include <algorithm>
#include <bit>

#include "hwy/foreach_target.h"  // compiles this file once a target
#include "hwy/highway.h"
#include "rasterizer/simd.h"
#include "rasterizer/small_triangles.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Vectorised by the compiler, for this set.
[[gnu::flatten]] void set_up(const GroupRules& rules, TriangleGroup& group) noexcept {
    scalar::set_up_group(rules, group);
}

using U32 = hn::CappedTag<std::uint32_t, 16>;
using I32 = hn::RebindToSigned<U32>;
using U16 = hn::Rebind<std::uint16_t, U32>;
constexpr std::size_t lanes = hn::MaxLanes(U32{}), parts = 16 / lanes;

// A block is 16 pixels: four rows of 4, two of 8 or one of 16, by the width of the box.
struct BlockShape {
    alignas(64) std::uint32_t column[16], row[16];
    std::uint32_t first_column;  // its bits
};
constexpr BlockShape shape_of(std::uint32_t width) {
    BlockShape shape{};
    for (std::uint32_t i = 0; i < 16; ++i) {
        shape.column[i] = i % width;
        shape.row[i] = i / width;
        shape.first_column |= i % width == 0 ? 1u << i : 0;
    }
    return shape;
}
constexpr BlockShape shapes[3] = {shape_of(4), shape_of(8), shape_of(16)};

// What of a small triangle is covered, a bit a pixel, block after block. `within_8` knows that the box lies in 8 x 8
// pixels: four blocks, whose loops end where the compiler can see it.
template <bool within_8>
class Blocks {
  public:
    HWY_INLINE Blocks(const TriangleGroup& g, std::size_t k)
        : log_width_{within_8 || (g.width[k] > 4 && g.width[k] <= 8) ? 3u : (g.width[k] <= 4 ? 2u : 4u)},
          count_{within_8 ? 4u : ((g.height[k] << log_width_) + 15) / 16},
          shape_{shapes[log_width_ - 2]} {
        const U32 d;
        hn::Vec<U32> edge[3][parts], down[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto value = hn::Set(d, g.value[i][k]), step = hn::Set(d, g.step[i][k]);
            const auto row_down = hn::Set(d, g.down[i][k]);
            for (std::size_t part = 0; part < parts; ++part)
                edge[i][part] = hn::Add(hn::Add(value, hn::Mul(hn::Load(d, shape_.column + part * lanes), step)),
                                        hn::Mul(hn::Load(d, shape_.row + part * lanes), row_down));
            down[i] = hn::Set(d, g.down[i][k] << (4 - log_width_));
        }
        const std::uint32_t in_box = ((1u << g.width[k]) - 1) * shape_.first_column;
        for (std::uint32_t b = 0; b < count(); ++b) {
            std::uint32_t covered = 0;
            for (std::size_t part = 0; part < parts; ++part) {
                covered |= not_negative(hn::Or(hn::Or(edge[0][part], edge[1][part]), edge[2][part])) << part * lanes;
                for (std::size_t i = 0; i < 3; ++i) edge[i][part] = hn::Add(edge[i][part], down[i]);
            }
            bits_[b / 4] |= std::uint64_t{covered & in_box} << b % 4 * 16;
        }
        const std::uint32_t end = g.height[k] << log_width_;  // no rows below the box
        bits_[(end - 1) / 64] &= ~std::uint64_t{0} >> (64 - end) % 64;
        for (std::uint32_t word = 0; word < (count() + 3) / 4; ++word) pixels_ += std::popcount(bits_[word]);
    }
    HWY_INLINE int pixels() const { return pixels_; }
    HWY_INLINE std::uint32_t row(std::uint32_t r) const {
        const std::uint32_t bit = r << log_width_;
        return static_cast<std::uint32_t>(bits_[bit / 64] >> bit % 64) & ((1u << (1u << log_width_)) - 1);
    }
    // How many rows to claim: those below the box are empty.
    HWY_INLINE std::uint32_t rows(std::uint32_t height) const { return within_8 ? 8 : height; }
    HWY_INLINE void append(const TriangleGroup& g, std::size_t k, const RegionPlace& place,
                           FragmentBatch& batch) const {
        const U32 d;
        const std::uint32_t rows = 16u >> log_width_;
        hn::Vec<U32> pixel[parts], xy[parts];
        for (std::size_t part = 0; part < parts; ++part) {
            const auto column = hn::Load(d, shape_.column + part * lanes), row = hn::Load(d, shape_.row + part * lanes);
            pixel[part] = hn::Add(hn::Set(d, place.row * place.width + place.column),
                                  hn::Add(column, hn::Mul(row, hn::Set(d, place.width))));
            xy[part] = hn::Add(hn::Set(d, g.x0[k] | g.y0[k] << 16), hn::Or(column, hn::ShiftLeft<16>(row)));
        }
        auto at = static_cast<std::size_t>(batch.count);
        const std::size_t end = at + static_cast<std::size_t>(pixels_);
        for (std::size_t i = at; i < end; i += lanes) hn::StoreU(hn::Set(d, place.primitive), d, &batch.primitive[i]);
        for (std::uint32_t b = 0; b < count(); ++b)
            for (std::size_t part = 0; part < parts; ++part) {
                const std::uint64_t kept = bits_[b / 4] >> (b % 4 * 16 + part * lanes) & ((1u << lanes) - 1);
                const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&kept);
                hn::StoreU(hn::CompressBits(pixel[part], bytes), d, &batch.pixel[at]);
                const auto both = hn::CompressBits(xy[part], bytes);
                hn::StoreU(hn::TruncateTo(U16{}, both), U16{}, &batch.x[at]);
                hn::StoreU(hn::TruncateTo(U16{}, hn::ShiftRight<16>(both)), U16{}, &batch.y[at]);
                at += static_cast<std::size_t>(std::popcount(kept));
                pixel[part] = hn::Add(pixel[part], hn::Set(d, rows * place.width));
                xy[part] = hn::Add(xy[part], hn::Set(d, rows << 16));
            }
        batch.count = static_cast<int>(end);
    }

  private:
    HWY_INLINE std::uint32_t count() const { return within_8 ? 4 : count_; }
    HWY_INLINE static std::uint32_t not_negative(hn::Vec<U32> v) {
        std::uint64_t bits = 0;
        const auto is = hn::Gt(hn::BitCast(I32{}, v), hn::Set(I32{}, -1));
        hn::StoreMaskBits(I32{}, is, reinterpret_cast<std::uint8_t*>(&bits));
        return static_cast<std::uint32_t>(bits);
    }

    std::uint32_t log_width_, count_;
    const BlockShape& shape_;
    int pixels_ = 0;
    std::uint64_t bits_[within_8 ? 1 : 4] = {};
};

template <bool within_8>
HWY_INLINE bool emit_blocks(const TriangleGroup& g, std::size_t k, const RegionPlace& place, PixelClaims& claims,
                            FragmentBatch& batch) {
    const Blocks<within_8> blocks{g, k};
    if (blocks.pixels() == 0) return true;
    if (batch.count + blocks.pixels() > usable_capacity ||
        !claims.claim_rows({place.row, place.column}, g.width[k], blocks.rows(g.height[k]),
                           [&](std::uint32_t row) HWY_ATTR { return blocks.row(row); }))
        return false;
    blocks.append(g, k, place, batch);
    return true;
}

bool emit(const TriangleGroup& g, std::size_t k, const RegionPlace& place, PixelClaims& claims,
          FragmentBatch& batch) noexcept {
    if (std::max(g.width[k], g.height[k]) <= 8) return emit_blocks<true>(g, k, place, claims, batch);
    return emit_blocks<false>(g, k, place, claims, batch);
}

}  // namespace

const SmallKernels* small_table() {
    static constexpr SmallKernels kernels{set_up, emit};
    return &kernels;
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::rasterizer {
HWY_EXPORT(small_table);

inline namespace strict {

const SmallKernels& small_kernels() noexcept {
    static constexpr SmallKernels twins{scalar::set_up_group, scalar::emit_small};
    return simd_is_scalar() ? twins : *HWY_DYNAMIC_DISPATCH(small_table)();
}

}  // namespace strict
}  // namespace strata::rasterizer
#endif
