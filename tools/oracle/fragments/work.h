// tools/oracle/fragments/work.h - counts the steps of a search, so that it stops at the same point on every computer.
//
// Rule     A sequential part of a search counts its own steps and adds them to the total when it ends. The limit is
//          only checked between such parts, or between batches of a fixed size, when the total does not depend on
//          threads. Within a batch each rule stops at its share. Progress is shown by stages: within a stage by the
//          steps of its limit.
// Tests    tests/tools/oracle/fragments/work_test.cpp
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/show_progress.h"

namespace strata::oracle::verdict {

class WorkCounter {
  public:
    void add(std::uint64_t steps) {
        const std::uint64_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
        if (progress_ && allowed_ != no_limit) show(done);
    }
    void show_by(ShowProgress progress) { progress_ = std::move(progress); }
    // Begins the part of the progress from one share to another, between parallel parts.
    void begin_stage(double from, double to) {
        from_ = from;
        to_ = to;
        if (progress_) progress_(from);
    }
    // Removes all limits that were set before.
    void restart() noexcept {
        allowed_ = most_ = no_limit;
        has_left_one_ = false;
    }
    // Allows that many more steps.
    void allow(std::uint64_t more) noexcept {
        allowed_ = more;
        most_ = done() + more;
    }
    [[nodiscard]] std::uint64_t done() const noexcept { return done_.load(std::memory_order_relaxed); }
    [[nodiscard]] bool is_spent() const noexcept { return done() >= most_; }
    [[nodiscard]] std::uint64_t most() const noexcept { return most_; }
    // Records that a part stopped at its share.
    void leave_one() noexcept { has_left_one_.store(true, std::memory_order_relaxed); }
    // True if not everything was tried.
    [[nodiscard]] bool is_cut_short() const noexcept { return is_spent() || has_left_one_; }

    // The limit of one rule of a batch: a batch of such rules exceeds the total by at most a quarter.
    [[nodiscard]] std::uint64_t share() const noexcept { return allowed_ / shares; }
    // Calls act(i) for each i below `count`, in parallel, until the limit is reached.
    void for_each(std::size_t count, const auto& act) const {
        for (std::size_t first = 0; first < count && !is_spent(); first += batch)
            parallel_for(std::min(batch, count - first), 0, [&](std::size_t i) { act(first + i); });
    }

  private:
    static constexpr std::size_t batch = 8, shares = 32;
    static constexpr std::uint64_t no_limit = ~std::uint64_t{0};

    void show(std::uint64_t done) const {
        const double left = done < most_ ? static_cast<double>(most_ - done) / static_cast<double>(allowed_) : 0;
        progress_(to_ - (to_ - from_) * std::min(left, 1.0));
    }

    std::atomic<std::uint64_t> done_{0};
    std::atomic<bool> has_left_one_{false};
    std::uint64_t allowed_ = no_limit, most_ = no_limit;
    ShowProgress progress_{};
    double from_ = 0, to_ = 1;
};

// The steps of one sequential part: layers listed and layers composited.
class Steps {
  public:
    // `share`: the limit of this part.
    explicit Steps(WorkCounter& all, std::uint64_t share = ~std::uint64_t{0}) noexcept : all_{&all}, share_{share} {}
    Steps(const Steps&) = delete;
    Steps& operator=(const Steps&) = delete;
    ~Steps() { all_->add(count_); }
    void list(std::size_t layers) noexcept { count_ += layers + few; }
    void composite(std::size_t layers) noexcept { count_ += layers + few; }
    // True if the part has used its share and must end.
    [[nodiscard]] bool is_over() const noexcept {
        if (count_ > share_) all_->leave_one();
        return count_ > share_;
    }
    // Only for a part that runs alone.
    [[nodiscard]] bool is_spent() const noexcept { return all_->done() + count_ >= all_->most(); }

  private:
    static constexpr std::uint64_t few = 4;  // extra steps per list, for its background and its result

    WorkCounter* all_;
    std::uint64_t share_, count_ = 0;
};

}  // namespace strata::oracle::verdict
