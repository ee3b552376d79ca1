// peeling/programs/fixed_passes/moment_quantization.h - power moments of a distribution in 16 bits each: a linear
// transform that spreads them over [0, 1], and rounding to k / 65535. Used by the algorithm moments_quantized.
//
// Rule     Odd and even moments are transformed separately: stored[r] = offset[r] + sum over c of matrix[r][c] b[c].
//          Each operation is rounded to binary32, from the left. They are normalized, so that a fragment is added by
//          the share that its absorbance has of the new total.
// Source   peeling/reference/algorithms.md 22.2; Muenstermann et al. 2018, section 3.4, and the shaders that accompany
//          it. Both directions are the published matrices: their product is the identity within 1e-5.
// Tests    tests/peeling/algorithms/moments_quantized_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "rasterizer/base/numerics.h"

namespace strata::peeling {

using MomentValues = std::array<float, 8>;  // of powers 1, 2 ...

struct QuantizationTransform {
    using Matrix = std::array<std::array<float, 4>, 4>;
    Matrix odd, even, odd_inverse, even_inverse;
    std::array<float, 4> even_offset{};  // that of odd moments is 1/2
};

inline constexpr float sqrt_3 = 1.73205081f;
inline constexpr QuantizationTransform quantization_4{{{{1.5f, -2}, {sqrt_3 / 2, -sqrt_3 * 2 / 9}}},
                                                      {{{4, -4}, {0.5f, 0.5f}}},
                                                      {{{-1.0f / 3, sqrt_3}, {-0.75f, 0.75f * sqrt_3}}},
                                                      {{{0.125f, 1}, {-0.125f, 1}}}};
inline constexpr QuantizationTransform quantization_6{
    {{{2.5f, -10, 8},
      {-1.87499864450f, 4.20757543111f, -1.83257678661f},
      {1.26583039016f, -1.47644882902f, 0.71061660238f}}},
    {{{4, -4, 0}, {9, -24, 16}, {-0.57759806484f, 4.61936647543f, -3.07953906655f}}},
    {{{-0.02877789192f, 0.47635550422f, 1.55242808973f},
      {0.09995235706f, 0.84532580931f, 1.05472570761f},
      {0.25893353755f, 0.90779616657f, 0.83327335647f}}},
    {{{0.00001253044f, 0.16668494186f, 0.86602540579f},
      {-0.24998746956f, 0.16668494186f, 0.86602540579f},
      {-0.37498825271f, 0.21876713299f, 0.81189881793f}}},
    {0, 0, 0.018888946f}};
inline constexpr QuantizationTransform quantization_8{
    {{{3.48044635732474f, -27.5760737514826f, 55.1267384344761f, -31.5311110403183f},
      {1.26797185782836f, -0.928755808743913f, -2.07520453231032f, 1.23598848322588f},
      {-2.1671560004294f, 6.17950199592966f, -0.276515571579297f, -4.23583042392097f},
      {0.974332879165755f, -0.443426830933027f, -0.360491648368785f, 0.310149466050223f}}},
    {{{0.280504133158527f, -0.757633844606942f, 0.392179589334688f, -0.887531871812237f},
      {-2.01362265883247f, 0.221551373038988f, -1.06107954265125f, 2.83887201588367f},
      {-7.31010494985321f, 13.9855979699139f, -0.114305766176437f, -7.4361899359832f},
      {-15.8954215629556f, 79.6186327084103f, -127.457278992502f, 63.7349456687829f}}},
    {{{-0.00482399708502382f, -0.423201508674231f, 0.0348312382605129f, 1.67179208266592f},
      {-0.0233402218644408f, -0.832829097046478f, 0.0193406040499625f, 1.21021509068975f},
      {-0.010888537031885f, -0.926393772997063f, -0.11723394414779f, 0.983723301818275f},
      {-0.0308713357806732f, -0.937989172670245f, -0.218033377677099f, 0.845991731322996f}}},
    {{{-0.976220278891035f, -0.456139260269401f, -0.0504335521016742f, 0.000838800390651085f},
      {-1.04828341778299f, -0.229726640510149f, 0.0259608334616091f, -0.00133632693205861f},
      {-1.03115268628604f, -0.077844420809897f, 0.00443408851014257f, -0.0103744938457406f},
      {-0.996038443434636f, 0.0175438624416783f, -0.0361414253243963f, -0.00317839994022725f}}},
    {0.972481993925964f, 1, 0.999179192513328f, 0.991778293073131f}};

[[nodiscard]] constexpr const QuantizationTransform& quantization_of(std::size_t count) noexcept {
    return count == 4 ? quantization_4 : count == 6 ? quantization_6 : quantization_8;
}

inline namespace strict {

// Multiplies the odd moments by one matrix and the even ones by the other.
[[nodiscard]] inline MomentValues transformed(const MomentValues& b, std::size_t count,
                                              const QuantizationTransform::Matrix& odd,
                                              const QuantizationTransform::Matrix& even) noexcept {
    MomentValues result{};
    for (std::size_t m = 0; m < count; ++m) {
        const auto& row = (m % 2 == 0 ? odd : even)[m / 2];
        for (std::size_t c = 0; c < count / 2; ++c) result[m] = result[m] + row[c] * b[2 * c + m % 2];
    }
    return result;
}

[[nodiscard]] inline float moment_offset(const QuantizationTransform& transform, std::size_t m) noexcept {
    return m % 2 == 0 ? 0.5f : transform.even_offset[m / 2];
}

// The nearest k / 65535, k from 0 to 65535.
[[nodiscard]] inline float as_unorm16(float value) noexcept {
    const float code = std::floor(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f);
    return code / 65535.0f;
}

// The stored moments after a fragment at z with this absorbance was added to `stored`, whose absorbances have the sum
// `total`. Precondition: total + absorbance > 0.
[[nodiscard]] inline MomentValues with_fragment(const MomentValues& stored, std::size_t count, float total,
                                                float absorbance, float z) noexcept {
    const QuantizationTransform& transform = quantization_of(count);
    MomentValues powers{};
    float power = 1;
    for (std::size_t m = 0; m < count; ++m) powers[m] = power = power * z;
    const MomentValues added = transformed(powers, count, transform.odd, transform.even);
    const float all = total + absorbance;
    MomentValues result{};
    for (std::size_t m = 0; m < count; ++m) {
        const float offset = moment_offset(transform, m);
        result[m] = as_unorm16(((stored[m] - offset) * total + added[m] * absorbance) / all + offset);
    }
    return result;
}

// The normalized moments.
[[nodiscard]] inline MomentValues restored(MomentValues stored, std::size_t count) noexcept {
    const QuantizationTransform& transform = quantization_of(count);
    for (std::size_t m = 0; m < count; ++m) stored[m] = stored[m] - moment_offset(transform, m);
    return transformed(stored, count, transform.odd_inverse, transform.even_inverse);
}

}  // namespace strict
}  // namespace strata::peeling
