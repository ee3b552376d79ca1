// rasterizer/base/simd.cpp - which instruction sets the processor supports, and which one the calling thread uses
// (simd.h).
#include "rasterizer/base/simd.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/base/simd_dispatch.h"
#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace strata {
namespace {

#if HWY_ARCH_X86
// True if bit `bit` of ECX of CPUID leaf `leaf` is set: a feature that __builtin_cpu_supports has no name for.
[[nodiscard]] bool has_bit_of_ecx(unsigned leaf, unsigned bit) noexcept {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(leaf, &a, &b, &c, &d) != 0 && (c >> bit & 1) != 0;
}

// The instruction sets whose requirements, as Highway's code assumes them, the processor and the operating system's
// register saving meet (hwy/targets.cc).
[[nodiscard]] std::int64_t supported_targets() noexcept {
    __builtin_cpu_init();
    const bool has_f16c = has_bit_of_ecx(1, 29), has_lzcnt = has_bit_of_ecx(0x80000001, 5);
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("aes") &&
                      __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && has_f16c && has_lzcnt;
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512cd");
    return (avx2 ? HWY_AVX2 : 0) | (avx512 ? HWY_AVX3 : 0);
}
#endif

[[nodiscard]] Simd best_simd() noexcept {
    static const Simd best = available_simd().back();
    return best;
}

thread_local constinit Simd chosen = Simd::best;

}  // namespace

std::vector<Simd> available_simd() {
#if HWY_ARCH_X86
    static const std::int64_t processor = supported_targets() & HWY_TARGETS;
#else
    constexpr std::int64_t processor =
        0;  // the names above are those of x86: other processors run the scalar reference
#endif
    std::vector<Simd> all{Simd::scalar};
    for (const Simd simd : {Simd::avx2, Simd::avx512})
        if ((processor & target_of(simd)) != 0) all.push_back(simd);
    return all;
}

bool has_simd(Simd simd) {
    const std::vector<Simd> available = available_simd();
    return simd == Simd::best || std::find(available.begin(), available.end(), simd) != available.end();
}

SimdScope::SimdScope(Simd simd) noexcept : before_{chosen} {
    assert(has_simd(simd) && "an instruction set that the processor lacks");
    chosen = simd;
}

SimdScope::~SimdScope() { chosen = before_; }

Simd chosen_simd() noexcept { return chosen == Simd::best ? best_simd() : chosen; }

}  // namespace strata
