// rasterizer/values/cut_weight.h - the weights of NV2A's interpolator: edge value times reciprocal of the area, both cut.
//
// Rule     r = 1 / A cut to 28 significant bits (an experiment may take 24 to 30); b = e * r, product exact, cut to 24
//          significant bits. e and A in any unit that is a power of two (here square subpixels).
// Source   depth.md 4.4; the last bits of r are open (chip-depth.md 4).
// Numbers  e <= A < 2^58. r = R 2^-(n + L), L = floor(log2 A), R <= 2^n, n <= 30; e R fits 64 bits below 2^34, above
//          it 24 bits of e R, which the cut drops anyway, are shifted out first: at least 24 + 9 stay.
// Tests    tests/rasterizer/values/window_z_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"

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

// The vertex whose weight is 1 - (the two others) for colours and texture coordinates: that of the largest exponent; ties
// {0,1} -> v0, {0,2} -> v2, {1,2} -> v1, all -> v2. attributes.md 2.3.
[[nodiscard]] constexpr std::size_t remainder_vertex(const std::array<double, 3>& b) noexcept {
    const auto exponent = [&](std::size_t i) { return std::bit_cast<std::uint64_t>(b[i]) >> 52; };
    const auto k0 = exponent(0), k1 = exponent(1), k2 = exponent(2);
    if (k2 >= k0 && k2 > k1) return 2;  // alone, or with v0
    if (k1 > k0) return 1;              // alone, or with v2
    if (k0 > k2) return 0;              // alone, or with v1
    return 2;                           // all three
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

}  // namespace strict
}  // namespace strata::rasterizer
