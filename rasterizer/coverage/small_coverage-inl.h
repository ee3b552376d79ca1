// rasterizer/coverage/small_coverage-inl.h - the covered pixels of a small triangle as bits, in blocks of four rows of
// 4 pixels, two of 8 or one of 16. For *_simd.cpp only, like weights-inl.h. Its meaning is scalar::emit_small in
// small_triangles.h. Tests: tests/rasterizer/walk/tile_rasterizer_test.cpp
#include <bit>

#include "hwy/highway.h"
#include "rasterizer/coverage/small_triangles.h"

#if defined(STRATA_RASTERIZER_SMALL_COVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_SMALL_COVERAGE_INL_H
#undef STRATA_RASTERIZER_SMALL_COVERAGE_INL_H
#else
#define STRATA_RASTERIZER_SMALL_COVERAGE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Block32 = hn::CappedTag<std::uint32_t, 16>;
constexpr std::size_t block_part = hn::MaxLanes(Block32{}), block_parts = 16 / block_part;

// A block is 16 pixels: four rows of 4, two of 8 or one of 16, depending on the width of the box.
struct BlockShape {
    alignas(64) std::uint32_t column[16], row[16];
    std::uint32_t first_column;  // the bits of column 0
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

// The covered pixels of a small triangle as bits, one per pixel, block after block. `within_8` states that the box is
// within 8 x 8 pixels: four blocks, so that loops have a constant bound.
template <bool within_8>
class SmallCoverage {
  public:
    HWY_INLINE SmallCoverage(const TriangleGroup& g, std::size_t k)
        : log_width_{within_8 || (g.width[k] > 4 && g.width[k] <= 8) ? 3u : (g.width[k] <= 4 ? 2u : 4u)},
          count_{within_8 ? 4u : ((g.height[k] << log_width_) + 15) / 16},
          shape_{shapes[log_width_ - 2]} {
        const Block32 d;
        // Edge values at the 16 pixels of the first block, and their change from one block to the next.
        hn::Vec<Block32> edge[3][block_parts], down[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto value = hn::Set(d, g.value[i][k]), step = hn::Set(d, g.step[i][k]);
            const auto down_step = hn::Set(d, g.down[i][k]);
            for (std::size_t part = 0; part < block_parts; ++part)
                edge[i][part] = hn::Add(hn::Add(value, hn::Mul(hn::Load(d, shape_.column + part * block_part), step)),
                                        hn::Mul(hn::Load(d, shape_.row + part * block_part), down_step));
            down[i] = hn::Set(d, g.down[i][k] << (4 - log_width_));
        }
        // Columns outside the box have values that may have wrapped: their bits are cleared.
        const std::uint32_t in_box = ((1u << g.width[k]) - 1) * shape_.first_column;
        for (std::uint32_t b = 0; b < count(); ++b) {
            std::uint32_t covered = 0;
            for (std::size_t part = 0; part < block_parts; ++part) {
                // A pixel is covered if none of the three values has its sign bit set.
                covered |= not_negative(hn::Or(hn::Or(edge[0][part], edge[1][part]), edge[2][part]))
                           << part * block_part;
                for (std::size_t i = 0; i < 3; ++i) edge[i][part] = hn::Add(edge[i][part], down[i]);
            }
            bits_[b / 4] |= std::uint64_t{covered & in_box} << b % 4 * 16;
        }
        const std::uint32_t end = g.height[k] << log_width_;  // clears the rows below the box
        bits_[(end - 1) / 64] &= ~std::uint64_t{0} >> (64 - end) % 64;
        for (std::uint32_t word = 0; word < (count() + 3) / 4; ++word) pixels_ += std::popcount(bits_[word]);
    }
    // Of a triangle whose box is completely in the clip, from TriangleRecord::covered: rows of four bits.
    HWY_INLINE explicit SmallCoverage(std::uint32_t covered) : log_width_{3}, count_{4}, shape_{shapes[1]} {
        static_assert(within_8);
        const std::uint32_t pairs = (covered | covered << 8) & 0x00ff00ffu;
        bits_[0] = (pairs | pairs << 4) & 0x0f0f0f0fu;
        pixels_ = std::popcount(covered);
    }
    HWY_INLINE int pixels() const { return pixels_; }
    HWY_INLINE std::uint32_t row(std::uint32_t r) const {
        const std::uint32_t bit = r << log_width_;
        return static_cast<std::uint32_t>(bits_[bit / 64] >> bit % 64) & ((1u << (1u << log_width_)) - 1);
    }
    // Rows [first_row, end_row) include all covered pixels. Precondition: at least one pixel is covered.
    HWY_INLINE std::uint32_t first_row() const {
        return within_8 ? static_cast<std::uint32_t>(std::countr_zero(bits_[0])) / 8 : 0;
    }
    HWY_INLINE std::uint32_t end_row(std::uint32_t height) const {
        return within_8 ? 8 - static_cast<std::uint32_t>(std::countl_zero(bits_[0])) / 8 : height;
    }
    // Writes the index of each covered pixel, ascending: pixels() of them. `numbers` must have room for block_part
    // more.
    HWY_INLINE void write_numbers(std::uint32_t* numbers) const {
        if constexpr (within_8)
            if (pixels_ <= 8) {  // a few bits, one after the other
                for (std::uint64_t left = bits_[0]; left != 0; left &= left - 1)
                    *numbers++ = static_cast<std::uint32_t>(std::countr_zero(left));
                return;
            }
        const Block32 d;
        for (std::uint32_t first = 0; first < 16 * count(); first += block_part) {
            const std::uint64_t own = bits_[first / 64] >> first % 64 & ((1u << block_part) - 1);
            const auto covered = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&own));
            const auto number = hn::Add(hn::Load(d, shapes[2].column), hn::Set(d, first));
            hn::StoreU(hn::Compress(number, covered), d, numbers);
            numbers += std::popcount(own);
        }
    }
    // Column and row, within the box, of pixels given by their indices.
    template <class Vec>
    HWY_INLINE Vec column(Vec number) const {
        return hn::And(number, hn::Set(hn::DFromV<Vec>{}, (1u << log_width()) - 1));
    }
    template <class Vec>
    HWY_INLINE Vec row(Vec number) const {
        return hn::ShiftRightSame(number, static_cast<int>(log_width()));
    }
    // The number of rows to claim: those below the box are empty.
    HWY_INLINE std::uint32_t rows(std::uint32_t height) const { return within_8 ? 8 : height; }

  private:
    HWY_INLINE std::uint32_t log_width() const { return within_8 ? 3 : log_width_; }
    HWY_INLINE std::uint32_t count() const { return within_8 ? 4 : count_; }
    HWY_INLINE static std::uint32_t not_negative(hn::Vec<Block32> v) {
        const hn::RebindToSigned<Block32> d;
        std::uint64_t bits = 0;
        const auto is = hn::Gt(hn::BitCast(d, v), hn::Set(d, -1));
        hn::StoreMaskBits(d, is, reinterpret_cast<std::uint8_t*>(&bits));
        return static_cast<std::uint32_t>(bits);
    }

    std::uint32_t log_width_, count_;
    const BlockShape& shape_;
    int pixels_ = 0;
    std::uint64_t bits_[within_8 ? 1 : 4] = {};
};

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
