// pipeline/fragments/sorted_fragments.h - the fragments of a store, every pixel's sorted by (key, arrival): where passes with a selection
// find what they keep.
//
// Rule     A fragment is a word of 64 bits: its key above, below it its place in the store, which rises with arrival. So one
//          comparison orders words by (key, arrival). Fragments that MASK killed have no word, nor have those that the request's
//          alpha test kills.
// Layout   Pixel after pixel, in one piece. A finger remembers for each pixel which bound was looked for last, and where it is:
//          bounds of successive passes move by a few words, so finding the next takes a few comparisons, however long the column.
// Numbers  17 bytes a fragment (33 by reference) and 57 a pixel. No key is a NaN, and no stored code of a float buffer negative: else nothing is sorted.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/sorted_fragments_test.cpp
#pragma once
#include <cstdint>
#include <span>

#include "pipeline/device/state.h"
#include "pipeline/fragments/earliest_index.h"
#include "pipeline/fragments/fragment_store.h"
#include "pipeline/fragments/sort_arrivals.h"
#include "pipeline/frame/run_settings.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

// What is sorted by, and what is left out.
struct SortRequest {
    DepthKey key = DepthKey::stored_code;
    bool is_float = false;  // stored codes are bits of binary32
    AlphaTest alpha{};
    bool eight_bit_alpha = true;
    bool by_arrival = false;    // not sorted by key, and without those that do not lie before `surface`
    bool by_reference = false;  // sorted by the code that is compared; each has its stored code beside it
    std::vector<PrimitiveRange> primitives{};  // these alone, ascending and disjoint; empty: all
    friend bool operator==(const SortRequest&, const SortRequest&) = default;
};

class SortedFragments {
  public:
    // Sorts the fragments of a complete store, within `limit` bytes. False if that cannot be done. `surface`: codes, one a
    // pixel, for a request by arrival.
    [[nodiscard]] bool sort(const FragmentStore& store, const SortRequest& request, std::size_t pixels,
                            std::uint64_t limit, const std::uint32_t* surface = nullptr);
    void forget() noexcept { state_ = State::empty; }
    [[nodiscard]] bool serves(const SortRequest& request) const noexcept {
        return state_ == State::sorted && request_ == request;
    }
    [[nodiscard]] bool may_sort(const SortRequest& request) const noexcept {
        return state_ == State::empty || request_ != request;
    }

    [[nodiscard]] std::uint64_t rasterized() const noexcept { return rasterized_; }
    [[nodiscard]] std::uint64_t masked() const noexcept { return masked_; }              // killed by MASK
    [[nodiscard]] std::uint64_t alpha_killed() const noexcept { return alpha_killed_; }  // by the request's alpha test
    [[nodiscard]] std::uint64_t hidden() const noexcept { return hidden_; }              // not before the surface
    // Whether every colour is in [0, 1024] and every alpha in [0, 1], none of them -0: MAX of such has no order.
    [[nodiscard]] bool has_plain_colors() const noexcept { return has_plain_colors_; }
    [[nodiscard]] bool is_by_reference() const noexcept { return request_.by_reference; }
    // Whether the reference code is every fragment's stored one.
    [[nodiscard]] bool stores_reference() const noexcept { return stores_reference_; }

    [[nodiscard]] std::size_t pixels() const noexcept { return start_.size() - 1; }
    [[nodiscard]] std::uint64_t size() const noexcept { return start_.back(); }
    [[nodiscard]] std::span<const std::uint64_t> of(std::size_t pixel) const noexcept {
        return {words_.data() + start_[pixel], start_[pixel + 1] - start_[pixel]};
    }
    [[nodiscard]] std::span<const std::uint32_t> occupied() const noexcept { return occupied_; }  // pixels, ascending
    // The number of the pixel's fragments with keys below `bound`, which may be 2^32. `finger` tells bounds apart that
    // are looked for in every pass.
    enum class Finger : std::uint8_t { low, high, surface, update, update_from };
    [[nodiscard, gnu::always_inline]] inline std::uint32_t below(std::size_t pixel, std::uint64_t bound,
                                                                 Finger finger) noexcept {
        const std::uint32_t size = start_[pixel + 1] - start_[pixel];
        if (bound > 0xffffffff) return size;
        Found& last = finger_[static_cast<std::size_t>(finger)][pixel];
        if (last.bound == bound) return last.at;
        // Most bounds have moved by no word or by one.
        const std::uint64_t* const words = words_.data() + start_[pixel];
        const std::uint64_t word = bound << 32;
        std::uint32_t at = last.at;
        at += at < size && words[at] < word ? 1u : 0u;
        const bool is_there = (at == size || words[at] >= word) && (at == 0 || words[at - 1] < word);
        last = {static_cast<std::uint32_t>(bound), is_there ? at : first_from(of(pixel), word, at)};
        return last.at;
    }
    // Asks for the words at a pixel's finger, and what belongs to them, before they are looked at.
    void prefetch(std::size_t pixel, Finger finger) const noexcept {
        const std::size_t at = start_[pixel] + finger_[static_cast<std::size_t>(finger)][pixel].at;
        __builtin_prefetch(words_.data() + at);
        __builtin_prefetch(updates_.data() + at);
    }
    // How many of the fragments [first, last) pass a depth test LESS with a write, as they arrive.
    [[nodiscard]] std::uint32_t passing(std::size_t pixel, std::uint32_t first, std::uint32_t last) {
        if (first >= last) return 0;
        if (updates_end_[pixel] != last) count_updates(pixel, last);
        return updates_[start_[pixel] + first];
    }
    // The one of [first, last) that passes `updates`-th there, 1 <= updates <= passing. The last is the nearest.
    [[nodiscard]] std::uint32_t update(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                       std::uint32_t updates);
    // How many of [first, last) arrived after that of number `word`, which passes there.
    [[nodiscard]] std::uint32_t arrived_after(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                              std::uint32_t word) {
        if (later_end_[pixel] != last) count_later(pixel, last);
        return word - first + later_[start_[pixel] + word];
    }

