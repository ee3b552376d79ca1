#include "rasterizer/base/uninitialized.h"

#ifdef STRATA_HAS_TBB
#include <tbb/scalable_allocator.h>
#endif

namespace strata {

void* take_memory(std::size_t bytes) {
#ifdef STRATA_HAS_TBB
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
