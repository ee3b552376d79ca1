// rasterizer/base/uninitialized.cpp - memory for the vectors of uninitialized.h, from oneTBB's allocator or from
// operator new.
#include "rasterizer/base/uninitialized.h"

#include <cstdint>

#ifdef STRATA_HAS_TBB
#include <tbb/scalable_allocator.h>
#endif

namespace strata {

#ifdef STRATA_HAS_TBB
namespace {

// Blocks of at least kept_size bytes stay in the allocator for the next frame while its heap is at most most_kept
// bytes: for a million triangles, new pages took a third of a frame's time. This setting affects every user of oneTBB's
// allocator in the process.
constexpr std::intptr_t kept_size = std::intptr_t{1} << 20, most_kept = std::intptr_t{1} << 28;

[[nodiscard]] bool keep_large_blocks() noexcept {
    return scalable_allocation_mode(TBBMALLOC_SET_HUGE_SIZE_THRESHOLD, kept_size) == TBBMALLOC_OK &&
           scalable_allocation_mode(TBBMALLOC_SET_SOFT_HEAP_LIMIT, most_kept) == TBBMALLOC_OK;
}

}  // namespace
#endif

void* take_memory(std::size_t bytes) {
#ifdef STRATA_HAS_TBB
    [[maybe_unused]] static const bool keeps = keep_large_blocks();
    void* const memory = scalable_malloc(bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
#else
    return ::operator new(bytes);
#endif
}

void give_memory(void* memory) noexcept {
#ifdef STRATA_HAS_TBB
    scalable_free(memory);
#else
    ::operator delete(memory);
#endif
}

}  // namespace strata