    // Runs of coherent peels. `earliest` and what follows number words by all columns: a column begins at `begin`.
    [[nodiscard]] const EarliestIndex& earliest() {
        if (!earliest_.is_built()) earliest_.build(words_);
        return earliest_;
    }
    [[nodiscard]] std::size_t begin(std::size_t pixel) const noexcept { return start_[pixel]; }
    [[nodiscard]] std::uint64_t word(std::size_t number) const noexcept { return words_[number]; }
    // Whether the pixel's fragments arrived in the order of their keys.
    [[nodiscard]] bool is_in_order(std::size_t pixel) const noexcept {
        return arrival_[pixel] == ColumnArrival::near_to_far;
    }
    // As `passing`, of any range: `last` need not be what it was in the pass before.
    [[nodiscard]] std::uint32_t passing_within(std::size_t pixel, std::uint32_t first, std::uint32_t last);
    // The same without the fragments `dead`, whose numbers rise: those that arrived first.
    [[nodiscard]] std::uint32_t passing_without(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                                std::span<const std::uint32_t> dead);

    // Bytes that the present sorting takes.
    [[nodiscard]] std::uint64_t bytes() const noexcept { return state_ == State::sorted ? needed_bytes() : 0; }

    // Of a request by reference: the fragments from number `first` on, before `surface`, under the same test of their stored
    // codes. `word` is (stored code, place) of the last that passes; without one nothing passes.
    struct Passing {
        std::uint64_t word = 0;
        std::uint32_t passed = 0;
    };
    [[nodiscard]] Passing passing_stored(std::size_t pixel, std::uint32_t first, std::uint32_t surface);

  private:
    enum class State : std::uint8_t { empty, sorted, declined };

    [[nodiscard]] static std::uint32_t first_from(std::span<const std::uint64_t> words, std::uint64_t word,
                                                  std::uint32_t hint) noexcept;
    [[nodiscard]] std::uint64_t needed_bytes() const noexcept;
    [[nodiscard]] bool take(const FragmentStore& store, std::uint64_t limit, const std::uint32_t* surface);
    void take_stored(const FragmentStore& store);
    [[nodiscard]] bool has_sortable_keys(const rasterizer::FragmentBatch& batch) const noexcept;
    void look_at_values(const FragmentStore& store, const rasterizer::FragmentBatch& batch) noexcept;
    void count_updates(std::size_t pixel, std::uint32_t last);
    void count_later(std::size_t pixel, std::uint32_t last);
    void count_stored_updates(std::size_t pixel, std::uint32_t surface);

    State state_ = State::empty;
    SortRequest request_;
    std::uint64_t rasterized_ = 0, masked_ = 0, alpha_killed_ = 0, hidden_ = 0;
    bool has_plain_colors_ = false, stores_reference_ = false;
    UninitializedVector<std::uint64_t> words_;
    std::vector<std::uint32_t> start_ = std::vector<std::uint32_t>(1);  // by pixel, and the end of the last
    std::vector<std::uint32_t> occupied_;
    struct Found {
        std::uint32_t bound = 0, at = 0;
    };
    std::array<std::vector<Found>, 5> finger_;
    // By word: how many fragments pass from it on to `updates_end_`, if every nearer one is peeled.
    UninitializedVector<std::uint32_t> updates_;
    std::vector<std::uint32_t> updates_end_;    // by pixel; ~0: not counted yet
    UninitializedVector<std::uint32_t> later_;  // by word: how many behind it arrived after it, up to `later_end_`
    std::vector<std::uint32_t> later_end_;      // by pixel, as updates_end_
    std::vector<ColumnArrival> arrival_;        // by pixel
    EarliestIndex earliest_;                    // built for the first pass that asks
    std::vector<std::uint32_t> next_nearer_;    // of one column, while it is counted
    // Of a request by reference, by word: the fragment's own (stored code, place), and the least of it and those behind.
    UninitializedVector<std::uint64_t> stored_, least_stored_;
    std::vector<std::uint64_t> by_code_, by_place_;  // of one column, while it is counted
    std::vector<std::uint32_t> reach_;
};

}  // namespace strata::pipeline
