// rasterizer/chip/cut_weight.h - the weights of NV2A's interpolator: edge values times a reciprocal, both cut.
//
// Rule     WeightRule::cut_edges: e' = e cut to 24 significant bits; S = (e'0 + e'1) + e'2; r = 1 / S where S is a
//          power of two, else (1 / S)(1 - d 2^-32) cut to m bits; b = e' r cut to 24 bits. WeightRule::area: r = 1 / A
//          cut to m bits, A the exact area; b = e r cut to 24 bits. Any unit of e that is a power of two.
// Source   depth.md 4.4; chip-float-depth.md 1; the last bit of r is open (chip-depth.md 4).
// Numbers  cut_edges in binary64: e' is exact, e' r has 24 + 30 bits at most and is exact to 29 bits of r; S, 1 / S and
//          its product with 1 - d 2^-32 are rounded there (S is exact while its addends' exponents are within 29).
//          area: e <= A < 2^58, r = R 2^-(n + L), L = floor(log2 A), R <= 2^n, n <= 30; e R fits 64 bits below 2^34,
//          above it 24 bits of e R, which the cut drops anyway, are shifted out first: at least 24 + 9 stay.
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
struct CutWeight {
    std::uint32_t mantissa = 0;
    int exponent = 0;
};

[[nodiscard]] constexpr double power_of_two(int exponent) noexcept {  // -1022 <= exponent <= 1023
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

[[nodiscard]] constexpr double value(CutWeight b) noexcept { return b.mantissa * power_of_two(b.exponent); }

// v without what is below its `bits` leading bits: toward zero. Normal numbers of binary64, and 0.
[[nodiscard]] constexpr double cut_bits(double v, int bits) noexcept {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) & ~std::uint64_t{0} << (53 - bits));
}

// floor(log2 |v|); far below everything for 0.
[[nodiscard]] constexpr int exponent_of(double v) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 52 & 0x7ff) - 1023;
}

// An edge value cut to 24 bits; it may be negative, outside of the triangle.
[[nodiscard]] constexpr double cut_edge(std::int64_t e) noexcept {
    const auto size = static_cast<std::uint64_t>(e < 0 ? -e : e);
    // Below 2^53 binary64 holds it; above, what the cut drops is cleared first, so that nothing rounds up.
    const auto kept = static_cast<double>(size >> 53 == 0 ? size : size & ~std::uint64_t{0xfffffff});
    return e < 0 ? -cut_bits(kept, 24) : cut_bits(kept, 24);
}

// r of a sum of cut edge values, or of their products with 1 / w.
[[nodiscard]] constexpr double cut_reciprocal(double sum, const DepthHypothesis& hypothesis) noexcept {
    const double exact = 1.0 / sum;
    if (std::bit_cast<std::uint64_t>(sum) << 12 == 0) return exact;
    return cut_bits(exact * (1.0 - hypothesis.reciprocal_deficit * 0x1p-32), hypothesis.reciprocal_bits);
}

// The vertex whose weight is 1 - (the two others) for colours and texture coordinates: that of the largest exponent;
// ties {0,1} -> v0, {0,2} -> v2, {1,2} -> v1, all -> v2. attributes.md 2.3.
[[nodiscard]] constexpr std::size_t remainder_vertex(const std::array<double, 3>& b) noexcept {
    const auto exponent = [&](std::size_t i) { return std::bit_cast<std::uint64_t>(b[i]) >> 52; };
    const auto k0 = exponent(0), k1 = exponent(1), k2 = exponent(2);
    if (k2 >= k0 && k2 > k1) return 2;  // alone, or with v0
    if (k1 > k0) return 1;              // alone, or with v2
    if (k0 > k2) return 0;              // alone, or with v1
    return 2;                           // all three
}

// The same weights with that vertex's.
[[nodiscard]] constexpr std::array<double, 3> with_remainder(std::array<double, 3> b) noexcept {
    const std::size_t rest = remainder_vertex(b);
    b[rest] = 1.0 - (b[(rest + 1) % 3] + b[(rest + 2) % 3]);
    return b;
}

// 1 / area, cut to `bits` significant bits: once a triangle, by integers.
class CutReciprocal {
  public:
    explicit constexpr CutReciprocal(std::uint64_t area, int bits = 28) noexcept
        : exponent_{-(bits + static_cast<int>(std::bit_width(area)) - 1)} {
        const int shift = -exponent_, first = shift < 62 ? shift : 62;
        std::uint64_t rest = (std::uint64_t{1} << first) % area;
        mantissa_ = (std::uint64_t{1} << first) / area;
        for (int i = first; i < shift; ++i) {  // long division, a bit at a time
            rest <<= 1;
            mantissa_ <<= 1;
            if (rest >= area) {
                rest -= area;
                mantissa_ |= 1;
            }
        }
    }
    // b = e / area of an edge value 0 <= e <= area, cut to 24 bits.
    [[nodiscard]] constexpr CutWeight weight(std::uint64_t e) const noexcept {
        if (e == 0) return {};
        int exponent = exponent_;
        std::uint64_t product = 0;
        if (e < std::uint64_t{1} << 34) {
            product = e * mantissa_;
        } else {
            product = (e >> 24) * mantissa_ + ((e & 0xffffff) * mantissa_ >> 24);
            exponent += 24;
        }
        const int extra = static_cast<int>(std::bit_width(product)) - 24;  // >= 0: the mantissa alone has `bits`
        return {static_cast<std::uint32_t>(product >> extra), exponent + extra};
    }

  private:
    std::uint64_t mantissa_ = 0;
    int exponent_;
};

// The three weights at a fragment, each a binary64 of 24 significant bits: once a triangle by WeightRule.
class CutWeights {
  public:
    constexpr CutWeights(std::int64_t area, const DepthHypothesis& hypothesis) noexcept
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
        for (std::size_t i = 0; i < 3; ++i) b[i] = cut_edge(e[i]);
        const double r = cut_reciprocal((b[0] + b[1]) + b[2], hypothesis_);
        for (double& each : b) each = cut_bits(each * r, 24);
        return b;
    }

  private:
    DepthHypothesis hypothesis_;
    CutReciprocal reciprocal_;  // of the area, where the rule asks for it
};

}  // namespace strict
}  // namespace strata::rasterizer
