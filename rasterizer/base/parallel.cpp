#include "rasterizer/base/parallel.h"

#include <map>
#include <optional>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/simd.h"

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
    // The core-only build has the plain loop alone.
    return 1;
#endif
}

#ifdef STRATA_HAS_TBB
namespace {

// Kept by every thread that asks: when an arena goes, its workers fall asleep, and one takes 50 microseconds to come back.
tbb::task_arena& arena_of(int threads) {
    thread_local std::map<int, tbb::task_arena> arenas;
    const int slots = threads > 0 ? threads : tbb::task_arena::automatic;
    return arenas.try_emplace(threads, slots).first->second;
}

}  // namespace
#endif

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    const auto call = [&, simd = chosen_simd()](std::size_t i) {
        const FloatEnvironment ours;
        const SimdScope same{simd};
        body(i);
    };
#ifdef STRATA_HAS_TBB
    if (threads != 1 && count > 1) {
        // oneTBB limits itself to the number of processors, and warns on standard error where more threads are asked
        // for; this raises the limit for the call.
        std::optional<tbb::global_control> allowed;
        if (threads > tbb::info::default_concurrency())
            allowed.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
        arena_of(threads).execute([&] { tbb::parallel_for(std::size_t{0}, count, call); });
        return;
    }
#endif
    static_cast<void>(threads);
    for (std::size_t i = 0; i < count; ++i) call(i);
}

}  // namespace strata
