// tools/lab/sweep/sweep.h - runs the cells of a sweep in order, keeps what was measured before, merges shards.
//
// Rule     results.jsonl and results.csv depend on the plan alone: not on threads, shards, interruptions or time.
//          What a cell took stands in timings.jsonl and nowhere else. One run at a time writes to a shard's files.
// Tests    tests/tools/invariance_test.cpp
#pragma once
#include <functional>

#include "tools/lab/sweep/journal.h"
#include "tools/lab/sweep/shard.h"
#include "tools/strata/table.h"

namespace strata::tools {

// One measured cell. `line` begins with the cell's description, `timing` is what timings.jsonl says of it.
struct Measured {
    nlohmann::ordered_json line, timing;
    double seconds = 0;
};

// What a page says of all lines, above pictures and the table of the cells: a sentence, a table with its name, further
// sentences.
struct Findings {
    std::string sentence;
    Table table{};
    std::string name{};
    std::vector<std::string> items{};
};

// What a command measures. Cells are numbered from 0. A line has at least the keys `cell`, its number; `outcome`, the
// word "refused" or another; and `refusal`, the sentence.
struct Work {
    // The command's name, for the bar.
    std::string name;
    std::size_t cells = 0;
    // All keys that are known before the cell runs, `cell` first.
    std::function<nlohmann::ordered_json(std::size_t cell)> description;
    // The keys of a whole line.
    std::vector<std::string> keys;
    // Runs a cell, and writes its pictures if it has any.
    std::function<Measured(std::size_t cell)> measure;
    // The whole results.csv, and what people are told at the end, of all lines in the order of the cells.
    std::function<std::string(const Lines&)> csv, summary;
    // Cells of one text are taken to last equally long.
    std::function<std::string(std::size_t cell)> alike;
    // --report: a page with what was found, the table and the pictures of the folder; empty: none.
    std::string report{};
    std::function<Findings(const Lines&)> findings{};
    // What a picture of the folder shows, by its name in there.
    std::function<std::string(const std::string& name, const Lines&)> caption{};
};

// Measures what is missing of the shard's cells. The exit status: 0, or 2 if every cell of the sweep was refused.
[[nodiscard]] int run_sweep(const Work& work, const std::string& folder, const Shard& shard);

// Puts the files of `shards` shards together: results.jsonl, results.csv, timings.jsonl. InputError where one is not
// whole.
[[nodiscard]] int merge_shards(const Work& work, const std::string& folder, std::size_t shards);

// The shard's cells, one a line, and how long they would take: the first cell of each text of `alike` is measured now.
void dry_run(const Work& work, const Shard& shard);

}  // namespace strata::tools
