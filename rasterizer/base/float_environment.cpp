// rasterizer/base/float_environment.cpp - sets and restores the floating-point control register of the calling thread
// (MXCSR on x86, FPCR on AArch64, the C library elsewhere), as float_environment.h declares.
#include "rasterizer/base/float_environment.h"

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace strata {

#if defined(__SSE2__)

// MXCSR: all exceptions masked, round to nearest even, neither flush-to-zero nor denormals-are-zero (Intel SDM volume
// 1, 10.2.3).
FloatEnvironment::FloatEnvironment() noexcept : saved_{_mm_getcsr()} { _mm_setcsr(0x1f80); }
FloatEnvironment::~FloatEnvironment() { _mm_setcsr(static_cast<unsigned>(saved_)); }

#elif defined(__aarch64__)

// FPCR = 0: round to nearest even, no flush-to-zero, no default NaN, no traps (Arm ARM, C5.2.8).
FloatEnvironment::FloatEnvironment() noexcept : saved_{0} {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{0}));
}
FloatEnvironment::~FloatEnvironment() { asm volatile("msr fpcr, %0" : : "r"(saved_)); }

#else

// On other processors the C library can only set the rounding mode: if the host flushes denormals there, they are still
// flushed.
FloatEnvironment::FloatEnvironment() noexcept : saved_{static_cast<std::uint64_t>(std::fegetround())} {
    std::fesetround(FE_TONEAREST);
}
FloatEnvironment::~FloatEnvironment() { std::fesetround(static_cast<int>(saved_)); }

#endif

}  // namespace strata
