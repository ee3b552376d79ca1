// rasterizer/base/split_mix.h - random numbers of sorts, procedural scenes and moves.
#pragma once
#include <cstdint>

namespace strata {

// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": uses only integers, so that
// they have the same bits everywhere, which the standard library's distributions do not guarantee.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) noexcept : state_{seed} {}
    std::uint64_t next() noexcept {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    // 0 to count - 1. The remainder favours small values by less than count / 2^64.
    int below(std::uint64_t count) noexcept { return static_cast<int>(next() % count); }
    float unit() noexcept { return static_cast<float>(next() >> 40) * 0x1p-24f; }  // 0 <= unit < 1, exact

  private:
    std::uint64_t state_;
};

}  // namespace strata
