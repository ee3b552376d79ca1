// rasterizer/base/uninitialized.h - vectors whose new elements have no value yet: for many threads that write them all,
// each its part. Their memory is kept for the next frame when one is done with it: new pages take as long as to fill
// them.
#pragma once
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace strata {

// From oneTBB's allocator, which keeps what it gets back. Core-only and instrumented builds take the language's own.
// Throws std::bad_alloc.
[[nodiscard]] void* take_memory(std::size_t bytes);
void give_memory(void* memory) noexcept;

// For element types whose lifetime needs no constructor and no destructor.
// Reading an element before it is written gives whatever the memory held.
template <class T>
struct UninitializedAllocator {
    // Their lifetime begins with the memory's (C++20 [intro.object], implicit-lifetime types).
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

    // An element without arguments is left as it is: this is why resize() does not touch the memory.
    template <class U>
    void construct(U*) noexcept {}
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    friend bool operator==(const UninitializedAllocator&, const UninitializedAllocator&) = default;
};

// A vector of a given size, and resize(), leave new elements unset: their writer sets each before anybody reads it.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace strata
