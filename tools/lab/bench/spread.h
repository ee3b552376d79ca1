// tools/lab/bench/spread.h - the times of several runs of a job, and a test whether two jobs' times differ.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace strata::tools {

// Of a job's seconds, or of their ratios to another job's.
struct Spread {
    double median = 0, least = 0, greatest = 0;
    std::size_t runs = 0;
};

// Requires at least one value; the median of an even number is the mean of the middle two.
[[nodiscard]] inline Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    return {median, values.front(), values.back(), values.size()};
}

inline constexpr std::size_t least_runs = 4;  // required for comparing times

// True if two spreads differ by more than their noise: at least four runs of each, and every run of one is shorter than
// every run of the other. For jobs that take equally long this has a probability of at most 1/35: 2 of the 70 orders of
// four and four runs satisfy it.
[[nodiscard]] inline bool is_apart(const Spread& a, const Spread& b) noexcept {
    return std::min(a.runs, b.runs) >= least_runs && (a.greatest < b.least || b.greatest < a.least);
}

}  // namespace strata::tools
