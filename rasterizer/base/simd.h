// rasterizer/base/simd.h - which instruction set the kernels use. A matter of speed alone: every choice gives the same
// bits.
//
// Rule     A kernel lives in a *_simd.cpp that Highway compiles once an instruction set; its meaning is a plain loop in
//          a header, its scalar reference. `scalar` runs the scalar reference. Only operations that are exact or
//          correctly rounded on every set: no fused multiply-add, no approximate reciprocal, no horizontal float sum;
//          NaN and -0 go by the rules of the scalar reference, not by a machine's MIN and MAX. The choice belongs to a
//          call, not to the process: a public entry opens a SimdScope, as it opens a FloatEnvironment, and parallel_for
//          hands it to its workers. What Highway chooses for the host program is not changed, and no change of it is
//          looked at.
// Source   Highway's run-time dispatch; fragment-stages.md 9.3 (MIN and MAX).
// Tests    tests/rasterizer/base/simd_test.cpp, tests/peeling/simd_test.cpp
#pragma once
#include <cstdint>
#include <vector>

namespace strata {

// By rising width. `scalar` means the scalar reference, `best` the last one that the processor has.
enum class Simd : std::uint8_t { scalar, avx2, avx512, best };

// Those of the first three that this processor can run, by rising width; `scalar` is always there.
[[nodiscard]] std::vector<Simd> available_simd();
[[nodiscard]] bool has_simd(Simd simd);  // `best` is there, too

// While it lives, the kernels that this thread calls use `simd`, which the processor must have. Scopes nest.
class SimdScope {
  public:
    explicit SimdScope(Simd simd) noexcept;
    ~SimdScope();
    SimdScope(const SimdScope&) = delete;
    SimdScope& operator=(const SimdScope&) = delete;

  private:
    Simd before_;
};

// The set that this thread uses; never `best`, but the one that it stands for.
[[nodiscard]] Simd chosen_simd() noexcept;

// For kernels: take the scalar reference.
[[nodiscard]] inline bool simd_is_scalar() noexcept { return chosen_simd() == Simd::scalar; }

}  // namespace strata
