// tools/strata/progress.h - a bar on standard error for work that takes a while. It writes no colours and no escape
// codes.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace strata::tools {

enum class Remaining : std::uint8_t { hidden, shown };  // how much longer, if the rest goes like the part done

// Shows nothing unless standard error is a terminal and a second has passed; wipes its line when it goes.
class Progress {
  public:
    explicit Progress(std::string label, Remaining remaining = Remaining::hidden);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    void show(double share);  // 0 to 1, from any thread

  private:
    std::string label_;
    Remaining remaining_;
    bool is_terminal_;
    std::chrono::steady_clock::time_point start_;
    std::mutex mutex_;
    std::size_t shown_ = 0;  // characters on the line
    int percent_ = -1;
};

}  // namespace strata::tools
