// rasterizer/values/window_z.h - 24-bit fixed-point window depth as NV2A (GeForce3 class) computes it.
//
// Rule     depth.md 4.4: the corner R whose edge value has the largest exponent (ties: v1, v0, v2) is the
//          reference; the others add b_j (z_j - z_R), each cut toward zero to 2^(ex - 28), ex the largest exponent of
//          the three terms; depth = floor of the sum; 16-bit float depth: the sum cut to binary32, and that to its code
//          (every word of four captures of suite Depth_buffer). z are binary32 in buffer units; vertex z with polygon offset is
//          rounded to binary32 first [A].
// Source   measured on silicon: 4,927,976 of 4,927,976 words; general and counter-clockwise triangles untested there.
// Numbers  z_j - z_R is exact: 24 + 61 bits, because a z below 2^-36 of the other acts as any z below 2^-24 of it does;
//          times 24 bits of weight 109 bits. Nearly all differences have 39 bits or fewer, and their products fit 64
//          bits.
// Tests    tests/rasterizer/values/window_z_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/exact_sum.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/rules/depth_hypothesis.h"
#include "rasterizer/values/cut_weight.h"

namespace strata::rasterizer {
inline namespace strict {

__extension__ using Wide = unsigned __int128;

[[nodiscard]] constexpr int bit_width(std::uint64_t v) noexcept { return static_cast<int>(std::bit_width(v)); }
[[nodiscard]] constexpr int bit_width(Wide v) noexcept {
    const auto high = static_cast<std::uint64_t>(v >> 64);
    return high != 0 ? 64 + bit_width(high) : bit_width(static_cast<std::uint64_t>(v));
}

// sign * magnitude * 2^exponent.
struct Dyadic {
    Wide magnitude = 0;
    int exponent = 0;
    bool is_negative = false;
};

// A finite float as an integer times a power of two; denormals keep the exponent of the least normal number.
[[nodiscard]] constexpr Dyadic as_dyadic(float z) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(z);
    const std::uint32_t field = bits >> 23 & 0xff, fraction = bits & 0x7fffff;
    if ((bits << 1) == 0) return {};
    return {Wide{field == 0 ? fraction : fraction | 0x800000u}, static_cast<int>(field == 0 ? 1u : field) - 150,
            (bits >> 31) != 0};
}

// a - b. A term whose exponent is more than 60 below the other's becomes the unit of that place: no cut can tell.
[[nodiscard]] constexpr Dyadic difference(float a, float b) noexcept {
    Dyadic x = as_dyadic(a), y = as_dyadic(b);
    if (x.magnitude == 0) x.exponent = y.exponent;
    if (y.magnitude == 0) y.exponent = x.exponent;
    const int unit = std::max(std::min(x.exponent, y.exponent), std::max(x.exponent, y.exponent) - 60);
    const auto scaled = [unit](const Dyadic& d) {
        if (d.magnitude == 0) return Wide{0};
        return d.exponent < unit ? Wide{1} : d.magnitude << (d.exponent - unit);
    };
    const Wide m = scaled(x), n = scaled(y);
    Dyadic result{0, unit, x.is_negative};
    if (x.is_negative != y.is_negative) {
        result.magnitude = m + n;
    } else {
        result.magnitude = m > n ? m - n : n - m;
        if (n > m) result.is_negative = !x.is_negative;
    }
    if (x.magnitude == 0) result.is_negative = !y.is_negative;
    const auto low = static_cast<std::uint64_t>(result.magnitude);
    const int zeros = low != 0 ? std::countr_zero(low) : 0;
    result.magnitude >>= zeros;
    result.exponent += zeros;
    return result;
}

// The chip's depth of one triangle: differences of corners are taken once, weights and sum at every fragment.
class WindowZ24 {
  public:
    constexpr WindowZ24(const std::array<double, 3>& z, std::int64_t area,
                        const DepthHypothesis& hypothesis = {}) noexcept
        : reciprocal_{static_cast<std::uint64_t>(area), hypothesis.reciprocal_bits}, sum_bits_{hypothesis.sum_bits} {
        for (std::size_t i = 0; i < 3; ++i) z_[i] = static_cast<float>(z[i]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Dyadic d = as_dyadic(z_[i]);
            z_exponent_[i] = d.magnitude == 0 ? none : bit_width(d.magnitude) - 1 + d.exponent;
            for (std::size_t r = 0; r < 3; ++r) difference_[r][i] = difference(z_[i], z_[r]);
        }
        // 39 bits of difference times 24 of weight fit in 64: then no 128-bit arithmetic is needed.
        is_narrow_ = std::ranges::all_of(std::array{difference_[0][1], difference_[0][2], difference_[1][2]},
                                         [](const Dyadic& d) { return bit_width(d.magnitude) <= 39; });
    }
    // The depth code at a fragment with edge values `e`, before the clamp to the buffer's range.
    [[nodiscard]] constexpr double at(const EdgeValues& e) const noexcept {
        const TwoTerms s = sum(e);
        const double whole = floor(s.high);
        return whole == s.high && s.low < 0.0 ? whole - 1.0 : whole;
    }
    // The sum that `at` floors, rounded to binary64.
    [[nodiscard]] constexpr double value(const EdgeValues& e) const noexcept { return sum(e).high; }

