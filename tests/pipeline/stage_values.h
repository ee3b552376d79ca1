// tests/pipeline/stage_values.h - random and special inputs for the stages, and a count of failures with a description
// of the first.
#pragma once
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "pipeline/device/state.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

using Random = std::mt19937_64;

[[nodiscard]] inline std::uint32_t below(Random& random, std::uint32_t n) {
    return static_cast<std::uint32_t>(random() % n);
}
[[nodiscard]] inline bool one_in(Random& random, std::uint32_t n) { return below(random, n) == 0; }
[[nodiscard]] inline std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }
[[nodiscard]] inline float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }
[[nodiscard]] inline bool is_nan(float x) { return (bits_of(x) & 0x7fffffffu) > 0x7f800000u; }

// Signed zeros, denormals, infinities, NaN with payloads (also signalling), limits, values around 1.
inline constexpr std::array<std::uint32_t, 30> hard_bits{
    0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007fffff, 0x807fffff, 0x00800000, 0x80800000,
    0x00800001, 0x33800000, 0x3effffff, 0x3f000000, 0x3f000001, 0x3f7fffff, 0x3f800000, 0xbf800000,
    0x3f800001, 0x40000000, 0x477fe000, 0x477ff000, 0x47800000, 0x7f7fffff, 0xff7fffff, 0x7f800000,
    0xff800000, 0x7f800001, 0xff800123, 0x7fc00000, 0xffc0beef, 0x7fffffff};

[[nodiscard]] inline float any_float(Random& random) {
    switch (below(random, 5)) {
        case 0: return float_of(hard_bits[below(random, static_cast<std::uint32_t>(hard_bits.size()))]);
        case 1: return float_of(static_cast<std::uint32_t>(random()));                             // any bits
        case 2: return static_cast<float>(below(random, 256)) / 255.0f;                            // a stored colour
        case 3: return static_cast<float>(2 * static_cast<int>(below(random, 256)) + 1) / 510.0f;  // near a tie
        default: return static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;                    // [0,1)
    }
}

[[nodiscard]] inline std::uint8_t any_byte(Random& random) { return static_cast<std::uint8_t>(below(random, 256)); }

template <class Enum>
[[nodiscard]] Enum any_of(Random& random, Enum last) {  // requires an enum that starts at 0
    return static_cast<Enum>(below(random, static_cast<std::uint32_t>(last) + 1));
}

// The eight functions as sets of outcomes, from the table of GL 2.1 4.1.4: which of a < b, a == b, a > b pass.
// Unordered operands count as "not equal" only.
[[nodiscard]] inline bool model_compare(CompareFunc func, double a, double b) {
    constexpr std::array<const char*, 8> passing{"", "<", "=", "<=", ">", "<>", ">=", "<=>?"};
    const char outcome = a < b ? '<' : a > b ? '>' : a == b ? '=' : '?';
    const std::string set = passing[static_cast<std::size_t>(func)];
    if (outcome == '?' && func == CompareFunc::notequal) return true;
    return set.find(outcome) != std::string::npos;
}

// Counts failures and keeps the description of the first.
class Tally {
  public:
    void expect(bool holds, const std::function<std::string()>& words) {
        ++cases_;
        if (!holds && wrong_++ == 0) first_ = words();
    }
    [[nodiscard]] std::uint64_t cases() const { return cases_; }
    [[nodiscard]] std::uint64_t wrong() const { return wrong_; }
    [[nodiscard]] const std::string& first() const { return first_; }

  private:
    std::uint64_t cases_ = 0, wrong_ = 0;
    std::string first_;
};

}  // namespace strata::pipeline
