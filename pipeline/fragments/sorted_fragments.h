// pipeline/fragments/sorted_fragments.h - the fragments of a store, every pixel's sorted by (key, arrival): where passes with a selection
// find what they keep.
//
// Rule     A fragment is a word of 64 bits: its key above, below it its place in the store, which rises with arrival. So one
//          comparison orders words by (key, arrival). Fragments that MASK killed have no word, nor have those that the request's
//          alpha test kills.
// Layout   Pixel after pixel, in one piece, a word of ones before the first and behind each that has fragments. Cursors remember where
//          bounds were: those of successive passes move by a few words, so finding the next takes a few comparisons.
// Numbers  17 bytes a fragment (33 by reference or by a compared depth) and 72 a pixel. No key is a NaN, and no stored code of a float buffer negative: else nothing is sorted.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/sorted_fragments_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/device/state.h"
#include "pipeline/fragments/earliest_index.h"
#include "pipeline/fragments/first_that.h"
#include "pipeline/fragments/fragment_store.h"
#include "pipeline/fragments/sort_arrivals.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/stages/depth_compare.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

// What is sorted by, and what is left out.
struct SortRequest {
    DepthKey key = DepthKey::stored_code;
    bool is_float = false;  // stored codes are bits of binary32
    AlphaTest alpha{};
    bool eight_bit_alpha = true;
    bool by_arrival = false;  // not sorted by key, and without those that do not lie before `surface`
    std::optional<DepthCompare>
        compared{};  // sorted by the depth that this compares; what is not before `surface` comes last
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
    // Whether every colour is in [0, 1024] and every alpha in [0, 1], none of them -0: MAX of such has no order. Of the store that
    // is sorted; looked at once.
    [[nodiscard]] bool has_plain_colors(const FragmentStore& store);
    [[nodiscard]] bool is_compared() const noexcept { return request_.compared.has_value(); }
    [[nodiscard]] const DepthCompare& compare() const noexcept { return *request_.compared; }

    [[nodiscard]] std::size_t pixels() const noexcept { return columns_.size(); }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
    [[nodiscard]] std::span<const std::uint64_t> of(std::size_t pixel) const noexcept {
        return {words_.data() + columns_[pixel].begin, columns_[pixel].size};
    }
    [[nodiscard]] std::span<const std::uint32_t> occupied() const noexcept { return occupied_; }  // pixels, ascending
    // The words of an occupied pixel's column, by its number among those.
    [[nodiscard]] std::span<const std::uint64_t> column(std::size_t number) const noexcept {
        return {words_.data() + begin_[number], begin_[number + 1] - begin_[number] - 1};
    }
    // As `column`, where a word is known to be there.
    [[nodiscard]] const std::uint64_t* column_begin(std::size_t number) const noexcept {
        return words_.data() + begin_[number];
    }
    // Of the columns from number `from` on, how many fragments have keys below their bounds, which may be 2^32. Cursors tell bounds
    // apart that are looked for in every pass: those of neighbouring passes are the same, or lie a fragment apart.
    enum class Cursor : std::uint8_t { low, high, surface };
    [[nodiscard]] std::span<const std::uint32_t> numbers_below(std::size_t from, std::span<const std::uint64_t> bounds,
                                                               Cursor which);
    // Asks memory for what `passing` looks up.
    void expect(std::size_t number, std::size_t pixel, std::uint32_t first) const noexcept {
        __builtin_prefetch(&columns_[pixel]);
        __builtin_prefetch(updates_.data() + begin_[number] + first);
    }
    // How many of the fragments [first, last) pass a depth test LESS with a write, as they arrive.
    [[nodiscard, gnu::always_inline]] inline std::uint32_t passing(std::size_t pixel, std::uint32_t first,
                                                                   std::uint32_t last) {
        if (first >= last) return 0;
        const Column& column = columns_[pixel];
        if (column.arrival == ColumnArrival::near_to_far) return 1;
        if (column.arrival == ColumnArrival::far_to_near) return last - first;
        if (column.updates_end != last) [[unlikely]]
            count_updates(pixel, last);
        return updates_[column.begin + first];
    }
    // The same of all `first` up to one `last`.
    struct Updates {
        const std::uint32_t* by_number;  // null where the column arrived in order
        std::uint32_t last, step;
        [[nodiscard]] std::uint32_t of(std::uint32_t first) const noexcept {
            return by_number != nullptr ? by_number[first] : step * (last - first - 1) + 1;
        }
    };
    [[nodiscard]] Updates updates(std::size_t pixel, std::uint32_t first, std::uint32_t last) {
        static_cast<void>(passing(pixel, first, last));
        const Column& column = columns_[pixel];
        return {column.arrival == ColumnArrival::mixed ? updates_.data() + column.begin : nullptr, last,
                column.arrival == ColumnArrival::far_to_near ? 1u : 0u};
    }
    // The one of [first, last) that passes `updates`-th there, 1 <= updates <= passing. The last is the nearest.
    [[nodiscard]] std::uint32_t update(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                       std::uint32_t updates);
    // How many of [first, last) arrived after that of number `word`, which passes there.
    [[nodiscard]] std::uint32_t arrived_after(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                              std::uint32_t word) {
        if (columns_[pixel].later_end != last) count_later(pixel, last);
        return word - first + later_[columns_[pixel].begin + word];
    }

