// rasterizer/base/simd.h - which instruction set the kernels use. A matter of speed alone: every choice gives the same bits.
//
// Rule     A kernel lives in a *_simd.cpp that Highway compiles once an instruction set; its meaning is a plain loop in a
//          header, its scalar twin. `scalar` runs the twins. Only operations that are exact or correctly rounded on every
//          set: no fused multiply-add, no approximate reciprocal, no horizontal float sum; NaN and -0 go by the rules of
//          the twins, not by a machine's MIN and MAX.
// Source   Highway's run-time dispatch; fragment-stages.md 9.3 (MIN and MAX).
// Tests    tests/rasterizer/base/simd_test.cpp
#pragma once
#include <cstdint>
#include <vector>

namespace strata {

// By rising width. `scalar` means the twins, `best` the last one that the processor has.
enum class Simd : std::uint8_t { scalar, sse4, avx2, avx512, best };

// What this processor has of the first four, in that order; `scalar` is always there.
[[nodiscard]] std::vector<Simd> available_simd();

// From now on the whole process uses `simd`. Returns false, and changes nothing, if the processor lacks it.
// Not while a frame is being rendered.
bool choose_simd(Simd simd);
// The set in use; never `best`, but the one that it stood for.
[[nodiscard]] Simd chosen_simd() noexcept;

// For kernels: take the scalar twin.
[[nodiscard]] bool simd_is_scalar() noexcept;

}  // namespace strata
