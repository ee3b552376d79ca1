// tools/lab/bench/bench_report.h - the times of `strata bench` as a table, as JSON, and compared with an earlier run's.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/bench/bench_jobs.h"
#include "tools/lab/bench/spread.h"

namespace strata::tools {

// The seconds of an earlier run, by the text that identifies a job.
using Baseline = std::map<std::string, Spread>;
// Reads a document of --json. Throws InputError if the file is missing, unreadable or of another kind.
[[nodiscard]] Baseline load_baseline(const std::string& path);

// The document of `strata bench --json` (scenes/reference/reports.md 2).
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<BenchResult>& results, const Baseline& baseline);

// The jobs, the refusals, and with several executions a comparison of these.
[[nodiscard]] std::string to_table(const std::vector<BenchResult>& results);

// old / new for each job whose times differ by more than the noise, and the jobs that only one of the two runs has.
[[nodiscard]] std::string to_ratios(const std::vector<BenchResult>& results, const Baseline& baseline);

// Jobs whose image differs from that of an earlier job with the same scene and algorithm. If it is not empty, the
// emulator has a bug.
[[nodiscard]] std::vector<std::string> differing(const std::vector<BenchResult>& results);

}  // namespace strata::tools
