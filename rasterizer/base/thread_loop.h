// rasterizer/base/thread_loop.h - threads of the system itself: how many there are to be had, and a loop on them.
//
// Rule     A thread that the system refuses is no failure: the loop runs on those that there are, at last on the
//          caller.
// Tests    tests/rasterizer/base/parallel_test.cpp, tests/tools/system_faults_test.cpp
#pragma once
#include <cstddef>
#include <functional>

namespace strata {

// How many threads of `stack_bytes` the system gives at once, `wanted` at most. They are started, and end again.
[[nodiscard]] int threads_to_be_had(int wanted, std::size_t stack_bytes) noexcept;

// Calls body(i) for every i in [0, count) on `threads` threads with the caller, started here and joined here: what the
// thread sanitizer can follow. An exception of a body ends the loop and is rethrown.
void thread_loop(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace strata
