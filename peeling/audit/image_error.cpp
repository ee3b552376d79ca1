// peeling/audit/image_error.cpp - sums over an image in a fixed order, and the logarithm of PSNR.
#include "peeling/audit/image_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/formats/half.h"
#include "pipeline/formats/packed.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The C library's logarithm differs between libraries, and reports are compared byte by byte, so PSNR uses this one.
// ln(x) of a positive normal number: ln(m) + e ln 2 with m in [2/3, 4/3), ln(m) = 2 atanh((m - 1) / (m + 1)).
double natural_log(double x) noexcept {
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // exact in binary64
    if (m < 2.0 / 3.0) {
        m *= 2;
        --exponent;
    }
    const double t = (m - 1) / (m + 1), square = t * t;
    double sum = 0;
    for (int term = 23; term >= 0; --term) sum = sum * square + 1.0 / (2 * term + 1);
    return 2 * t * sum + exponent * 0x1.62e42fefa39efp-1;
}

// Calls body row by row, red, green, blue: the order of the sums. Alpha is not compared.
template <class Body>
void for_each_difference(const Image& image, const Image& truth, Body&& body) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) body(x, y, c, channel_value(image, x, y, c) - channel_value(truth, x, y, c));
}

}  // namespace

// The value of a code (pipeline/reference/formats.md 2.2 and 3.1). Depth and stencil images are not colours.
double channel_value(const Image& image, int x, int y, int channel) {
    const std::uint32_t code = image.codes[image.index(x, y, channel)];
    if (is_packed(image.format)) return double{packed_value(image.format, channel, code, HalfRounding::nearest_even)};
    switch (info(image.format).type) {
        case ChannelType::unorm8: return static_cast<double>(code) / 255.0;
        case ChannelType::half: return double{half_to_float(static_cast<std::uint16_t>(code))};
        case ChannelType::single: return double{std::bit_cast<float>(code)};
        case ChannelType::unorm10:
        case ChannelType::depth:
        case ChannelType::stencil: break;
    }
    return 0;
}

double signal_to_noise(double rmse) { return 20.0 * natural_log(255.0 / rmse) / 0x1.26bb1bbb55516p+1; }  // ln 10

ImageError image_error(const Image& image, const Image& truth) {
    const FloatEnvironment ours;
    ImageError error;
    double sum = 0;
    for_each_difference(image, truth, [&](int, int, int, double difference) {
        const double codes = difference * 255.0;
        error.max_difference = std::max(error.max_difference, std::fabs(codes));
        sum += codes * codes;
    });
    error.rmse = std::sqrt(sum / (3.0 * image.width * image.height));
    if (error.rmse > 0) error.psnr = signal_to_noise(error.rmse);
    return error;
}

Image difference(const Image& image, const Image& truth) {
    const FloatEnvironment ours;
    Image result(Format::rgba32f, image.width, image.height);
    for_each_difference(image, truth, [&](int x, int y, int c, double value) {
        result.codes[result.index(x, y, c)] = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        result.codes[result.index(x, y, 3)] = std::bit_cast<std::uint32_t>(1.0f);
    });
    return result;
}

}  // namespace strata::peeling
