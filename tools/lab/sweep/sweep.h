// tools/lab/sweep/sweep.h - runs the cells of a sweep in order, keeps earlier results, merges shards.
//
// Rule     results.jsonl and results.csv depend on the plan alone: not on threads, shards, interruptions or time.
//          Times are only in timings.jsonl. One run at a time writes to a shard's files.
// Tests    tests/tools/invariance_test.cpp
#pragma once
#include <functional>

#include "tools/lab/sweep/journal.h"
#include "tools/lab/sweep/shard.h"
#include "tools/strata/table.h"

namespace strata::tools {

// One measured cell. `line` begins with the cell's description; `timing` is its line of timings.jsonl.
struct MeasuredCell {
    nlohmann::ordered_json line, timing;
    double seconds = 0;
};

// The text of a page about all lines, above the images and the table of the cells: a sentence, a table with its title,
// further sentences.
struct Findings {
    std::string lead;
    Table table{};
    std::string name{};
    std::vector<std::string> items{};
};

// The measurement of a command. Cells are numbered from 0. A line has at least the keys `cell`, its number; `outcome`,
// which is "refused" or another word; and `refusal`, the message.
struct Work {
    // The command's name, for the progress bar.
    std::string name;
    std::size_t cells = 0;
    // All keys that are known before the cell runs, `cell` first.
    std::function<nlohmann::ordered_json(std::size_t cell)> description;
    // The keys of a complete line.
    std::vector<std::string> keys;
    // Runs a cell, and writes its images if it has any.
    std::function<MeasuredCell(std::size_t cell)> measure;
    // The complete results.csv, and the summary printed at the end, from all lines in the order of the cells.
    std::function<std::string(const Lines&)> csv, summary;
    // Cells with the same text are assumed to take equally long.
    std::function<std::string(std::size_t cell)> timing_class;
    // --report: the file of a page with the findings, the table and the images of the folder; empty: none.
    std::string report{};
    std::function<Findings(const Lines&)> findings{};
    // The caption of an image of the folder, by its name there.
    std::function<std::string(const std::string& name, const Lines&)> caption{};
};

// Measures the missing cells of the shard. Returns the exit status: 0, or 2 if every cell of the sweep was refused.
[[nodiscard]] int run_sweep(const Work& work, const std::string& folder, const Shard& shard);

// Merges the files of `shards` shards: results.jsonl, results.csv, timings.jsonl. InputError if one is incomplete.
[[nodiscard]] int merge_shards(const Work& work, const std::string& folder, std::size_t shards);

// Prints the shard's cells, one per line, and an estimate of their time: the first cell of each text of `timing_class`
// is measured now.
void dry_run(const Work& work, const Shard& shard);

}  // namespace strata::tools
