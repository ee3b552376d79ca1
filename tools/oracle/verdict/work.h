// tools/oracle/verdict/work.h - how much of a search is done: a count, so that it ends at the same point on every
// machine.
//
// Rule     A sequential part of a search counts its own steps and hands them over when it ends. Whether the work is
//          spent is asked between parts alone, or between batches of a fixed size, where the sum does not depend on
//          threads. Within a batch each rule stops at its share.
// Tests    tests/tools/oracle/verdict/work_test.cpp
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "rasterizer/base/parallel.h"

namespace strata::oracle::verdict {

class Work {
  public:
    void add(std::uint64_t steps) noexcept { done_.fetch_add(steps, std::memory_order_relaxed); }
    // Until so many more.
    void allow(std::uint64_t more) noexcept {
        allowed_ = more;
        most_ = done() + more;
    }
    [[nodiscard]] std::uint64_t done() const noexcept { return done_.load(std::memory_order_relaxed); }
    [[nodiscard]] bool is_spent() const noexcept { return done() >= most_; }
    [[nodiscard]] std::uint64_t most() const noexcept { return most_; }
    // A part stopped at its share.
    void leave_one() noexcept { has_left_one_.store(true, std::memory_order_relaxed); }
    // Not all was tried.
    [[nodiscard]] bool is_cut_short() const noexcept { return is_spent() || has_left_one_; }

    // What one rule of a batch may do: a whole batch of such rules overruns the work by a quarter, no more.
    [[nodiscard]] std::uint64_t share() const noexcept { return allowed_ / shares; }
    // `act` with each number below `count`, in parallel, until the work is spent.
    void for_each(std::size_t count, const auto& act) const {
        for (std::size_t first = 0; first < count && !is_spent(); first += batch)
            parallel_for(std::min(batch, count - first), 0, [&](std::size_t i) { act(first + i); });
    }

  private:
    static constexpr std::size_t batch = 8, shares = 32;

    std::atomic<std::uint64_t> done_{0};
    std::atomic<bool> has_left_one_{false};
    std::uint64_t allowed_ = ~std::uint64_t{0}, most_ = ~std::uint64_t{0};
};

// What one sequential part does: layers that are listed and layers that are composited.
class Steps {
  public:
    // `share`: so many steps, for a part of a batch.
    explicit Steps(Work& all, std::uint64_t share = ~std::uint64_t{0}) noexcept : all_{&all}, share_{share} {}
    Steps(const Steps&) = delete;
    Steps& operator=(const Steps&) = delete;
    ~Steps() { all_->add(count_); }
    void list(std::size_t layers) noexcept { count_ += layers + few; }
    void composite(std::size_t layers) noexcept { count_ += layers + few; }
    // The part has done its share and has to end.
    [[nodiscard]] bool is_over() const noexcept {
        if (count_ > share_) all_->leave_one();
        return count_ > share_;
    }
    // For a part beside which nothing runs.
    [[nodiscard]] bool is_spent() const noexcept { return all_->done() + count_ >= all_->most(); }

  private:
    static constexpr std::uint64_t few = 4;  // layers that take as long as a background and a result

    Work* all_;
    std::uint64_t share_, count_ = 0;
};

}  // namespace strata::oracle::verdict
