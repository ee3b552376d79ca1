// rasterizer/base/float_environment.h - our own floating-point environment for the length of a scope.
//
// Rule     Every public entry and every worker of ours computes with round to nearest even, denormals kept, exceptions
//          masked, whatever the host program has set, and gives the caller's environment back.
// Source   numbers.md 2.1; a library built with fast-math sets flush-to-zero when it is loaded.
// Tests    tests/rasterizer/base/float_environment_test.cpp
#pragma once
#include <cstdint>

namespace strata {

// Sets our environment for the calling thread alone and restores the saved one at the end of the scope. A worker
// thread needs one of its own (parallel.h).
class FloatEnvironment {
  public:
    FloatEnvironment() noexcept;
    ~FloatEnvironment();
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

  private:
    // The caller's MXCSR on x86, FPCR on AArch64, rounding mode elsewhere.
    std::uint64_t saved_;
};

}  // namespace strata
