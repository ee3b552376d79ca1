// rasterizer/chip/truncated_weights.h - the weights of NV2A's interpolator: edge values times a reciprocal, both
// truncated.
//
// Rule     WeightRule::cut_edges: e' = e truncated to 24 significant bits; S = (e'0 + e'1) + e'2; r = 1 / S if S is a
//          power of two, else (1 / S)(1 - d 2^-32) truncated to m bits; b = e' r truncated to 24 bits.
//          WeightRule::area: r = 1 / A truncated to m bits, A the exact area; b = e r truncated to 24 bits. The unit of
//          e may be any power of two.
// Source   rasterizer/reference/depth.md 4.4; chip-float-depth.md 1; the last bit of r is not certain (chip-depth.md
//          4).
// Numbers  cut_edges in binary64: e' is exact, e' r has at most 24 + 30 bits and is exact up to 29 bits of r; S, 1 / S
//          and its product with 1 - d 2^-32 are rounded (S is exact if its addends' exponents are within 29). area: e
//          <= A < 2^58, r = R 2^-(n + L), L = floor(log2 A), R <= 2^n, n <= 30; e R fits in 64 bits if e is below 2^34.
//          Above that, 24 bits of e R are shifted out first, which the truncation drops anyway: at least 24 + 9 remain.
// Tests    tests/rasterizer/chip/window_z_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/rules/depth_hypothesis.h"

namespace strata::rasterizer {
inline namespace strict {

// b = mantissa * 2^exponent; 2^23 <= mantissa < 2^24, or 0.
struct TruncatedWeight {
    std::uint32_t mantissa = 0;
    int exponent = 0;
};

[[nodiscard]] constexpr double power_of_two(int exponent) noexcept {  // -1022 <= exponent <= 1023
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

[[nodiscard]] constexpr double value(TruncatedWeight b) noexcept { return b.mantissa * power_of_two(b.exponent); }

// v truncated toward zero to its `bits` leading bits. For normal numbers of binary32, and 0.
[[nodiscard]] constexpr double truncate_bits(double v, int bits) noexcept {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) & ~std::uint64_t{0} << (53 - bits));
}

// floor(log2 |v|); -1023, below every other exponent, for 0.
[[nodiscard]] constexpr int exponent_of(double v) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 52 & 0x7ff) - 1023;
}

// An edge value truncated to 24 bits; it may be negative outside the triangle.
[[nodiscard]] constexpr double truncated_edge(std::int64_t e) noexcept {
    const auto size = static_cast<std::uint64_t>(e < 0 ? -e : e);
    // Below 2^53 binary64 represents it exactly; above, bits that the truncation drops are cleared first, so that
    // nothing rounds up.
    const auto kept = static_cast<double>(size >> 53 == 0 ? size : size & ~std::uint64_t{0xfffffff});
    return e < 0 ? -truncate_bits(kept, 24) : truncate_bits(kept, 24);
}

// r for a sum of truncated edge values, or of their products with 1 / w.
[[nodiscard]] constexpr double truncated_reciprocal(double sum, const DepthHypothesis& hypothesis) noexcept {
    const double exact = 1.0 / sum;
    if (std::bit_cast<std::uint64_t>(sum) << 12 == 0) return exact;
    return truncate_bits(exact * (1.0 - hypothesis.reciprocal_deficit * 0x1p-32), hypothesis.reciprocal_bits);
}

// The vertex whose weight is 1 - (the two others) for colours and texture coordinates: the one with the largest
// exponent; ties {0,1} -> v0, {0,2} -> v2, {1,2} -> v1, all -> v2 (attributes.md 2.3).
[[nodiscard]] constexpr std::size_t remainder_vertex(const std::array<double, 3>& b) noexcept {
    const int k0 = exponent_of(b[0]), k1 = exponent_of(b[1]), k2 = exponent_of(b[2]);
    if (k2 >= k0 && k2 > k1) return 2;  // alone, or tied with v0
    if (k1 > k0) return 1;              // alone, or tied with v2
    if (k0 > k2) return 0;              // alone, or tied with v1
    return 2;                           // all three tied
}

// The same weights, with the weight of that vertex replaced.
[[nodiscard]] constexpr std::array<double, 3> with_remainder(std::array<double, 3> b) noexcept {
    const std::size_t rest = remainder_vertex(b);
    b[rest] = 1.0 - (b[(rest + 1) % 3] + b[(rest + 2) % 3]);
    return b;
}

// 1 / area truncated to `bits` significant bits: computed once per triangle, in integers.
class TruncatedReciprocal {
  public:
    explicit constexpr TruncatedReciprocal(std::uint64_t area, int bits = 28) noexcept
        : exponent_{-(bits + static_cast<int>(std::bit_width(area)) - 1)} {
        const int shift = -exponent_, first = shift < 62 ? shift : 62;
        std::uint64_t rest = (std::uint64_t{1} << first) % area;
        mantissa_ = (std::uint64_t{1} << first) / area;
        for (int i = first; i < shift; ++i) {  // long division, one bit per iteration
            rest <<= 1;
            mantissa_ <<= 1;
            if (rest >= area) {
                rest -= area;
                mantissa_ |= 1;
            }
        }
    }
    // b = e / area for an edge value 0 <= e <= area, truncated to 24 bits.
    [[nodiscard]] constexpr TruncatedWeight weight(std::uint64_t e) const noexcept {
        if (e == 0) return {};
        int exponent = exponent_;
        std::uint64_t product = 0;
        if (e < std::uint64_t{1} << 34) {
            product = e * mantissa_;
        } else {
            product = (e >> 24) * mantissa_ + ((e & 0xffffff) * mantissa_ >> 24);
            exponent += 24;
        }
        const int extra = static_cast<int>(std::bit_width(product)) - 24;  // >= 0: the reciprocal's mantissa alone has
                                                                           // `bits` bits
        return {static_cast<std::uint32_t>(product >> extra), exponent + extra};
    }

  private:
    std::uint64_t mantissa_ = 0;
    int exponent_;
};

// The three weights at a fragment, each a binary64 of 24 significant bits; constructed once per triangle for its
// WeightRule.
class TruncatedWeights {
  public:
    constexpr TruncatedWeights(std::int64_t area, const DepthHypothesis& hypothesis) noexcept
        : hypothesis_{hypothesis},
          reciprocal_{hypothesis.weights == WeightRule::area ? static_cast<std::uint64_t>(area) : 1,
                      hypothesis.reciprocal_bits} {}
    [[nodiscard]] constexpr std::array<double, 3> at(const EdgeValues& e) const noexcept {
        std::array<double, 3> b{};
        if (hypothesis_.weights == WeightRule::area) {
            for (std::size_t i = 0; i < 3; ++i)
                b[i] = e[i] < 0 ? -value(reciprocal_.weight(static_cast<std::uint64_t>(-e[i])))
                                : value(reciprocal_.weight(static_cast<std::uint64_t>(e[i])));
            return b;
        }
        for (std::size_t i = 0; i < 3; ++i) b[i] = truncated_edge(e[i]);
        const double r = truncated_reciprocal((b[0] + b[1]) + b[2], hypothesis_);
        for (double& each : b) each = truncate_bits(each * r, 24);
        return b;
    }

  private:
    DepthHypothesis hypothesis_;
    TruncatedReciprocal reciprocal_;  // of the area, for WeightRule::area
};

}  // namespace strict
}  // namespace strata::rasterizer
