// peeling/frame/stopwatch.h - adds the seconds of its scope to a sum. Used for statistics; no image depends on it.
#pragma once
#include <chrono>

namespace strata::peeling {

class Stopwatch {
  public:
    explicit Stopwatch(double& seconds) : seconds_{seconds}, start_{std::chrono::steady_clock::now()} {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace strata::peeling
