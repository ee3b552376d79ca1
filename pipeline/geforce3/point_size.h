// pipeline/geforce3/point_size.h - NV2A's size of a point by its distance from the eye, in the fixed pipeline.
//
// Rule     D2 = x x + y y + z z and D = D2 (1 / sqrt(D2)) of the eye position, in the 32-bit unit, are rounded to
// 22-bit
//          floats. f = 1 / sqrt((A, B, C) . (1, D, D2)) by the table alone, infinite for what is not positive; f +
//          bias, limited to 0..1; size = f range + least, in pixels, cut to eighths, at most 511.
// Source   rasterizer/reference/lines-and-points.md 5.2, from captures of suite Point_params.
// Tests    tests/pipeline/geforce3/point_size_test.cpp; tests/tools/lab/hardware_check/suites_test.cpp: captures
#pragma once
#include <algorithm>
#include <array>

#include "pipeline/lighting/float22.h"
#include "rasterizer/base/nv20_arithmetic.h"

namespace strata::pipeline {

// POINT_PARAMS of the chip.
struct PointSizeRegisters {
    std::array<float, 3> factor{};  // of 1, the distance, and its square
    float range = 0.0f, bias = 0.0f, least = 0.0f;
};

// In eighths of a pixel, 0 to 511.
[[nodiscard]] constexpr int attenuated_size(const PointSizeRegisters& registers,
                                            const std::array<float, 3>& eye) noexcept {
    namespace nv20 = rasterizer::nv20;
    using float22::rounded;
    const auto square = [](float v) { return nv20::multiply(v, v); };
    const float squared = nv20::sum<3>({square(eye[0]), square(eye[1]), square(eye[2])});
    const float distance = nv20::multiply(squared, float22::wide_rsq(squared));
    const auto& [a, b, c] = registers.factor;
    const float q = float22::dot({rounded(a), rounded(b), rounded(c)}, {1.0f, rounded(distance), rounded(squared)});
    const float f = std::clamp(float22::sadd(float22::rsq(q), rounded(registers.bias)), 0.0f, 1.0f);
    const float size = float22::add(float22::mul(f, rounded(registers.range)), rounded(registers.least));
    return size < 64.0f ? static_cast<int>(std::max(size, 0.0f) * 8.0f) : 511;
}

}  // namespace strata::pipeline
