#include "rasterizer/base/simd.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/base/simd_dispatch.h"

namespace strata {
namespace {

[[nodiscard]] Simd best_simd() noexcept {
    static const Simd best = available_simd().back();
    return best;
}

thread_local constinit Simd chosen = Simd::best;

}  // namespace

std::vector<Simd> available_simd() {
#if HWY_ARCH_X86
    static const std::int64_t machine = hwy::SupportedTargets() & HWY_TARGETS;
#else
    constexpr std::int64_t machine = 0;  // the names above are x86's: all other machines run the scalar twins
#endif
    std::vector<Simd> all{Simd::scalar};
    for (const Simd simd : {Simd::sse4, Simd::avx2, Simd::avx512})
        if ((machine & target_of(simd)) != 0) all.push_back(simd);
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
