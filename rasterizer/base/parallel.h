// rasterizer/base/parallel.h - the one door to threads: oneTBB behind a function of ours, a plain loop in the core-only
// build.
#pragma once
#include <cstddef>
#include <functional>

namespace strata {

// Calls body(i) for every i in [0, count), on up to `threads` threads (0: all that the machine has), each call in our
// own FloatEnvironment and with the caller's instruction set (simd.h). Bodies must write to places of their own: no
// result may depend on which thread runs which index or when. An exception from a body is rethrown here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

// How many threads `threads` stands for.
[[nodiscard]] int thread_count(int threads) noexcept;

// The system refused threads: loops of this process run on `had` from then on. Equal while it has refused none.
struct ThreadShortage {
    int asked = 0, had = 0;
};
[[nodiscard]] ThreadShortage thread_shortage() noexcept;

}  // namespace strata
