// tools/port/beside/mesa_pow.h - GLSL's pow, exp2 and log2 as llvmpipe computes them.
//
// Rule     pow(x, y) = exp2(log2(x) * y), 0 for x = 0. Both are polynomials whose even and odd terms are summed
//          separately, every step a * b + c, fused if the processor has FMA. Division is IEEE's.
// Source   pipeline/reference/mesa-rasterizers.md 2.10.
// Tests    tools/lab/bench/driver_differences.py: weighted averages that end in pow, pixel by pixel
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace strata::port {

class MesaPow {
  public:
    explicit MesaPow(bool has_fma) : has_fma_{has_fma} {}

    [[nodiscard]] float pow(float x, float y) const { return x == 0.0f ? 0.0f : exp2(log2(x) * y); }

    // x > 0 and normal. With m the significand of x in [1, 2): y = (m - 1) / (m + 1); exponent + y P(y y).
    [[nodiscard]] float log2(float x) const {
        const auto bits = std::bit_cast<std::uint32_t>(x);
        const float exponent = static_cast<float>(static_cast<int>(bits >> 23 & 0xff) - 127);
        const float m = std::bit_cast<float>((bits & 0x7fffff) | 0x3f800000);
        const float y = (m - 1.0f) / (m + 1.0f);
        const float square = y * y;
        return step(y,
                    polynomial(std::array{2.88539009f, 0.96179155f, 0.57744034f, 0.403343858f, 0.406718053f}, square),
                    exponent);
    }

    // 2 to the power floor(x), times P of the fraction.
    [[nodiscard]] float exp2(float x) const {
        const float inside = std::max(std::min(128.0f, x), -126.99999f), whole = std::floor(inside);
        const float power = std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<int>(whole) + 127) << 23);
        return power *
               polynomial(std::array{1.0f, 0.693153073f, 0.240153617f, 0.0558263180f, 0.00898934009f, 0.00187757667f},
                          inside - whole);
    }

  private:
    [[nodiscard]] float step(float a, float b, float c) const {
        if (has_fma_) return std::fma(a, b, c);
        const float product = a * b;
        return product + c;
    }
    // (c0 + x^2 (c2 + ...)) + x (c1 + x^2 (c3 + ...)), each evaluated from its last coefficient.
    template <std::size_t count>
    [[nodiscard]] float polynomial(const std::array<float, count>& c, float x) const {
        const float square = x * x;
        std::array<float, 2> sum{c[(count - 1) / 2 * 2], c[(count - 2) / 2 * 2 + 1]};
        for (std::size_t i = count - 2; i-- > 0;) sum[i % 2] = step(square, sum[i % 2], c[i]);
        return step(sum[1], x, sum[0]);
    }

    bool has_fma_;
};

}  // namespace strata::port
