// rasterizer/values/plane.h - evaluates the plane through three vertex values at pixel centres, correctly rounded.
//
// Rule     V = N (e0 v0 + e1 v1 + e2 v2) / (A D), exact, then one rounding: to binary32 (nearest even), or to a code
//          floor(V) or floor(V + 1/2). e_i are the edge values, A is their sum; N and D convert one depth unit to
//          another.
// Source   rasterizer/reference/depth.md 3. The filter is that of exact geometric predicates (Shewchuk 1997).
// Numbers  Filter: b_i = e_i r with r = 1/A, v = w0 + (b1 (w1 - w0) + b2 (w2 - w0)), w_i = v_i N / D, all in binary64.
//          With u = 2^-53 and M = max |w_i|: w_i is within 2u M; a difference within 6u M and at most 2M; b_i within 4u
//          b_i (rounded e, A, 1/A, product) plus, for A > 2^53, 4u absolute (e is stepped along the span in binary64);
//          b1 + b2 <= 1 in the triangle. So the products are within 4u 2M + u 2M + 6u M + 8u 2M = 32u M, their sum adds
//          2u M, the last sum with w0's own error 3u M, together less than 40u M; terms of second order stay below u M.
//          The filter uses 64u M = 2^-47 M, plus 2^-1000 for underflow. Outside the triangle every term grows at most
//          with the greatest |b1| + |b2|, and so does the filter (`reach`). If V - error and V + error round to the
//          same value, V does too; otherwise exact_float and exact_code decide.
// Tests    tests/rasterizer/values/plane_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::rasterizer {
inline namespace strict {

// True if the three corner values have the same bits: 0 and -0 differ, and a NaN equals itself.
[[nodiscard]] constexpr bool is_constant(const std::array<float, 3>& u) noexcept {
    const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(u);
    return bits[0] == bits[1] && bits[0] == bits[2];
}

struct RationalPlane {
    std::array<double, 3> v{};
    double numerator = 1.0, denominator = 1.0;  // N and D: integers up to 2^24 - 1

    // Compares bits: 0 and -0 differ, and a NaN equals itself.
    [[nodiscard]] bool is_constant() const noexcept {
        const auto bits = [this](std::size_t i) { return std::bit_cast<std::uint64_t>(v[i]); };
        return bits(0) == bits(1) && bits(0) == bits(2);
    }
};

// Rounds a plane to codes 0..max: floor(V + half).
struct CodeRounding {
    double half = 0.0;
    std::uint32_t max = 0;
};

// The exact results, by expansions; `e` are the edge values at the fragment. Slow: some microseconds.
[[nodiscard]] float exact_float(const RationalPlane& plane, const EdgeValues& e, std::int64_t area) noexcept;
[[nodiscard]] std::uint32_t exact_code(const RationalPlane& plane, const EdgeValues& e, std::int64_t area,
                                       CodeRounding rounding) noexcept;
// The value of a constant plane, rounded once.
[[nodiscard]] float constant_float(const RationalPlane& plane, std::int64_t area) noexcept;

// Loops over lanes run to whole blocks, so that they need no remainder loop; the values of lanes past the count are not
// used. A batch is flushed early enough to leave room for them (lane_kernels.h).
inline constexpr int lane_block = 4;
[[nodiscard]] constexpr int padded(int count) noexcept { return (count + lane_block - 1) & -lane_block; }

// The fragments of one triangle: `count` lanes of batch arrays.
struct TriangleLanes {
    const TriangleEdges* edges;
    int subpixel_bits;
    const std::uint16_t* x;
    const std::uint16_t* y;
    const double* weight1;  // b1 and b2
    const double* weight2;
    int count;
    // The greatest |b1| + |b2|, at least 1, if the weights are those of the snapped triangle; 0: the binary64 value is
    // the plane's value.
    double reach;

    [[nodiscard]] EdgeValues edge_values(int i) const noexcept {
        return edges->at(pixel_centre(x[i], y[i], subpixel_bits));
    }
};

// The plane as the filter evaluates it.
struct FilterPlane {
    double w0 = 0.0, d1 = 0.0, d2 = 0.0, error = 0.0;

    FilterPlane() = default;
    FilterPlane(const RationalPlane& plane, double reach) noexcept {
        const double n = plane.numerator, d = plane.denominator;
        const double scale = n == d ? 1.0 : n / d;  // 1, N or 1 / D: rounded at most once
        w0 = plane.v[0] * scale;
        const double w1 = plane.v[1] * scale, w2 = plane.v[2] * scale;
        d1 = w1 - w0;
        d2 = w2 - w0;
        const auto size = [](double w) { return w < 0.0 ? -w : w; };
        error = reach * (0x1p-47 * std::max({size(w0), size(w1), size(w2)}) + 0x1p-1000);
    }
    [[nodiscard]] double at(double b1, double b2) const noexcept { return w0 + (b1 * d1 + b2 * d2); }
};

// The filter's rounding: both ends of the interval that contains a plane's value, rounded and returned as bits. If they
// are equal, so is the rounding of the value; if they differ, the exact sum must decide.
struct RoundedEnds {
    std::uint32_t low, high;
    [[nodiscard]] constexpr std::uint32_t difference() const noexcept { return low ^ high; }
};
template <class Rounding>
[[nodiscard, gnu::always_inline]] inline RoundedEnds rounded_ends(double value, double error,
                                                                  const Rounding& rounding) noexcept {
    return {rounding(value - error), rounding(value + error)};
}
// Bits of the nearest binary32, ties to even.
struct ToBinary32 {
    [[nodiscard]] std::uint32_t operator()(double v) const noexcept {
        return std::bit_cast<std::uint32_t>(static_cast<float>(v));
    }
};

// Rounds the plane at every lane to binary32. Returns the number of lanes that needed exact arithmetic.
int round_plane(const RationalPlane& plane, const TriangleLanes& lanes, float* out) noexcept;
// Rounds the plane at every lane to codes. Returns the number of lanes that needed exact arithmetic.
int round_plane(const RationalPlane& plane, const TriangleLanes& lanes, CodeRounding rounding,
                std::uint32_t* out) noexcept;

}  // namespace strict
}  // namespace strata::rasterizer
