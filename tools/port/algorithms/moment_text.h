// tools/port/algorithms/moment_text.h - the programs of `moments` in GLSL: logarithm, exponential and the bound of
// peeling/reference/algorithms.md 22.1 in binary64, with the same operations, four moments and the default bias and
// overestimation.
// Needs    GL_ARB_gpu_shader_fp64. Numbers whose every bit matters are packed from their bits.
#pragma once

namespace strata::port {

// float minus_log(float), float exp_of_minus(float): as in rasterizer/base/log_exp.h, rounded once.
inline constexpr auto log_exp_text = R"(
double log_of_2() { return packDouble2x32(uvec2(0xfefa39efu, 0x3fe62e42u)); }
float minus_log(float x) {
    uint bits = floatBitsToUint(x);
    int exponent = int(bits >> 23) - 127;
    as_written double m = double(uintBitsToFloat((bits & 0x007fffffu) | 0x3f800000u));
    if (m > packDouble2x32(uvec2(0x667f3bcdu, 0x3ff6a09eu))) {
        m = m * 0.5lf;
        ++exponent;
    }
    as_written double s = (m - 1.0lf) / (m + 1.0lf);
    as_written double squared = s * s;
    as_written double series = 0.0lf;
    for (int n = 27; n >= 1; n -= 2) series = series * squared + 1.0lf / double(n);
    as_written double value = -(double(exponent) * log_of_2() + 2.0lf * (s * series));
    return float(value);
}
float exp_of_minus(float x) {
    if (!(x <= 105.0)) return 0.0;
    as_written double quotient = double(x) / log_of_2() + 0.5lf;
    int halvings = int(quotient);
    as_written double r = double(halvings) * log_of_2() - double(x);
    as_written double series = 1.0lf;
    for (int n = 14; n >= 1; --n) series = 1.0lf + series * r / double(n);
    as_written double value = series * packDouble2x32(uvec2(0u, uint(1023 - halvings) << 20));
    return float(value);
}
)";

// The same with the driver's functions and their rounding.
inline constexpr auto driver_log_exp_text = R"(
float minus_log(float x) { return -log(x); }
float exp_of_minus(float x) { return exp(-x); }
)";

// Pass 1: powers, multiplied from left to right.
inline constexpr auto build_moments_text = R"(
layout(location = 0) out float total;
layout(location = 1) out vec4 moments;
void main() {
    float absorbance = minus_log(max(1.0 - shade().a, 5.9604644775390625e-8));
    as_written float z = 2.0 * gl_FragCoord.z - 1.0;
    as_written float z2 = z * z;
    as_written float z3 = z2 * z;
    as_written float z4 = z3 * z;
    total = absorbance;
    as_written vec4 weighted = absorbance * vec4(z, z2, z3, z4);
    moments = weighted;
}
)";

// double share_before(b, z): as in peeling/programs/fixed_passes/moment_bound.h for n = 2.
inline constexpr auto share_text = R"(
const int n = 2;
void kernel_polynomial(double b[5], double z, out double kernel[3]) {
    as_written double lower[9], pivot[3], c[3];
    as_written double power = 1.0lf;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= i; ++j) {
            as_written double rest = b[i + j];
            for (int k = 0; k < j; ++k) rest = rest - lower[3 * i + k] * pivot[k] * lower[3 * j + k];
            if (i == j)
                pivot[i] = rest > 0.0lf ? rest : packDouble2x32(uvec2(0u, 0x3d700000u));
            else
                lower[3 * i + j] = rest / pivot[j];
        }
        c[i] = power;
        for (int k = 0; k < i; ++k) c[i] = c[i] - lower[3 * i + k] * c[k];
        power = power * z;
    }
    for (int i = 0; i <= n; ++i) c[i] = c[i] / pivot[i];
    for (int i = n; i >= 0; --i)
        for (int k = i + 1; k <= n; ++k) c[i] = c[i] - lower[3 * k + i] * c[k];
    kernel = c;
}
void real_roots(double given[3], out double roots[2]) {
    as_written double c[3] = given;
    as_written double x = 0.0lf;
    for (int i = 0; i < n; ++i) {
        as_written double quotient = c[i] / c[n];
        x = max(x, quotient < 0.0lf ? -quotient : quotient);
    }
    x = x + 1.0lf;
    for (int left = n; left > 0; --left) {
        for (int step = 0; step < 400; ++step) {
            as_written double value = c[left];
            as_written double slope = 0.0lf;
            for (int i = left - 1; i >= 0; --i) {
                slope = slope * x + value;
                value = value * x + c[i];
            }
            as_written double next = x - value / slope;
            if (next < x)
                x = next;
            else
                break;
        }
        roots[n - left] = x;
        for (int i = left - 2; i >= 0; --i) c[i + 1] = c[i + 1] + c[i + 2] * x;
        for (int i = 0; i < left; ++i) c[i] = c[i + 1];
    }
}
double share_before(double b[5], double z) {
    double kernel[3], roots[2];
    kernel_polynomial(b, z, kernel);
    real_roots(kernel, roots);
    double x[3] = double[3](z, roots[0], roots[1]);
    as_written double f[3] = double[3](0.25lf, x[1] < z ? 1.0lf : 0.0lf, x[2] < z ? 1.0lf : 0.0lf);
    for (int level = 1; level <= n; ++level)
        for (int i = n; i >= level; --i) f[i] = (f[i] - f[i - 1]) / (x[i] - x[i - level]);
    as_written double p[3] = double[3](f[n], 0.0lf, 0.0lf);
    for (int i = n - 1; i >= 0; --i) {
        for (int k = n; k > 0; --k) p[k] = p[k - 1] - p[k] * x[i];
        p[0] = f[i] - p[0] * x[i];
    }
    as_written double share = 0.0lf;
    for (int k = 0; k <= n; ++k) share = share + p[k] * b[k];
    return share > 0.0lf ? min(share, 1.0lf) : 0.0lf;
}
)";

// Pass 2.
inline constexpr auto accumulate_moments_text = R"(
uniform sampler2D total;
uniform sampler2D powers;
layout(location = 0) out vec4 sums;
float through(float z) {
    float all = texelFetch(total, TEXEL, 0).r;
    vec4 moments = texelFetch(powers, TEXEL, 0);
    if (!(all > 0.0)) return 1.0;
    double bias = double(5e-7);
    as_written double b[5];
    b[0] = 1.0lf;
    for (int m = 0; m < 4; ++m) {
        as_written float normalized = moments[m] / all;
        b[m + 1] = (1.0lf - bias) * double(normalized) + bias * (m % 2 == 0 ? 0.0lf : 0.375lf);
    }
    as_written float seen = all * float(share_before(b, double(z)));
    return exp_of_minus(seen);
}
void main() {
    vec4 c = shade();
    as_written float z = 2.0 * gl_FragCoord.z - 1.0;
    as_written float weight = c.a * through(z);
    as_written vec3 color = c.rgb * weight;
    sums = vec4(color, weight);
}
)";

}  // namespace strata::port
