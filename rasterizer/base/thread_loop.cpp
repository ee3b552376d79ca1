// rasterizer/base/thread_loop.cpp - parallel loops on POSIX threads (thread_loop.h).
#include "rasterizer/base/thread_loop.h"

#include <pthread.h>

#include <system_error>
#include <thread>
#include <vector>

namespace strata {

namespace {

// Threads wait for the mutex `gate`, so that all of them exist at the same time.
void* wait_at(void* gate) {
    const std::lock_guard held{*static_cast<std::mutex*>(gate)};
    return nullptr;
}

}  // namespace

int available_threads(int wanted, std::size_t stack_bytes) noexcept try {
    std::vector<pthread_t> threads;
    threads.reserve(static_cast<std::size_t>(wanted));
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return 0;
    pthread_attr_setstacksize(&attributes, stack_bytes);
    std::mutex gate;
    {
        const std::lock_guard shut{gate};
        for (pthread_t one{}; static_cast<int>(threads.size()) < wanted; threads.push_back(one))
            if (pthread_create(&one, &attributes, wait_at, &gate) != 0) break;
    }
    for (const pthread_t thread : threads) pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    return static_cast<int>(threads.size());
} catch (const std::exception&) {  // no memory for the list of threads
    return 0;
}

void LoopWork::run() noexcept try {
    for (std::size_t i = next_++; i < count_; i = next_++) body_(i);
} catch (...) {
    const std::lock_guard held{mutex_};
    if (!failure_) failure_ = std::current_exception();
    next_ = count_;
}

void LoopWork::rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
}

void thread_loop(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    LoopWork work{count, body};
    std::vector<std::thread> others;
    try {
        for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i)
            others.emplace_back([&] { work.run(); });
    } catch (const std::exception&) {  // the system refuses a thread or its memory; if the exception escaped, the
                                       // running threads would end the program
    }
    work.run();
    for (std::thread& other : others) other.join();
    work.rethrow();
}

}  // namespace strata
