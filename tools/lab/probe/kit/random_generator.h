// tools/lab/probe/kit/random_generator.h - random numbers for the kit, computed with integers only, so that a kit has
// the same bits everywhere.
//
// Source   xorshift64* (Vigna 2016, "An experimental exploration of Marsaglia's xorshift generators, scrambled").
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <cstdint>

namespace strata::probe {

class RandomGenerator {
  public:
    explicit constexpr RandomGenerator(std::uint64_t seed) noexcept : state_{seed * 0x9e3779b97f4a7c15u + 1} {}
    constexpr std::uint32_t next() noexcept {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<std::uint32_t>((state_ * 0x2545f4914f6cdd1du) >> 32);
    }
    // 0 to count - 1.
    constexpr int below(int count) noexcept { return static_cast<int>(next() % static_cast<std::uint32_t>(count)); }
    // A multiple of 2^-16 in [0, 1).
    constexpr float unit() noexcept { return static_cast<float>(next() >> 16) * 0x1p-16f; }
    constexpr float between(float low, float high) noexcept { return low + (high - low) * unit(); }

  private:
    std::uint64_t state_;
};

}  // namespace strata::probe
