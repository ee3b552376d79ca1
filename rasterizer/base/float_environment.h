// rasterizer/base/float_environment.h - Strata's floating-point environment for the duration of a scope.
//
// Rule     Every public entry point and every worker thread computes with round to nearest even, denormals kept and
//          exceptions masked, whatever the host program has set, and restores the caller's environment.
// Source   rasterizer/reference/numbers.md 2.1; a library built with fast-math sets flush-to-zero when it is loaded.
// Tests    tests/rasterizer/base/float_environment_test.cpp
#pragma once
#include <cstdint>

namespace strata {

// Sets Strata's environment for the calling thread only and restores the previous one at the end of the scope. Each
// worker thread needs its own (parallel.h).
class FloatEnvironment {
  public:
    FloatEnvironment() noexcept;
    ~FloatEnvironment();
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

  private:
    // The caller's MXCSR on x86, FPCR on AArch64, rounding mode on other processors.
    std::uint64_t saved_;
};

}  // namespace strata
