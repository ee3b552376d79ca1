// peeling/truth/real_error.cpp - difference, PSNR and SSIM of two images of binary64 values (real_error.h).
#include "peeling/truth/real_error.h"

#include <algorithm>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::peeling {

namespace {

[[nodiscard]] std::size_t place(const RealImage& image, int x, int y) {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

[[nodiscard]] double grey(const RealImage& image, int x, int y) {
    const double* const c = &image.rgb[place(image, x, y)];
    return ((c[0] + c[1]) + c[2]) / 3;
}

[[nodiscard]] double similarity(const RealImage& a, const RealImage& b, const rasterizer::Rect& window) {
    double sum_a = 0, sum_b = 0, squares_a = 0, squares_b = 0, products = 0;
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x) {
            const double u = grey(a, x, y), v = grey(b, x, y);
            sum_a += u;
            sum_b += v;
            squares_a += u * u;
            squares_b += v * v;
            products += u * v;
        }
    const auto n = static_cast<double>(window.area());
    const double mean_a = sum_a / n, mean_b = sum_b / n;
    const double spread_a = squares_a / n - mean_a * mean_a, spread_b = squares_b / n - mean_b * mean_b;
    const double together = products / n - mean_a * mean_b;
    constexpr double c1 = 1e-4, c2 = 9e-4;
    return (2 * mean_a * mean_b + c1) * (2 * together + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (spread_a + spread_b + c2));
}

[[nodiscard]] double mean_similarity(const RealImage& a, const RealImage& b) {
    constexpr int side = 8, step = 4;
    const int wide = std::min(side, a.width), high = std::min(side, a.height);
    double sum = 0;
    int windows = 0;
    for (int y = 0; y + high <= a.height; y += step)
        for (int x = 0; x + wide <= a.width; x += step, ++windows) sum += similarity(a, b, {x, y, x + wide, y + high});
    return sum / windows;
}

}  // namespace

RealError real_error(const RealImage& image, const RealImage& truth) {
    const FloatEnvironment ours;
    RealError error;
    double sum = 0;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        bool differs = false;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double codes = (image.rgb[c] - truth.rgb[c]) * 255.0;
            error.max_difference = std::max(error.max_difference, std::fabs(codes));
            sum += codes * codes;
            differs |= codes != 0;
        }
        differing += differs ? 1 : 0;
    }
    const auto numbers = static_cast<double>(image.rgb.size());
    error.rmse = std::sqrt(sum / numbers);
    if (error.rmse > 0) error.psnr = signal_to_noise(error.rmse);
    error.pixels = 3 * static_cast<double>(differing) / numbers;
    error.ssim = differing == 0 ? 1 : mean_similarity(image, truth);
    return error;
}

}  // namespace strata::peeling
