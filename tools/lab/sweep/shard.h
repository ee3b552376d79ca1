// tools/lab/sweep/shard.h - the share of a sweep's rows that one process measures, and the names of its files.
//
// Rule     Shard K of N has the rows K, K + N, ... (from 1). Neighbouring rows take about equally long, so that shards
//          end at about the same time. A whole sweep has file names without a shard.
// Tests    tests/tools/lab/sweep/sweep_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// Shard `index` of `count`; the default is the whole sweep.
struct Shard {
    std::size_t index = 1, count = 1;  // `index` is from 1 to `count`
    // Ascending; rows are numbered from 0.
    [[nodiscard]] std::vector<std::size_t> rows(std::size_t all) const;
};

// "2/5" is shard 2 of 5. Empty for a text that is not K/N with K from 1 to N.
[[nodiscard]] std::optional<Shard> to_shard(std::string_view text);

// "results", ".jsonl": results.jsonl, or results.2of5.jsonl.
[[nodiscard]] std::string shard_file(const std::string& folder, const std::string& stem, const std::string& ending,
                                     const Shard& shard);

// Adds --shard K/N.
void add_shard_option(CLI::App& app, Shard& shard);

}  // namespace strata::tools
