// tools/lab/sweep/shard.h - the part of a sweep that one process runs, and the names of its files.
//
// Rule     Shard i of n has the cells i, i + n, ... (from 1). A sweep in one shard has file names without a shard.
// Tests    tests/tools/sweep_journal_test.cpp
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// Shard `index` of `count`; the default is the whole sweep.
struct Shard {
    // From 1 to `count`.
    std::size_t index = 1, count = 1;
    // The cells of a sweep of `all` that belong to this shard, ascending. Cells are numbered from 0.
    [[nodiscard]] std::vector<std::size_t> cells(std::size_t all) const;
};

// "2/5" is shard 2 of 5. Empty for a text that is not I/N with I from 1 to N.
[[nodiscard]] std::optional<Shard> to_shard(std::string_view text);

// "results", "jsonl": results.jsonl, or results.2of5.jsonl.
[[nodiscard]] std::string shard_file(const std::string& folder, const std::string& stem, const Shard& shard);

}  // namespace strata::tools