    // Runs of coherent peels. `earliest` and what follows number words by all columns: a column begins at `begin`.
    [[nodiscard]] const EarliestIndex& earliest() {
        if (!earliest_.is_built()) earliest_.build(words_);
        return earliest_;
    }
    [[nodiscard]] std::size_t begin(std::size_t pixel) const noexcept { return columns_[pixel].begin; }
    [[nodiscard]] std::uint64_t word(std::size_t number) const noexcept { return words_[number]; }
    // Whether the pixel's fragments arrived in the order of their keys.
    [[nodiscard]] bool is_in_order(std::size_t pixel) const noexcept {
        return columns_[pixel].arrival == ColumnArrival::near_to_far;
    }
    // As `passing`, of any range: `last` need not be what it was in the pass before.
    [[nodiscard]] std::uint32_t passing_within(std::size_t pixel, std::uint32_t first, std::uint32_t last);
    // The same without the fragments `dead`, whose numbers rise: those that arrived first.
    [[nodiscard]] std::uint32_t passing_without(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                                std::span<const std::uint32_t> dead);

    // Of a request by compared depth and by values: a column's depths, rising; infinity for what is not before the surface.
    [[nodiscard]] std::span<const double> compared(std::size_t number) const noexcept {
        return {compared_.data() + begin_[number], begin_[number + 1] - begin_[number] - 1};
    }
    // The first number of a column whose depth `holds`, which is true from some depth on. Cursors tell such questions apart.
    template <class Holds>
    [[nodiscard]] std::uint32_t first_compared(std::size_t number, std::size_t cursor, const Holds& holds) {
        const auto depths = compared(number);
        std::uint32_t& at = compared_cursors_[cursor][number];
        return at = first_that(static_cast<std::uint32_t>(depths.size()), at,
                               [&](std::uint32_t k) { return holds(depths[k]); });
    }
    // Of the column's fragments [first, last), none of them hidden, the words of the least and of the greatest key.
    [[nodiscard]] std::array<std::uint64_t, 2> extremes(std::size_t number, std::uint32_t first,
                                                        std::uint32_t last) const noexcept;

    // Bytes that the present sorting takes.
    [[nodiscard]] std::uint64_t bytes() const noexcept { return state_ == State::sorted ? needed_bytes() : 0; }

    // Of a request by a compared depth and by stored codes: a column's fragments whose compared depth is greater than `bound`, before
    // `surface`, under the same test of their codes. `word` is (stored code, place) of the last that passes, if any does.
    struct Passing {
        std::uint64_t word;
        std::uint32_t passed;
        std::uint32_t inside;  // how many lie behind
    };
    [[nodiscard]] Passing passing_behind(std::size_t number, double bound, std::uint32_t surface) {
        if (surfaces_[number] != surface) [[unlikely]]
            count_stored_updates(number, surface);
        const Stored* const column = stored_.data() + begin_[number];
        const std::uint32_t size = begin_[number + 1] - begin_[number] - 1;
        // Nobody foretells where a bound lies: among few that is counted without a branch.
        std::uint32_t first = 0;
        for (std::uint32_t k = 0; k < few_stored; ++k) first += (k < size) & (column[k].compared <= bound);
        if (first == few_stored) [[unlikely]] {
            std::uint32_t& cursor = compared_cursors_[0][number];
            first = cursor = first_that(size, cursor, [=](std::uint32_t k) { return column[k].compared > bound; });
        }
        return {column[first].least, column[first].passed, size - first};
    }

