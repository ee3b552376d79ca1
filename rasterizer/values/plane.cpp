// rasterizer/values/plane.cpp - rounds planes to binary32 or to codes (plane.h): the filter in binary64 for every lane,
// then exact sums for the lanes that it cannot decide.
#include "rasterizer/values/plane.h"

#include "rasterizer/base/exact_sum.h"
#include "rasterizer/values/lane_kernels.h"

namespace strata::rasterizer {
inline namespace strict {
namespace {

// The exact sum N (e0 v0 + e1 v1 + e2 v2).
[[nodiscard]] ExactSum weighted_sum(const RationalPlane& plane, const EdgeValues& e) noexcept {
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) sum.add_product(e[i], plane.v[i], plane.numerator);
    return sum;
}

// The sign of V - value.
[[nodiscard]] int compare(ExactSum sum, double value, const RationalPlane& plane, std::int64_t area) noexcept {
    sum.add_product(-area, value, plane.denominator);
    return sum.sign();
}

// V with a relative error of at most 2^-49.
[[nodiscard]] double quotient(const ExactSum& sum, const RationalPlane& plane, std::int64_t area) noexcept {
    return sum.approximation() / (static_cast<double>(area) * plane.denominator);
}

// Converts to a code: floor, clamped to [0, max].
struct ToCode {
    double max;
    [[nodiscard]] std::uint32_t operator()(double v) const noexcept {
        v = v > 0.0 ? v : 0.0;
        v = v < max ? v : max;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(v));  // v >= 0, so the conversion floors
    }
};

// Computes the exact result of the lanes that the filter could not decide. Returns their number.
template <class Rounding, class Exact, class Word>
int decide(const FilterPlane& filter, double offset, double error, const Rounding& rounding, const Exact& exact_word,
           const TriangleLanes& lanes, Word* out) noexcept {
    int fallbacks = 0;
    for (int i = 0; i < lanes.count; ++i) {
        const double v = filter.at(lanes.weight1[i], lanes.weight2[i]) + offset;
        if (rounded_ends(v, error, rounding).difference() == 0) continue;
        out[i] = exact_word(lanes.edge_values(i));
        ++fallbacks;
    }
    return fallbacks;
}

}  // namespace

float exact_float(const RationalPlane& plane, const EdgeValues& e, std::int64_t area) noexcept {
    const ExactSum sum = weighted_sum(plane, e);
    const double v = quotient(sum, plane, area);
    const auto low = static_cast<float>(v * (1.0 - 0x1p-48)), high = static_cast<float>(v * (1.0 + 0x1p-48));
    if (std::bit_cast<std::uint32_t>(low) == std::bit_cast<std::uint32_t>(high)) return low;
    // low and high are neighbours, so 25 bits hold the value half way between them.
    const double middle = (double{low} + double{high}) * 0.5;
    const int side = compare(sum, middle, plane, area);
    if (side == 0) return static_cast<float>(middle);  // ties to even
    const bool takes_larger = side > 0;
    return takes_larger == (high > low) ? high : low;
}

std::uint32_t exact_code(const RationalPlane& plane, const EdgeValues& e, std::int64_t area,
                         CodeRounding rounding) noexcept {
    const ExactSum sum = weighted_sum(plane, e);
    const double max = rounding.max;
    // The estimate is within 2^-49 of V, so it differs from the code by at most one; the comparisons are exact.
    double code = ToCode{max}(quotient(sum, plane, area) + rounding.half);
    while (code > 0.0 && compare(sum, code - rounding.half, plane, area) < 0) code -= 1.0;
    while (code < max && compare(sum, code + 1.0 - rounding.half, plane, area) >= 0) code += 1.0;
    return static_cast<std::uint32_t>(code);
}

float constant_float(const RationalPlane& plane, std::int64_t area) noexcept {
    if (plane.numerator == plane.denominator) return static_cast<float>(plane.v[0]);
    return exact_float(plane, {area, 0, 0}, area);
}

int round_plane(const RationalPlane& plane, const TriangleLanes& lanes, float* __restrict out) noexcept {
    const int count = lanes.count;
    if (plane.is_constant()) {
        const float value = constant_float(plane, lanes.edges->area());
        for (int i = 0; i < padded(count); ++i) out[i] = value;
        return 0;
    }
    const FilterPlane filter{plane, lanes.reach};
    const bool unsure = scalar::round(filter, lanes.weight1, lanes.weight2, count, out);
    // The first loop only finds whether any lane is undecided; almost always none is.
    if (!unsure) return 0;  // always so for inexact planes: their filter has no error
    const auto exact = [&](const EdgeValues& e) { return exact_float(plane, e, lanes.edges->area()); };
    return decide(filter, 0.0, filter.error, ToBinary32{}, exact, lanes, out);
}

int round_plane(const RationalPlane& plane, const TriangleLanes& lanes, CodeRounding rounding,
                std::uint32_t* __restrict out) noexcept {
    const int count = lanes.count;
    if (plane.is_constant()) {
        const std::uint32_t code = exact_code(plane, {lanes.edges->area(), 0, 0}, lanes.edges->area(), rounding);
        for (int i = 0; i < padded(count); ++i) out[i] = code;
        return 0;
    }
    const FilterPlane filter{plane, lanes.reach};
    const double* __restrict b1 = lanes.weight1;
    const double* __restrict b2 = lanes.weight2;
    const ToCode to_code{static_cast<double>(rounding.max)};
    const double half = rounding.half;
    const double error = lanes.reach > 0.0 ? filter.error + 0x1p-47 : 0.0;  // adding 1/2 rounds once more
    std::uint32_t unsure = 0;
    for (int i = 0; i < padded(count); ++i) {
        const RoundedEnds ends = rounded_ends(filter.at(b1[i], b2[i]) + half, error, to_code);
        unsure |= ends.difference();
        out[i] = ends.low;
    }
    if (unsure == 0) return 0;
    const auto exact = [&](const EdgeValues& e) { return exact_code(plane, e, lanes.edges->area(), rounding); };
    return decide(filter, half, error, to_code, exact, lanes, out);
}

}  // namespace strict
}  // namespace strata::rasterizer
