// pipeline/fragments/sorted_lists.h - the fragments of a tile as per-pixel lists, sorted near to far, in which passes
// find the fragments that they need.
//
// Rule     A fragment is a 64-bit entry: key in the upper half, index in the lower. Indices are ascending in submission
//          order, so comparing entries orders them by key, then by submission. Fragments that the request's alpha test
//          kills have no entry.
// Layout   Blocks of sixteen adjacent pixels. Level k of a block is the k-th entry of each of them, ~0 past a pixel's
//          last.
// Numbers  8 bytes per entry, the same number of levels for each pixel of a block as its longest list, and 12 bytes per
//          pixel. Lists are sorted only if no key is a NaN and no stored code of a float buffer is negative.
// Source   pipeline/reference/execution.md 7.1.
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

// The sort key, and the fragments to leave out.
struct SortRequest {
    DepthKey key = DepthKey::stored_code;
    bool is_float = false;       // stored codes are bits of binary32
    bool by_submission = false;  // true: not by key; entries stay in submission order
    AlphaTest alpha{};
    bool eight_bit_alpha = true;
    std::vector<PrimitiveRange> primitives{};  // only these, ascending and disjoint; empty: all
    friend bool operator==(const SortRequest&, const SortRequest&) = default;
};

class SortedLists {
  public:
    // Sorts a complete record within `limit` bytes. Returns false if this is not possible. `surface` has one code per
    // pixel; fragments that are not in front of it are left out.
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
    // The levels of a block, and the number of entries of each of its pixels; 0 past the last pixel.
    [[nodiscard]] const std::uint64_t* levels(std::size_t block) const noexcept {
        return entries_.data() + begin_[block];
    }
    [[nodiscard]] std::uint32_t count(std::size_t pixel) const noexcept { return count_[pixel]; }
    // The entries of a pixel, near to far.
    class List {
      public:
        List(const std::uint64_t* first, std::uint32_t size) noexcept : first_{first}, size_{size} {}
        [[nodiscard]] std::uint32_t size() const noexcept { return size_; }
        [[nodiscard]] std::uint64_t operator[](std::uint32_t k) const noexcept { return first_[k * block_lanes]; }
        // The number of keys less than `key`, which may be 2^32. The search steps from entry `from`, because in
        // consecutive passes the results are equal or a few entries apart.
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
    // Where the interval of the previous pass began and ended at a pixel: the next search starts there.
    struct ListRange {
        std::uint32_t first = 0, last = 0;
    };
    [[nodiscard]] ListRange& previous_range(std::size_t pixel) noexcept { return previous_ranges_[pixel]; }

  private:
    enum class State : std::uint8_t { empty, sorted, declined };

    [[nodiscard]] bool has_order(const TileFragments& fragments) const;
    void choose(const TileFragments& fragments, const std::uint32_t* surface);
    void distribute_entries(const TileFragments& fragments, bool has_all);

    State state_ = State::empty;
    SortRequest request_;
    std::uint64_t size_ = 0;
    std::vector<std::uint32_t> begin_;        // by block, plus the end of the last block
    std::vector<std::uint32_t> count_;        // by pixel
    std::vector<ListRange> previous_ranges_;  // by pixel
    UninitializedVector<std::uint64_t> entries_;
    UninitializedVector<std::uint32_t> taken_;  // by index: ~0 or 0, while entries are added
};

}  // namespace strata::pipeline
