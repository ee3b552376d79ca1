// rasterizer/base/thread_loop.h - system threads without oneTBB: how many can be started, and a parallel loop.
//
// Rule     It is not an error if the system refuses a thread: the loop runs on the threads that could be started, at
//          worst on the caller alone.
// Tests    tests/rasterizer/base/parallel_test.cpp, tests/tools/strata/program/system_faults_test.cpp
#pragma once
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace strata {

// The number of threads with stacks of `stack_bytes` that can run at the same time, at most `wanted`. Starts them and
// joins them.
[[nodiscard]] int available_threads(int wanted, std::size_t stack_bytes) noexcept;

// The work of a parallel loop, which any number of threads may share.
class LoopWork {
  public:
    LoopWork(std::size_t count, const std::function<void(std::size_t)>& body) noexcept : count_{count}, body_{body} {}
    // Calls body(i) for the next i until none is left. An exception ends the loop and is kept: oneTBB needs memory to
    // pass one on, and ends the process if there is none.
    void run() noexcept;
    // Throws the first exception, if there was one. Only after all threads have ended.
    void rethrow() const;

  private:
    std::size_t count_;
    const std::function<void(std::size_t)>& body_;
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr failure_;
};

// Calls body(i) for every i in [0, count) on `threads` threads including the caller; the others are started and joined
// here, so that the thread sanitizer can follow them. An exception from a body ends the loop and is rethrown.
void thread_loop(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace strata
