// pipeline/fragments/sorted_lists.h - the fragments of a tile pixel by pixel, each pixel's near to far: where passes
// find what they keep.
//
// Rule     A fragment is an entry: its key above, below it its index, which rises with arrival. So one comparison
//          orders entries by (key, arrival). Fragments that the request's alpha test kills have no entry.
// Layout   Blocks of sixteen neighbouring pixels. Level k of a block holds the k-th entry of each of them, ~0 above a
//          pixel's last.
// Numbers  8 bytes an entry, as many for each pixel of a block as the tallest has, and 12 bytes a pixel. No key is a
//          NaN, and no stored code of a float buffer is negative: else nothing is sorted.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/sorted_lists_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/device/state.h"
#include "pipeline/fragments/sort_levels.h"
#include "pipeline/fragments/tile_fragments.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/vertices/primitive_range.h"

namespace strata::pipeline {

[[nodiscard]] constexpr std::uint32_t key_of(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry >> 32);
}
[[nodiscard]] constexpr std::uint32_t index_of(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry);
}

// What is sorted by, and what is left out.
struct SortRequest {
    DepthKey key = DepthKey::stored_code;
    bool is_float = false;       // stored codes are bits of binary32
    bool by_submission = false;  // not by key: entries stay in submission order
    AlphaTest alpha{};
    bool eight_bit_alpha = true;
    std::vector<PrimitiveRange> primitives{};  // these alone, ascending and disjoint; empty: all
    friend bool operator==(const SortRequest&, const SortRequest&) = default;
};

class SortedLists {
  public:
    // Sorts a complete record, within `limit` bytes. False if that cannot be done. `surface`: codes, one a pixel; what
    // does not lie before them is left out.
    [[nodiscard]] bool sort(const TileFragments& fragments, const SortRequest& request, std::size_t pixels,
                            std::uint64_t limit, const std::uint32_t* surface = nullptr);
    void forget() noexcept { state_ = State::empty; }
    [[nodiscard]] bool is_of(const SortRequest& request) const noexcept {
        return state_ != State::empty && request_ == request;
    }
    [[nodiscard]] bool is_sorted() const noexcept { return state_ == State::sorted; }
    [[nodiscard]] std::uint64_t bytes() const noexcept {
        return entries_.size() * sizeof(std::uint64_t) + 12 * count_.size();
    }

    [[nodiscard]] std::size_t pixels() const noexcept { return count_.size(); }
    [[nodiscard]] std::size_t blocks() const noexcept { return begin_.size() - 1; }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
    [[nodiscard]] std::uint32_t height(std::size_t block) const noexcept {
        return (begin_[block + 1] - begin_[block]) / block_lanes;
    }
    // The levels of a block, and how many entries each of its pixels has; beyond the last pixel none.
    [[nodiscard]] const std::uint64_t* levels(std::size_t block) const noexcept {
        return entries_.data() + begin_[block];
    }
    [[nodiscard]] std::uint32_t count(std::size_t pixel) const noexcept { return count_[pixel]; }
    // Entries of a pixel, near to far.
    class List {
      public:
        List(const std::uint64_t* first, std::uint32_t size) noexcept : first_{first}, size_{size} {}
        [[nodiscard]] std::uint32_t size() const noexcept { return size_; }
        [[nodiscard]] std::uint64_t operator[](std::uint32_t k) const noexcept { return first_[k * block_lanes]; }
        // How many keys lie below `key`, which may be 2^32: sought from number `from` on, step by step, for in
        // neighbouring passes answers are the same or few entries apart.
        [[nodiscard]] std::uint32_t below(std::uint64_t key, std::uint32_t from) const noexcept {
            while (from > 0 && (*this)[from - 1] >> 32 >= key) --from;
            while (from < size_ && (*this)[from] >> 32 < key) ++from;
            return from;
        }

      private:
        const std::uint64_t* first_;
        std::uint32_t size_;
    };
    [[nodiscard]] List list(std::size_t pixel) const noexcept {
        if (count_[pixel] == 0) return {nullptr, 0};
        return {entries_.data() + begin_[pixel / block_lanes] + pixel % block_lanes, count_[pixel]};
    }
    // Where intervals of the last pass began and ended at a pixel: where the next one's are sought from.
    struct Found {
        std::uint32_t first = 0, last = 0;
    };
    [[nodiscard]] Found& found(std::size_t pixel) noexcept { return found_[pixel]; }

  private:
    enum class State : std::uint8_t { empty, sorted, declined };

    [[nodiscard]] bool has_order(const TileFragments& fragments) const;
    void choose(const TileFragments& fragments, const std::uint32_t* surface);
    void place_words(const TileFragments& fragments);

    State state_ = State::empty;
    SortRequest request_;
    std::uint64_t size_ = 0;
    std::vector<std::uint32_t> begin_;  // by block, and where one more would begin
    std::vector<std::uint32_t> count_;  // by pixel
    std::vector<Found> found_;          // by pixel
    UninitializedVector<std::uint64_t> entries_;
    UninitializedVector<std::uint32_t> taken_;  // by index, ~0 or 0, while entries come
};

}  // namespace strata::pipeline
