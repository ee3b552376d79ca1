#include "rasterizer/parallel.h"

#include <algorithm>

#include "rasterizer/float_environment.h"

#ifdef STRATA_HAS_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace strata {

int thread_count(int threads) noexcept {
#ifdef STRATA_HAS_TBB
    return threads > 0 ? threads : tbb::info::default_concurrency();
#else
    static_cast<void>(threads);
    return 1;
#endif
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    const auto call = [&](std::size_t i) {
        const FloatEnvironment ours;
        body(i);
    };
#ifdef STRATA_HAS_TBB
    if (threads != 1 && count > 1) {
        // More threads than processors are allowed, and without a word on standard error.
        const auto most = static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()));
        const tbb::global_control allowed{tbb::global_control::max_allowed_parallelism, most};
        tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
        arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, call); });
        return;
    }
#endif
    static_cast<void>(threads);
    for (std::size_t i = 0; i < count; ++i) call(i);
}

}  // namespace strata
