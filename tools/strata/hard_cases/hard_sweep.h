// tools/strata/hard_cases/hard_sweep.h - every chosen hard case by every algorithm on every device and depth format, line by line.
//
// Rule     results.jsonl holds a line a combination, in the order case, profile, depth format, algorithm; the last changes
//          fastest. A run that was ended goes on behind its last whole line. A shard takes every n-th (case, profile,
//          depth format) with all algorithms. Lines depend on neither threads, shards nor interruptions.
// Tests    tests/tools/hard_cases/hard_sweep_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/strata/hard_cases/hard_run.h"
#include "tools/strata/sweep/journal.h"
#include "tools/strata/sweep/shard.h"

namespace strata::tools {

struct HardSweep {
    std::vector<const scenes::HardCase*> cases;
    std::vector<pipeline::DeviceProfile> profiles;
    std::vector<pipeline::DepthFormat> formats;
    std::vector<const peeling::Algorithm*> algorithms;
    std::string folder;
    Shard shard;
};

// One line. The keys up to `algorithm` are known beforehand.
[[nodiscard]] nlohmann::ordered_json to_line(const HardSweep& sweep, std::size_t number, const HardRow& row);

// Runs what is missing of the shard, and answers all lines of it.
[[nodiscard]] Lines run_sweep(const HardSweep& sweep);
// The lines of all shards, once each of them has run; results.jsonl is written.
[[nodiscard]] Lines merge_shards(const HardSweep& sweep, std::size_t shards);

// A row a case, how many combinations of it have which verdict; then every combination that failed.
[[nodiscard]] std::string summary(const HardSweep& sweep, const Lines& lines);
// Whether one of them failed.
[[nodiscard]] bool has_failed(const Lines& lines);

}  // namespace strata::tools
