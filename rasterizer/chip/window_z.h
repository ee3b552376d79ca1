// rasterizer/chip/window_z.h - window depth as NV2A (GeForce3 class) computes it, for every depth format.
//
// Rule     rasterizer/reference/depth.md 4.4: the corner R whose edge value has the largest exponent (ties: v1, v0, v2)
//          is the reference; the others add b_j (z_j - z_R), each truncated toward zero to 2^(ex - 28), where ex is the
//          largest exponent of the three terms; the sum is truncated to 24 bits, offset added (offset_value.h). z are
//          binary32 in buffer units; z and differences below 2^-126 are 0.
// Source   measured on hardware: chip-depth.md 1, chip-float-depth.md 1 to 3.
// Numbers  z_j - z_R is exact: 24 + 61 bits, because a z below 2^-36 of the other has the same effect as any z below
//          2^-24 of it; times 24 bits of weight gives 109 bits. Nearly all differences have 29 bits or fewer, and their
//          products are exact in binary64.
// Tests    tests/rasterizer/chip/window_z_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/two_terms.h"
#include "rasterizer/chip/offset_value.h"
#include "rasterizer/chip/truncated_weights.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/rules/depth_hypothesis.h"

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

// A finite float that is 0 or normal, as an integer times a power of two.
[[nodiscard]] constexpr Dyadic as_dyadic(float z) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(z);
    if ((bits << 1) == 0) return {};
    return {Wide{(bits & 0x7fffff) | 0x800000u}, static_cast<int>(bits >> 23 & 0xff) - 150, (bits >> 31) != 0};
}

// a - b. A term whose exponent is more than 60 below the other's is replaced by one unit at that distance, because
// truncation cannot distinguish them.
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

// z and differences below this are 0 on the chip (chip-float-depth.md 3.3).
inline constexpr double least_depth = 0x1p-126;
// A difference of this many bits times a weight of 24 bits is exact in binary64.
inline constexpr int narrow_bits = 29;
[[nodiscard]] constexpr float flushed_depth(float z) noexcept {
    return z < static_cast<float>(least_depth) && z > -static_cast<float>(least_depth) ? 0.0f : z;
}

// The corner to which the others are relative: the one whose edge value has the largest exponent.
[[nodiscard]] constexpr std::size_t reference_vertex(const EdgeValues& e) noexcept {
    const auto width = [&](std::size_t i) {
        return std::bit_width(static_cast<std::uint64_t>(e[i] < 0 ? -e[i] : e[i]));
    };
    if (width(1) >= width(0) && width(1) >= width(2)) return 1;
    return width(0) >= width(2) ? 0 : 2;
}

// The chip's depth of one triangle. Differences of corners are computed once, weights and sum per fragment.
class WindowZ24 {
  public:
    constexpr WindowZ24(const std::array<double, 3>& z, std::int64_t area, const DepthHypothesis& hypothesis = {},
                        double offset = 0.0) noexcept
        : weights_{area, hypothesis}, offset_{offset}, sum_bits_{hypothesis.sum_bits} {
        for (std::size_t i = 0; i < 3; ++i) z_[i] = flushed_depth(static_cast<float>(z[i]));
        is_narrow_ = true;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t i = 0; i < 3; ++i) {
                const double d = double{z_[i]} - double{z_[r]};
                const bool is_zero = d < least_depth && d > -least_depth;
                is_narrow_ = is_narrow_ && two_sum(double{z_[i]}, -double{z_[r]}).low == 0.0 &&
                             truncate_bits(d, narrow_bits) == d;
                narrow_[r][i] = is_zero ? 0.0 : d;
            }
        for (std::size_t r = 0; r < 3 && !is_narrow_; ++r)
            for (std::size_t i = 0; i < 3; ++i)
                if (narrow_[r][i] != 0.0) difference_[r][i] = difference(z_[i], z_[r]);
    }
    // The value at a fragment with edge values `e`, in buffer units, including the offset: 24 significant bits, not
    // clamped.
    [[nodiscard]] constexpr double value(const EdgeValues& e) const noexcept {
        return offset_value(is_narrow_ ? narrow_sum(e) : wide_sum(e), offset_);
    }

  private:
    static constexpr int none = -10000;  // the exponent of 0

    // A weight times a difference, as sign * magnitude * 2^exponent.
    struct Term {
        Wide magnitude = 0;
        int exponent = 0;
        bool is_negative = false;

        constexpr Term(double b, const Dyadic& z) noexcept
            : magnitude{z.magnitude * as_dyadic(static_cast<float>(b)).magnitude},
              exponent{as_dyadic(static_cast<float>(b)).exponent + z.exponent},
              is_negative{z.is_negative != (b < 0.0)} {}
        [[nodiscard]] constexpr int leading_exponent() const noexcept {
            return magnitude == 0 ? none : bit_width(magnitude) - 1 + exponent;
        }
        // In units of 2^unit, truncated toward zero; below 2^29 because the unit is 28 bits below the largest term. The
        // exponent of a zero is meaningless: with two corners at depth 0 it may be any number of bits above the unit.
        [[nodiscard]] constexpr std::int64_t truncated(int unit) const noexcept {
            if (magnitude == 0) return 0;
            const int right = unit - exponent;
            const Wide kept = right >= 128 ? 0 : (right >= 0 ? magnitude >> right : magnitude << -right);
            return is_negative ? -static_cast<std::int64_t>(kept) : static_cast<std::int64_t>(kept);
        }
    };

    [[nodiscard]] constexpr TwoTerms wide_sum(const EdgeValues& e) const noexcept {
        const std::size_t r = reference_vertex(e), j = r == 0 ? 1 : 0, k = r == 2 ? 1 : 2;
        const std::array<double, 3> b = weights_.at(e);
        const Term pj{b[j], difference_[r][j]}, pk{b[k], difference_[r][k]};
        const int own = z_[r] == 0.0f ? none : exponent_of(double{z_[r]});
        const int largest = std::max({own, pj.leading_exponent(), pk.leading_exponent()});
        if (largest == none) return {};
        const int unit = largest - (sum_bits_ - 1);
        return two_sum(double{z_[r]},
                       static_cast<double>(pj.truncated(unit) + pk.truncated(unit)) * power_of_two(unit));
    }
    // The same if every product is exact in binary64.
    [[nodiscard]] constexpr TwoTerms narrow_sum(const EdgeValues& e) const noexcept {
        const std::size_t r = reference_vertex(e), j = r == 0 ? 1 : 0, k = r == 2 ? 1 : 2;
        const std::array<double, 3> b = weights_.at(e);
        const double z = double{z_[r]}, pj = b[j] * narrow_[r][j], pk = b[k] * narrow_[r][k];
        const int largest = std::max({exponent_of(z), exponent_of(pj), exponent_of(pk)});
        if (largest < -1000) return {};
        const int unit = largest - (sum_bits_ - 1);
        const double units = power_of_two(-unit);
        const auto truncated = [units](double p) { return static_cast<std::int64_t>(p * units); };
        return two_sum(z, static_cast<double>(truncated(pj) + truncated(pk)) * power_of_two(unit));
    }

    TruncatedWeights weights_;
    double offset_;
    int sum_bits_;
    std::array<float, 3> z_{};
    std::array<std::array<double, 3>, 3> narrow_{};      // [r][i] = z_i - z_r
    std::array<std::array<Dyadic, 3>, 3> difference_{};  // the same without rounding, for differences that binary64
                                                         // cannot represent
    bool is_narrow_ = false;
};

}  // namespace strict
}  // namespace strata::rasterizer
