// rasterizer/base/simd_dispatch.h - finds a kernel in Highway's dispatch table for the instruction set of this thread.
// For *_simd.cpp only.
//
// Rule     STRATA_EXPORT(f) defines the table. HWY_DYNAMIC_DISPATCH would take the table index from a variable of the
//          process, which the host program shares; `kernel_of(HWY_DISPATCH_TABLE(f))` computes it by the same formula
//          from chosen_simd(). A build for one instruction set has a table of one entry.
#pragma once
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "rasterizer/base/simd.h"

// HWY_EXPORT without entry 0, which queries the processor through Highway's library: that library measures the clock
// for 4 ms when it is loaded, half of the start-up time of a command (Highway 1.0.3).
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define STRATA_EXPORT(f) HWY_EXPORT(f)
#else
#define STRATA_EXPORT(f)                                                                                  \
    static decltype(&HWY_STATIC_DISPATCH(f)) const HWY_DISPATCH_TABLE(f)[HWY_MAX_DYNAMIC_TARGETS + 2] = { \
        nullptr, HWY_CHOOSE_TARGET_LIST(f), HWY_CHOOSE_FALLBACK(f)}
#endif

namespace strata {

// Highway's bit for an instruction set; 0 for `scalar` and `best`, which chosen_simd() does not return.
[[nodiscard]] constexpr std::int64_t target_of(Simd simd) noexcept {
    switch (simd) {
        case Simd::avx2: return HWY_AVX2;
        case Simd::avx512: return HWY_AVX3;
        case Simd::scalar:
        case Simd::best: break;
    }
    return 0;
}

// The kernel for this thread's instruction set. Entry 0 of a table means that Highway has not chosen yet: its bit is
// masked out.
template <class Kernel, std::size_t count>
[[nodiscard]] Kernel kernel_of(Kernel const (&table)[count]) noexcept {
    if constexpr (count == 1) {
        return table[0];
    } else {
        const std::int64_t mask = (HWY_CHOSEN_TARGET_SHIFT(target_of(chosen_simd())) | HWY_CHOSEN_TARGET_MASK_SCALAR) &
                                  HWY_CHOSEN_TARGET_MASK_TARGETS;
        return table[hwy::Num0BitsBelowLS1Bit_Nonzero64(static_cast<std::uint64_t>(mask & ~std::int64_t{1}))];
    }
}

}  // namespace strata
