// tests/support/host_environment.h - sets a host program's floating-point environment for the lifetime of a scope.
#pragma once
#include <array>
#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace strata::testing {

#if defined(__SSE2__)

// MXCSR values with all exceptions masked: flush-to-zero with denormals-are-zero, the three other rounding modes, and
// both.
inline constexpr std::array<unsigned, 5> host_environments{0x9fc0, 0x3f80, 0x5f80, 0x7f80, 0xdfc0};

class HostEnvironment {
  public:
    explicit HostEnvironment(unsigned mxcsr) : saved_{_mm_getcsr()}, mxcsr_{mxcsr} { _mm_setcsr(mxcsr); }
    ~HostEnvironment() { _mm_setcsr(saved_); }
    HostEnvironment(const HostEnvironment&) = delete;
    HostEnvironment& operator=(const HostEnvironment&) = delete;
    [[nodiscard]] bool is_in_force() const { return (_mm_getcsr() & 0xffc0u) == mxcsr_; }  // ignores the sticky flags

  private:
    unsigned saved_, mxcsr_;
};

#else

inline constexpr std::array<unsigned, 3> host_environments{FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

class HostEnvironment {
  public:
    explicit HostEnvironment(unsigned rounding) : saved_{std::fegetround()}, rounding_{static_cast<int>(rounding)} {
        std::fesetround(rounding_);
    }
    ~HostEnvironment() { std::fesetround(saved_); }
    HostEnvironment(const HostEnvironment&) = delete;
    HostEnvironment& operator=(const HostEnvironment&) = delete;
    [[nodiscard]] bool is_in_force() const { return std::fegetround() == rounding_; }

  private:
    int saved_, rounding_;
};

#endif

}  // namespace strata::testing
