// tools/strata/progress.h - a progress bar on standard error, without colours and escape codes.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace strata::tools {

// Whether the line shows the remaining time, extrapolated from the finished part.
enum class Remaining : std::uint8_t { hidden, shown };

// A progress bar for one task, with the lifetime of the object. It is shown only if standard error is a terminal, a
// second has passed, and --quiet is not given; the destructor wipes it. Under -v the destructor prints the time that
// the task took.
class Progress {
  public:
    explicit Progress(std::string label, Remaining remaining = Remaining::hidden);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    // `share` is the finished fraction, 0 to 1. May be called from any thread.
    void show(double share);

  private:
    std::string label_;
    Remaining remaining_;
    bool is_shown_;
    std::chrono::steady_clock::time_point start_;
    std::mutex mutex_;
    // The number of characters on the line that must be wiped.
    std::size_t shown_ = 0;
    int percent_ = -1;
};

}  // namespace strata::tools
