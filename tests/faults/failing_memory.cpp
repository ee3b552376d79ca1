// tests/faults/failing_memory.cpp - counts and fails the requests of operator new and of oneTBB's allocator
// (failing_memory.h).
#include "tests/faults/failing_memory.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> count = 0, failing = 0;
std::atomic<std::int64_t> held = 0;

// Returns null for the request that must fail.
void* take(std::size_t bytes, std::size_t alignment) noexcept {
    if (++count == failing.load()) return nullptr;
    const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
    void* const memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
    if (memory != nullptr) ++held;
    return memory;
}

void* take_or_throw(std::size_t bytes, std::size_t alignment) {
    void* const memory = take(bytes, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void give(void* memory) noexcept {
    if (memory != nullptr) --held;
    std::free(memory);
}

constexpr std::size_t usual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

namespace strata::test {

void fail_request(std::uint64_t n) noexcept {
    count = 0;
    failing = n;
}
std::uint64_t requests() noexcept { return count; }
std::int64_t blocks_held() noexcept { return held; }

}  // namespace strata::test

void* operator new(std::size_t bytes) { return take_or_throw(bytes, usual); }
void* operator new[](std::size_t bytes) { return take_or_throw(bytes, usual); }
void* operator new(std::size_t bytes, std::align_val_t to) { return take_or_throw(bytes, std::size_t(to)); }
void* operator new[](std::size_t bytes, std::align_val_t to) { return take_or_throw(bytes, std::size_t(to)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return take(bytes, usual); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return take(bytes, usual); }
void operator delete(void* memory) noexcept { give(memory); }
void operator delete[](void* memory) noexcept { give(memory); }
void operator delete(void* memory, std::size_t) noexcept { give(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { give(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { give(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { give(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { give(memory); }

// These definitions replace oneTBB's, from which uninitialized.cpp takes its memory.
extern "C" {
void* scalable_malloc(std::size_t bytes) { return take(bytes, usual); }
void scalable_free(void* memory) { give(memory); }
}
