// rasterizer/base/parallel.cpp - parallel loops (parallel.h) on oneTBB, or on thread_loop.h in builds without it.
#include "rasterizer/base/parallel.h"

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/simd.h"

#ifdef STRATA_HAS_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#else
#include <algorithm>
#include <thread>
#endif

#include "rasterizer/base/thread_loop.h"

namespace strata {

#ifdef STRATA_HAS_TBB
namespace {

// oneTBB starts its threads when a loop needs them. If the system refuses one, the process aborts or hangs at exit.
// Therefore the threads are first started as a trial (available_threads in thread_loop.h). After a refusal oneTBB is
// limited to the number that the system granted, and more are not requested again.
class Supply {
  public:
    // The number of threads to use: at most `threads`, at least 1, including the caller.
    int threads(int threads) {
        if (threads <= proven_.load(std::memory_order_acquire)) return threads;
        const std::lock_guard held{mutex_};
        if (!refused_ && threads > proven_) ask(threads);
        return std::min<int>(threads, proven_);
    }

    ThreadShortage shortage() {
        const std::lock_guard held{mutex_};
        return refused_ ? ThreadShortage{asked_, proven_} : ThreadShortage{};
    }

  private:
    void ask(int threads) {
        const std::size_t stack = tbb::global_control::active_value(tbb::global_control::thread_stack_size);
        const int workers = available_threads(threads - 1, stack);
        if (workers == threads - 1) return proven_.store(threads, std::memory_order_release);
        // One less than was granted: oneTBB needs memory of its own in addition to the stacks.
        const int available = std::max<int>(proven_, std::max(workers - 1, 0) + 1);
        asked_ = threads;
        refused_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(available));
        proven_.store(available, std::memory_order_release);
    }

    std::mutex mutex_;
    std::atomic<int> proven_ = 1;
    int asked_ = 0;
    std::optional<tbb::global_control> refused_;
};

Supply& supply() {
    static Supply& all = *new Supply;  // never destroyed: threads may outlive static objects
    return all;
}

int threads_of(int threads) { return supply().threads(threads); }

// One arena per calling thread and size, kept alive: when an arena is destroyed, its workers sleep, and waking one
// takes 50 microseconds.
tbb::task_arena& arena_of(int threads) {
    thread_local std::map<int, tbb::task_arena> arenas;
    return arenas.try_emplace(threads, threads).first->second;
}

void loop(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    // oneTBB limits itself to the number of processors and prints a warning to standard error if more threads are
    // requested; this raises the limit for the duration of the call.
    std::optional<tbb::global_control> allowed;
    if (threads > tbb::info::default_concurrency())
        allowed.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    LoopWork work{count, body};
    const std::size_t tasks = std::min(count, static_cast<std::size_t>(threads));
    arena_of(threads).execute([&] {
        tbb::parallel_for(
            std::size_t{0}, tasks, [&](std::size_t) { work.run(); }, tbb::simple_partitioner{});
    });
    work.rethrow();
}

}  // namespace

int thread_count(int threads) noexcept { return threads > 0 ? threads : tbb::info::default_concurrency(); }

ThreadShortage thread_shortage() noexcept { return supply().shortage(); }

#else

namespace {

// The thread sanitizer does not understand oneTBB, so its build uses thread_loop; the core-only build uses the plain
// loop.
constexpr bool has_threads =
#ifdef STRATA_HAS_THREADS
    true;
#else
    false;
#endif

int threads_of(int threads) { return has_threads ? threads : 1; }

void loop(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    thread_loop(count, threads, body);
}

}  // namespace

int thread_count(int threads) noexcept {
    if (!has_threads) return 1;
    return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ThreadShortage thread_shortage() noexcept { return {}; }

#endif

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    const std::function<void(std::size_t)> call = [&, simd = chosen_simd()](std::size_t i) {
        const FloatEnvironment ours;
        const SimdScope same{simd};
        body(i);
    };
    if (threads != 1 && count > 1)
        if (const int available = threads_of(thread_count(threads)); available > 1) return loop(count, available, call);
    for (std::size_t i = 0; i < count; ++i) call(i);
}

}  // namespace strata
