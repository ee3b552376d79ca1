// tools/strata/progress.h - a bar on standard error for work that takes a while. It writes no colours and no escape
// codes.
#pragma once
#include <chrono>
#include <mutex>
#include <string>

namespace strata::tools {

// Shows nothing unless standard error is a terminal and a second has passed; wipes its line when it goes.
class Progress {
  public:
    explicit Progress(std::string label);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    void show(double share);  // 0 to 1, from any thread

  private:
    std::string label_;
    bool is_terminal_;
    std::chrono::steady_clock::time_point start_;
    std::mutex mutex_;
    std::size_t shown_ = 0;  // characters on the line
    int percent_ = -1;
};

}  // namespace strata::tools
