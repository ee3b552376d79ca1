// tools/oracle/program/fit/search.h - searches one more edit of a program that lowers the cost of a sample.
//
// Rule     In this order: every entry without a condition; entries with the conditions that solved pixels teach
//          (solve.h); entries with each condition of a table of thresholds, then with a second and a third one joined
//          to the best. An edit that is better at many pixels and worse at others may need a condition on pixels: the
//          best of these are kept apart and tried with those. This is done on a small sample, what follows on a large
//          one. Thresholds are walked and continuous parameters are fitted, then rounded to few digits if that
//          costs no more: a round number that fits is the best evidence there is.
// Numbers  Work is counted, so that a search ends at the same point on every computer.
// Tests    tests/tools/oracle/program/found_test.cpp
#pragma once
#include <limits>
#include <vector>

#include "tools/oracle/program/fit/solve.h"

namespace strata::oracle::program {

struct Trial {
    Edit edit{};
    double cost = 0;  // of the sample, with the price of the words
};

// The best edits of different kinds, cheapest first.
class Beam {
  public:
    explicit Beam(std::size_t most, std::size_t most_of_entry) : most_{most}, most_of_entry_{most_of_entry} {}
    void add(Trial trial);
    // What a trial must cost at most to be kept.
    [[nodiscard]] double limit() const noexcept { return limit_of(most_); }
    // The cost of the trial at this rank; infinite if there are fewer.
    [[nodiscard]] double limit_of(std::size_t rank) const noexcept {
        return trials_.size() < rank ? std::numeric_limits<double>::infinity() : trials_[rank - 1].cost;
    }
    [[nodiscard]] const std::vector<Trial>& trials() const noexcept { return trials_; }

  private:
    std::size_t most_, most_of_entry_;
    std::vector<Trial> trials_{};
};

// `few` and `many` pixels of the picture, as its base program leaves them.
[[nodiscard]] std::vector<Trial> best_edits(const FitSample& few, const FitSample& many,
                                            std::span<const PortRounding> roundings);

// The cost of an edit on a sample with its price: by differences, or by emulation. It knows the pixels that it has
// asked, as long as the entry and its parameters stay the same.
class Scorer {
  public:
    explicit Scorer(const FitSample& sample) : sample_{&sample} {}
    Scorer(const FitSample& sample, const Emulation& emulation) : sample_{&sample}, emulation_{&emulation} {}
    [[nodiscard]] const FitSample& sample() const noexcept { return *sample_; }
    // What costs more than `most` is not scored to the end.
    [[nodiscard]] double operator()(const Edit& edit, double most = std::numeric_limits<double>::infinity());

  private:
    const FitSample* sample_;
    const Emulation* emulation_ = nullptr;
    const StepEntry* entry_ = nullptr;
    std::vector<double> parameters_{};
    MaskNumbers numbers_{};
    KnownCosts known_{};
};

// Walks the thresholds of a trial's conditions over the values of the sample while that lowers the cost.
void walk_thresholds(Scorer& scorer, Trial& trial);
// Removes conditions without which the trial costs hardly more.
void drop_conditions(Scorer& scorer, Trial& trial);
// Tries every other condition in the place of each.
void exchange_conditions(Scorer& scorer, Trial& trial);
// Fits a continuous parameter, and rounds it.
void fit_parameter(Scorer& scorer, Trial& trial);
// Fits all parameters of an edit by damped Gauss-Newton with weights 1 / (1 + (r / 3)^2), and rounds them.
void fit_parameters(Scorer& scorer, Trial& trial);
// Solves a x = b for a symmetric matrix without negative eigenvalues, by elimination.
[[nodiscard]] std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b);
// The number with the fewest digits between two numbers.
[[nodiscard]] double shortest_between(double low, double high);

}  // namespace strata::oracle::program
