// rasterizer/base/simd.h - selects the instruction set of the kernels. It affects speed only: every choice gives the
// same bits.
//
// Rule     A kernel is in a *_simd.cpp, which Highway compiles once per instruction set. Its meaning is defined by a
//          plain loop in a header, the scalar reference, which `scalar` selects. A kernel uses only operations that are
//          exact or correctly rounded on every instruction set: no fused multiply-add, no approximate reciprocal, no
//          horizontal float sum. NaN and -0 follow the scalar reference, not a processor's MIN and MAX instructions.
//          The choice belongs to a call, not to the process: a public entry point opens a SimdScope, as it opens a
//          FloatEnvironment, and parallel_for passes it to its workers. Highway's own choice for the host program is
//          neither changed nor read.
// Source   Highway's run-time dispatch; pipeline/reference/fragment-stages.md 9.3 (MIN and MAX).
// Tests    tests/rasterizer/base/simd_test.cpp, tests/peeling/execution/simd_test.cpp
#pragma once
#include <cstdint>
#include <vector>

namespace strata {

// In order of width. `scalar` is the scalar reference, `best` the widest set that the processor supports.
enum class Simd : std::uint8_t { scalar, avx2, avx512, best };

// The sets among the first three that this processor supports, in order of width; always includes `scalar`.
[[nodiscard]] std::vector<Simd> available_simd();
[[nodiscard]] bool has_simd(Simd simd);  // true for `best`

// While it exists, kernels called by this thread use `simd`, which the processor must support. Scopes nest.
class SimdScope {
  public:
    explicit SimdScope(Simd simd) noexcept;
    ~SimdScope();
    SimdScope(const SimdScope&) = delete;
    SimdScope& operator=(const SimdScope&) = delete;

  private:
    Simd before_;
};

// The instruction set that this thread uses; `best` is resolved to an actual set.
[[nodiscard]] Simd chosen_simd() noexcept;

// For kernels: true if the scalar reference is to be used.
[[nodiscard]] inline bool simd_is_scalar() noexcept { return chosen_simd() == Simd::scalar; }

}  // namespace strata