  private:
    static constexpr int none = -10000;  // the exponent of 0

    [[nodiscard]] static constexpr std::size_t reference(const EdgeValues& e) noexcept {
        const auto exponent = [&](std::size_t i) { return std::bit_width(static_cast<std::uint64_t>(e[i])); };
        if (exponent(1) >= exponent(0) && exponent(1) >= exponent(2)) return 1;
        return exponent(0) >= exponent(2) ? 0 : 2;
    }

    template <class Integer>
    struct Term {
        Integer magnitude = 0;
        int exponent = 0;
        bool is_negative = false;

        constexpr Term(CutWeight b, const Dyadic& z) noexcept
            : magnitude{static_cast<Integer>(z.magnitude) * b.mantissa},
              exponent{b.exponent + z.exponent},
              is_negative{z.is_negative} {}
        [[nodiscard]] constexpr int leading_exponent() const noexcept {
            return magnitude == 0 ? none : bit_width(magnitude) - 1 + exponent;
        }
        // In units of 2^unit, toward zero; below 2^29 because the unit is 28 places under the largest term. The exponent of
        // a zero means nothing: two corners at depth 0 put it any number of places above the unit.
        [[nodiscard]] constexpr std::int64_t cut(int unit) const noexcept {
            if (magnitude == 0) return 0;
            const int right = unit - exponent;
            constexpr int width = static_cast<int>(sizeof(Integer)) * 8;
            const Integer kept = right >= width ? 0 : (right >= 0 ? magnitude >> right : magnitude << -right);
            return is_negative ? -static_cast<std::int64_t>(kept) : static_cast<std::int64_t>(kept);
        }
    };

    template <class Integer>
    [[nodiscard]] constexpr TwoTerms sum_of(const EdgeValues& e) const noexcept {
        const std::size_t r = reference(e), j = r == 0 ? 1 : 0, k = r == 2 ? 1 : 2;
        const Term<Integer> pj{reciprocal_.weight(static_cast<std::uint64_t>(e[j])), difference_[r][j]};
        const Term<Integer> pk{reciprocal_.weight(static_cast<std::uint64_t>(e[k])), difference_[r][k]};
        const int largest = std::max({z_exponent_[r], pj.leading_exponent(), pk.leading_exponent()});
        if (largest == none) return {};
        const int unit = largest - (sum_bits_ - 1);
        const auto products = static_cast<double>(pj.cut(unit) + pk.cut(unit)) * power_of_two(unit);
        return two_sum(double{z_[r]}, products);
    }

    [[nodiscard]] constexpr TwoTerms sum(const EdgeValues& e) const noexcept {
        return is_narrow_ ? sum_of<std::uint64_t>(e) : sum_of<Wide>(e);
    }

    // |v| < 2^62; a larger one is far outside every buffer.
    [[nodiscard]] static constexpr double floor(double v) noexcept {
        const double bounded = std::clamp(v, -0x1p62, 0x1p62);
        const auto toward_zero = static_cast<double>(static_cast<std::int64_t>(bounded));
        return toward_zero > bounded ? toward_zero - 1.0 : toward_zero;
    }

    CutReciprocal reciprocal_;
    int sum_bits_;
    std::array<float, 3> z_{};
    std::array<int, 3> z_exponent_{};
    std::array<std::array<Dyadic, 3>, 3> difference_{};  // [r][i] = z_i - z_r
    bool is_narrow_ = false;
};

}  // namespace strict
}  // namespace strata::rasterizer
