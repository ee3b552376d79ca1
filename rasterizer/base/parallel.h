// rasterizer/base/parallel.h - the only access to threads: a wrapper around oneTBB, or a plain loop in the core-only
// build.
#pragma once
#include <cstddef>
#include <functional>

namespace strata {

// Calls body(i) for every i in [0, count) on up to `threads` threads (0: as many as the computer has processors), each
// call in its own FloatEnvironment and with the caller's instruction set (simd.h). Different calls must write to
// disjoint memory: no result may depend on which thread runs which index, or when. An exception from a body is rethrown
// here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

// The number of threads that the argument `threads` of parallel_for means.
[[nodiscard]] int thread_count(int threads) noexcept;

// Set if the system refused to start the `requested` threads that a loop requested: later loops of this process use
// `available` threads. Both are 0 if that never happened.
struct ThreadShortage {
    int requested = 0, available = 0;
};
[[nodiscard]] ThreadShortage thread_shortage() noexcept;

}  // namespace strata
