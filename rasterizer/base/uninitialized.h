// rasterizer/base/uninitialized.h - vectors whose new elements are left uninitialized, for data that several threads
// fill completely. Freed memory is kept for the next frame, because touching new pages takes as long as filling them.
#pragma once
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace strata {

// Memory from oneTBB's allocator, which keeps freed blocks. Core-only and instrumented builds use operator new. Throws
// std::bad_alloc.
[[nodiscard]] void* take_memory(std::size_t bytes);
void give_memory(void* memory) noexcept;

// An allocator for element types that need neither constructor nor destructor. An element that has not been written has
// an unspecified value.
template <class T>
struct UninitializedAllocator {
    // The lifetime of the elements begins with that of the memory (C++20 [intro.object], implicit-lifetime types).
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    using value_type = T;

    UninitializedAllocator() = default;
    template <class U>
    UninitializedAllocator(const UninitializedAllocator<U>&) noexcept {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        return static_cast<T*>(take_memory(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t) noexcept { give_memory(memory); }

    // An element without arguments is not initialized, so resize() does not touch the memory.
    template <class U>
    void construct(U*) noexcept {}
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    friend bool operator==(const UninitializedAllocator&, const UninitializedAllocator&) = default;
};

// The sized constructor and resize() leave new elements uninitialized: each must be written before it is read.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace strata
