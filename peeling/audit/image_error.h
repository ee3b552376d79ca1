// peeling/audit/image_error.h - the error of an image against the truth: largest difference, root mean square, peak
// signal-to-noise ratio.
//
// Rule     Over red, green and blue, in units of 1/255 of the frame's colour values. Sums run in row-major order in
//          binary64. PSNR = 20 log10(255 / rmse) decibels: absent if nothing differs.
// Numbers  The logarithm is a sum of 24 terms of the series of atanh in a fixed order, so its bits are the same
//          everywhere; its relative error is below 2^-48.
// Tests    tests/peeling/audit/image_error_test.cpp
#pragma once
#include <optional>
#include <vector>

#include "pipeline/formats/image.h"

namespace strata::peeling {

struct ImageError {
    double max_difference = 0, rmse = 0;  // in 1/255
    std::optional<double> psnr;           // in decibels
    friend bool operator==(const ImageError&, const ImageError&) = default;
};

// PSNR of a root mean square error above 0, in 1/255.
[[nodiscard]] double signal_to_noise(double rmse);

// Colour images of equal size; their colour formats may differ.
[[nodiscard]] ImageError image_error(const pipeline::Image& image, const pipeline::Image& truth);

// image - truth, as rgba32f with alpha 1.
[[nodiscard]] pipeline::Image difference(const pipeline::Image& image, const pipeline::Image& truth);

// The value of one channel of one pixel as a number.
[[nodiscard]] double channel_value(const pipeline::Image& image, int x, int y, int channel);

}  // namespace strata::peeling
