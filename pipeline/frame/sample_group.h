// pipeline/frame/sample_group.h - lets the frames of a pixel's samples advance together, each on a thread of its own,
// so that a program of one sample can load what another has stored.
//
// Rule     The frames run the same body. They meet before and after every pass that loads by another rule than `own`,
//          after every step that an observer was told of, and at every query and limit: a query counts all samples, and
//          a limit holds when all have reached it. So all make the same steps, and the result does not depend on the
//          threads.
// Source   pipeline/reference/fragment-stages.md 13.5.
// Tests    tests/peeling/frame/sample_loads_test.cpp
#pragma once
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

namespace strata::pipeline {

class Targets;

class SampleGroup {
  public:
    // Thrown in the other frames where one has left with an exception.
    struct Abandoned {};

    explicit SampleGroup(int samples) : targets_(static_cast<std::size_t>(samples)) {}

    // Waits for all frames; the sum of their numbers.
    std::uint64_t sum(std::uint64_t own) {
        std::unique_lock held{mutex_};
        total_ += own;
        const std::uint64_t turn = turn_;
        if (++waiting_ == targets_.size()) {
            last_ = total_;
            total_ = waiting_ = 0;
            ++turn_;
            all_have_come_.notify_all();
        } else {
            all_have_come_.wait(held, [&] { return turn_ != turn || is_abandoned_; });
        }
        if (is_abandoned_) throw Abandoned{};
        return last_;
    }
    void meet() { static_cast<void>(sum(0)); }
    void abandon() {
        const std::lock_guard held{mutex_};
        is_abandoned_ = true;
        all_have_come_.notify_all();
    }

    // A frame's targets, which must exist until all have met for the last time.
    void set_targets(int sample, Targets& targets) { targets_[static_cast<std::size_t>(sample)] = &targets; }
    [[nodiscard]] Targets& targets(int sample) const { return *targets_[static_cast<std::size_t>(sample)]; }
    [[nodiscard]] int samples() const noexcept { return static_cast<int>(targets_.size()); }

  private:
    std::mutex mutex_;
    std::condition_variable all_have_come_;
    std::vector<Targets*> targets_;
    std::size_t waiting_ = 0;
    std::uint64_t total_ = 0, last_ = 0, turn_ = 0;
    bool is_abandoned_ = false;
};

}  // namespace strata::pipeline
