// pipeline/vertices/vertex_transform.cpp - products of matrices and positions by the vertex paths (vertex_transform.h).
#include "pipeline/vertices/vertex_transform.h"

#include "rasterizer/base/nv20_arithmetic.h"
#include "rasterizer/base/two_terms.h"
#include "rasterizer/set_up/window.h"

namespace strata::pipeline {
namespace {

using Row = std::array<float, 4>;

[[nodiscard]] Row row_of(const std::array<float, 16>& m, std::size_t r) {
    return {m[r], m[4 + r], m[8 + r], m[12 + r]};
}

// The last addend is m3 * 1: a plain sum.
[[nodiscard]] float fused(const Row& m, const Vec3& p) {
    const float first = m[0] * p[0];
    const float two = rasterizer::fused_multiply_add(m[1], p[1], first);
    return rasterizer::fused_multiply_add(m[2], p[2], two) + m[3];
}

// The two sums of pairs are independent: a compiler that may reassociate does this with four products.
[[nodiscard]] float in_pairs(const Row& m, const Row& p) {
    return (m[0] * p[0] + m[1] * p[1]) + (m[2] * p[2] + m[3] * p[3]);
}

[[nodiscard]] float truncated_product(float a, float b) {
    return rasterizer::truncate_to_binary32(double{a} * double{b});
}

// The sum is high + low exactly; low is 0 if binary64 can represent the sum.
[[nodiscard]] float truncated_sum(float a, float b) {
    const rasterizer::TwoTerms s = rasterizer::two_sum(double{a}, double{b});
    const float f = rasterizer::truncate_to_binary32(s.high);
    // binary64 may have rounded the sum away from zero to a binary32 value: the truncated value is then the next float
    // toward zero.
    const bool is_beyond = double{f} == s.high && s.low != 0.0 && (s.low > 0.0) != (s.high > 0.0);
    return is_beyond ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(f) - 1) : f;
}

[[nodiscard]] float toward_zero(const Row& m, const Vec3& p) {
    return truncated_sum(truncated_sum(truncated_sum(truncated_product(m[0], p[0]), truncated_product(m[1], p[1])),
                                       truncated_product(m[2], p[2])),
                         m[3]);
}

[[nodiscard]] float nv20(const Row& m, const Vec3& p) {
    using namespace rasterizer::nv20;
    return sum(std::array{multiply(m[0], p[0]), multiply(m[1], p[1]), multiply(m[2], p[2]), multiply(m[3], 1.0f)});
}

}  // namespace

std::array<float, 16> to_binary32(const Matrix& m) {
    std::array<float, 16> rounded{};
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 4; ++r) rounded[4 * c + r] = static_cast<float>(m[c][r]);
    return rounded;
}

VertexTransform::VertexTransform(VertexPath path, const Matrix& whole, const Matrix& outer, const Matrix& inner)
    : path_{path}, whole_{to_binary32(whole)}, outer_{to_binary32(outer)}, inner_{to_binary32(inner)}, exact_{whole} {}

std::array<float, 4> VertexTransform::by_path(const Vec3& p) const {
    std::array<float, 4> out{};
    Row eye{};
    for (std::size_t r = 0; r < 4; ++r) eye[r] = in_pairs(row_of(inner_, r), {p[0], p[1], p[2], 1.0f});
    for (std::size_t r = 0; r < 4; ++r) {
        const Row m = row_of(whole_, r);
        switch (path_) {
            case VertexPath::separate: break;  // handled by the caller
            case VertexPath::fused: out[r] = fused(m, p); break;
            case VertexPath::reassociated: out[r] = in_pairs(row_of(outer_, r), eye); break;
            case VertexPath::double_precision: {
                const double sum = (exact_[0][r] * p[0] + exact_[1][r] * p[1]) + exact_[2][r] * p[2];
                out[r] = static_cast<float>(sum + exact_[3][r]);
                break;
            }
            case VertexPath::toward_zero: out[r] = toward_zero(m, p); break;
            case VertexPath::nv20: out[r] = nv20(m, p); break;
        }
    }
    return out;
}

}  // namespace strata::pipeline
