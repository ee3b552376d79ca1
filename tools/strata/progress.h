// tools/strata/progress.h - a bar on standard error for work that takes a while. It writes no colours and no escape
// codes.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace strata::tools {

// Whether the line tells how much longer it takes, if the rest goes like the part that is done.
enum class Remaining : std::uint8_t { hidden, shown };

// A bar for one piece of work, which lasts as long as the object. It shows nothing unless standard error is a terminal,
// a second has passed and --quiet was not given, and wipes its line when it ends. Under -v the end tells how long the
// work took.
class Progress {
  public:
    explicit Progress(std::string label, Remaining remaining = Remaining::hidden);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    // `share` is the part that is done, 0 to 1; it may be called from any thread.
    void show(double share);

  private:
    std::string label_;
    Remaining remaining_;
    bool is_shown_;
    std::chrono::steady_clock::time_point start_;
    std::mutex mutex_;
    // Characters on the line: what must be wiped.
    std::size_t shown_ = 0;
    int percent_ = -1;
};

}  // namespace strata::tools
