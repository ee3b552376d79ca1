// tools/strata/bench/bench_report.h - the times of `strata bench` as a table, as JSON, and beside an earlier run's.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/strata/bench/bench_jobs.h"

namespace strata::tools {

// Of one job's seconds.
struct Spread {
    double median = 0, least = 0, greatest = 0;
};
// Of at least one value; the median of an even number is the mean of the middle two.
[[nodiscard]] Spread spread_of(std::vector<double> values);

// Median seconds of an earlier run, by the words that name a job.
using Baseline = std::map<std::string, double>;
// Reads what --json wrote. Throws InputError where a file is missing, unreadable or of another
// kind.
[[nodiscard]] Baseline load_baseline(const std::string& path);

// The document of `strata bench --json` (reports.md 2).
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<BenchResult>& results, const Baseline& baseline);

// The jobs, what was refused, and with several executions these side by side.
[[nodiscard]] std::string to_table(const std::vector<BenchResult>& results);

// old / new, job by job, and the jobs that only one of the two runs has.
[[nodiscard]] std::string to_ratios(const std::vector<BenchResult>& results, const Baseline& baseline);

// Jobs whose picture differs from that of an earlier job with the same scene and algorithm: empty, or the emulator is
// wrong.
[[nodiscard]] std::vector<std::string> differing(const std::vector<BenchResult>& results);

}  // namespace strata::tools
