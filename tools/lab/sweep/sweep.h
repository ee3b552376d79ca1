// tools/lab/sweep/sweep.h - measures the rows of a sweep, or those of one shard, and writes them to a folder.
//
// Rule     results.jsonl and results.csv have one row for each number. They depend on the command alone: not on
//          threads, shards or time. Times are only in timings.jsonl. The files are written when all rows are measured,
//          so that an interrupted process leaves none; tools/cluster repeats the shards that did not end, and joins
//          the others.
// Tests    tests/tools/lab/sweep/sweep_test.cpp, tests/tools/lab/sweep/cluster_test.py
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/sweep/shard.h"

namespace strata::tools {

using Lines = std::vector<nlohmann::ordered_json>;

// A measured row: `line` has at least the keys `outcome`, which is "refused" or another word, and `refusal`, the
// message. `timing` is its line of timings.jsonl.
struct MeasuredRow {
    nlohmann::ordered_json line, timing;
    double seconds = 0;
};

struct Sweep {
    std::string name;  // of the progress bar
    std::size_t rows = 0;
    // The settings of a row, for --dry-run.
    std::function<nlohmann::ordered_json(std::size_t row)> description;
    // Measures a row, and writes its pictures if it has any.
    std::function<MeasuredRow(std::size_t row)> measure;
    // The content of results.csv.
    std::function<std::string(const Lines& lines)> csv;
    // The text that is printed; timings[i] belongs to lines[i].
    std::function<std::string(const Lines& lines, const Lines& timings)> summary;
    // Rows with the same text are assumed to take equally long, for --dry-run.
    std::function<std::string(std::size_t row)> timing_class;
    // True if a row shows a fault, which makes the exit status 1; empty: no row does.
    std::function<bool(const Lines&)> has_failed{};
};

// The value as JSON on one line; bytes that are not UTF-8, which a file name may contain, are replaced.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

// Writes the files, unless `folder` is empty. Prints the summary, or, of a shard, where its rows are. Returns the exit
// status: 0; 1 if has_failed says so; 2 if every row was refused.
[[nodiscard]] int run_sweep(const Sweep& sweep, const std::string& folder, const Shard& shard);

// Prints the settings of the shard's rows and an estimate of their time, for which it measures the first row of each
// timing class.
void dry_run(const Sweep& sweep, const Shard& shard);

}  // namespace strata::tools
