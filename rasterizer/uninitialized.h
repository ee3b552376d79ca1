// rasterizer/uninitialized.h - vectors whose new elements have no value yet: for many threads that write them all, each
// its part. To zero a frame's memory one after the other takes as long as two threads need to fill it.
#pragma once
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace strata {

template <class T>
struct UninitializedAllocator : std::allocator<T> {
    // Their lifetime begins with the memory's (C++20 [intro.object], implicit-lifetime types).
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    template <class U>
    struct rebind {
        using other = UninitializedAllocator<U>;
    };
    template <class U>
    void construct(U*) noexcept {}
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
};

template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace strata
