#include "rasterizer/base/simd.h"

#include <algorithm>
#include <atomic>

#include "hwy/targets.h"

namespace strata {
namespace {

// Highway's bit for a set; 0 for `scalar`, whose loops do not ask Highway.
[[nodiscard]] std::int64_t target_of(Simd simd) noexcept {
    switch (simd) {
        case Simd::sse4: return HWY_SSE4;
        case Simd::avx2: return HWY_AVX2;
        case Simd::avx512: return HWY_AVX3;
        case Simd::scalar:
        case Simd::best: break;
    }
    return 0;
}

[[nodiscard]] Simd best_simd() { return available_simd().back(); }

// The one piece of process-wide state in the project, for no result depends on it.
std::atomic<Simd>& chosen() noexcept {
    static std::atomic<Simd> simd{best_simd()};
    return simd;
}

}  // namespace

std::vector<Simd> available_simd() {
    static const std::int64_t machine =
        hwy::SupportedTargets() & HWY_TARGETS;  // before any choice narrows what Highway sees
    std::vector<Simd> all{Simd::scalar};
    for (const Simd simd : {Simd::sse4, Simd::avx2, Simd::avx512})
        if ((machine & target_of(simd)) != 0) all.push_back(simd);
    return all;
}

bool choose_simd(Simd simd) {
    if (simd == Simd::best) simd = best_simd();
    const std::vector<Simd> available = available_simd();
    if (std::find(available.begin(), available.end(), simd) == available.end()) return false;
    // With `scalar` this is 0, which gives Highway all sets back: nothing dispatches while the twins run.
    hwy::SetSupportedTargetsForTest(target_of(simd));
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    chosen() = simd;
    return true;
}

Simd chosen_simd() noexcept { return chosen(); }

bool simd_is_scalar() noexcept { return chosen().load(std::memory_order_relaxed) == Simd::scalar; }

}  // namespace strata
