// rasterizer/coverage/pixel_claims.h - which pixels of a region are already in the current batch.
//
// Rule     A 64-bit word stores 32 pixels of a row: one bit per pixel in the low half, and the number of the batch to
//          which the bits belong in the high half. A new batch clears all of them by taking the next number.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp (no pixel twice in a batch)
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

class PixelClaims {
  public:
    explicit PixelClaims(const Rect& region)
        : words_a_row_{(static_cast<std::size_t>(region.width()) + 31) / 32},
          word_(words_a_row_ * static_cast<std::size_t>(region.height() + spare_rows)) {}

    void next_batch() {
        if (++batch_ != 0) return;
        std::ranges::fill(word_, std::uint64_t{0});  // the number wraps after 2^32 batches
        batch_ = 1;
    }

    // Claims `count` pixels of a row of the region, starting at `column`. Returns false, possibly with some of them
    // claimed, if the batch already contains one of them: the batch must then end.
    [[nodiscard]] bool claim(std::size_t row, unsigned column, unsigned count) noexcept {
        std::uint64_t* word = &word_[row * words_a_row_ + column / 32];
        for (column %= 32; count > 0; ++word, column = 0) {
            const unsigned here = std::min(count, 32 - column);
            const auto bits = static_cast<std::uint32_t>(((std::uint64_t{1} << here) - 1) << column);
            const std::uint32_t held = *word >> 32 == batch_ ? static_cast<std::uint32_t>(*word) : 0;
            if ((held & bits) != 0) return false;
            *word = std::uint64_t{batch_} << 32 | held | bits;
            count -= here;
        }
        return true;
    }

    struct Origin {
        std::size_t row, column;
    };
    // Claims the pixels whose bits `bits_of(row)` sets, bit 0 at the column of `from`, in `rows` rows of at most 16
    // pixels; returns false as above. Up to `spare_rows` of the rows may be below the region, without bits.
    template <class BitsOf>
    [[nodiscard, gnu::always_inline]] bool claim_rows(Origin from, unsigned width, unsigned rows,
                                                      const BitsOf& bits_of) noexcept {
        std::uint64_t* word = &word_[from.row * words_a_row_ + from.column / 32];
        const std::uint64_t number = std::uint64_t{batch_} << 32;
        const unsigned shift = from.column % 32;
        const bool crosses = shift + width > 32;
        std::uint64_t twice = 0;
        // Bits are written even if some are already set: the batch then ends, and its bits become invalid.
        const auto add = [&](std::uint64_t& to, std::uint32_t bits) {
            const std::uint64_t held = to >> 32 == batch_ ? to : number;
            twice |= held & bits;
            to = held | bits;
        };
        for (unsigned row = 0; row < rows; ++row, word += words_a_row_) {
            const std::uint64_t bits = std::uint64_t{bits_of(row)} << shift;
            add(word[0], static_cast<std::uint32_t>(bits));
            if (crosses) add(word[1], static_cast<std::uint32_t>(bits >> 32));
        }
        return twice == 0;
    }

  private:
    // Kernels claim small triangles in eight rows, whatever their height.
    static constexpr int spare_rows = 8;
    std::size_t words_a_row_;
    std::vector<std::uint64_t> word_;
    std::uint32_t batch_ = 0;
};

}  // namespace strata::rasterizer
