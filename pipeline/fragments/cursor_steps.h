// pipeline/fragments/cursor_steps.h - how many words of sorted columns lie below a bound, for all columns of a tile at once: from pass to pass
// bounds move by no word or by one.
//
// Rule     A word lies below a bound if its upper 32 bits do; all do below 2^32. Columns stand in one piece, a word of ones before the
//          first and behind each: so that looking past either end needs no test. No fragment's word is all ones.
// Tests    tests/pipeline/fragments/cursor_steps_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>

namespace strata::pipeline {

struct ColumnPlaces {
    const std::uint64_t* words;
    const std::uint32_t* begin;  // by column: where its words begin
    std::size_t count;
};

// From column `first` on, makes cursors[k] the number of column k's words below bounds[k], as long as that is what it was or one
// more. Returns the column where that ends, or one shortly before it; `count` if it nowhere does.
[[nodiscard]] std::size_t step_cursors(const ColumnPlaces& columns, const std::uint64_t* bounds, std::uint32_t* cursors,
                                       std::size_t first) noexcept;

namespace scalar {

[[nodiscard]] inline std::size_t step_cursors(const ColumnPlaces& columns, const std::uint64_t* bounds,
                                              std::uint32_t* cursors, std::size_t first) noexcept {
    for (std::size_t k = first; k < columns.count; ++k) {
        const std::uint64_t bound = bounds[k] > 0xffffffff ? ~std::uint64_t{0} : bounds[k] << 32;
        const std::uint64_t* const words = columns.words + columns.begin[k];
        std::uint32_t at = cursors[k];
        at += words[at] < bound ? 1 : 0;
        const std::uint64_t before =
            words[static_cast<std::ptrdiff_t>(at) - 1] + 1;  // 0 before the first word of a column
        if (words[at] < bound || before > bound) return k;
        cursors[k] = at;
    }
    return columns.count;
}

}  // namespace scalar
}  // namespace strata::pipeline