  private:
    enum class State : std::uint8_t { empty, sorted, declined };

    [[nodiscard]] static std::uint32_t first_from(std::span<const std::uint64_t> words, std::uint64_t word,
                                                  std::uint32_t hint) noexcept;
    [[nodiscard]] std::uint64_t needed_bytes() const noexcept;
    [[nodiscard]] bool take(const FragmentStore& store, std::uint64_t limit, const std::uint32_t* surface);
    void place_columns();
    [[nodiscard]] bool sort_compared(const FragmentStore& store, const std::uint32_t* surface);
    [[nodiscard]] bool take_compared(const FragmentStore& store);
    void take_extremes();
    void end_columns();
    [[nodiscard]] double& own_depth(std::size_t word) noexcept {
        return request_.key == DepthKey::shader_z ? compared_[word] : stored_[word].compared;
    }
    [[nodiscard]] bool has_sortable_keys(const rasterizer::FragmentBatch& batch) const noexcept;
    void count_updates(std::size_t pixel, std::uint32_t last);
    void count_later(std::size_t pixel, std::uint32_t last);
    void count_stored_updates(std::size_t number, std::uint32_t surface);

    State state_ = State::empty;
    SortRequest request_;
    std::uint64_t rasterized_ = 0, masked_ = 0, alpha_killed_ = 0, hidden_ = 0;
    std::optional<bool> has_plain_colors_;
    UninitializedVector<std::uint64_t> words_;
    std::uint64_t size_ = 0;
    std::vector<std::uint32_t> occupied_;
    std::vector<std::uint32_t> begin_;  // by column, and where the next one would begin
    std::vector<std::uint32_t> next_;   // by pixel, while words come: how many, then where the next goes
    struct Cursors {
        std::vector<std::uint64_t> bounds;
        std::vector<std::uint32_t> cursors;
    };
    std::array<Cursors, 3> cursors_;  // by column
    struct Found {
        std::uint32_t bound = 0, at = 0;
    };
    // What passes look up at a pixel, together: the words from `begin` on.
    struct Column {
        std::uint32_t begin = 0, size = 0;
        std::uint32_t updates_end = 0;  // up to where updates_ and later_ are counted
        ColumnArrival arrival = ColumnArrival::near_to_far;
        std::uint32_t later_end = 0;
        Found update;
        std::uint32_t update_from = 0;
    };
    std::vector<Column> columns_;  // by pixel
    // By word: how many fragments pass from it on to `updates_end`, if every nearer one is peeled.
    UninitializedVector<std::uint32_t> updates_;
    UninitializedVector<std::uint32_t> later_;  // by word: how many behind it arrived after it, up to `later_end`
    EarliestIndex earliest_;                    // built for the first pass that asks
    std::vector<std::uint32_t> next_nearer_;    // of one column, while it is counted
    // Of a request by compared depth, by word: what is compared; where keys are values, the least of it and those behind, and the
    // greatest of it and those before. Cursors are by column.
    UninitializedVector<double> compared_;
    UninitializedVector<std::uint32_t> least_key_, greatest_key_;
    std::array<std::vector<std::uint32_t>, 4> compared_cursors_;
    // The same where keys are stored codes: what is compared, the least word of it and those behind, and how many of them pass before
    // the surface that their column was counted for. Together, for passes look them up together; none behind a column's last.
    struct Stored {
        double compared;
        std::uint64_t least;
        std::uint32_t passed;
    };
    static constexpr std::uint32_t few_stored = 4;  // so many more stand at the end
    UninitializedVector<Stored> stored_;
    std::vector<std::uint32_t> surfaces_;            // by column
    std::vector<std::uint64_t> by_code_, by_place_;  // of one column, while it is counted
    std::vector<std::uint32_t> reach_;
};

}  // namespace strata::pipeline
