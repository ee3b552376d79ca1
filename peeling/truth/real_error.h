// peeling/truth/real_error.h - the error of one image of binary64 values against another.
//
// Rule     Over red, green and blue: largest difference and root mean square in units of 1/255, PSNR = 20 log10(255 /
//          rmse) decibels (absent if nothing differs). A pixel differs if any of its values does. SSIM: of the mean of
//          the three channels, in windows of 8 by 8 pixels every 4 pixels inside the image (one window over a smaller
//          image), C1 = 0.01^2, C2 = 0.03^2, averaged over the windows. Sums run in row-major order in binary64.
// Source   Wang et al. 2004, "Image Quality Assessment: From Error Visibility to Structural Similarity" (the formula;
//          square windows without weights differ from the paper's).
// Tests    tests/peeling/truth/real_error_test.cpp
#pragma once
#include <optional>

#include "peeling/truth/real_image.h"

namespace strata::peeling {

struct RealError {
    double max_difference = 0, rmse = 0;  // in 1/255
    std::optional<double> psnr;           // in decibels
    double pixels = 0;                    // the fraction of pixels that differ
    double ssim = 1;
    friend bool operator==(const RealError&, const RealError&) = default;
};

// Both images must have the same size.
[[nodiscard]] RealError real_error(const RealImage& image, const RealImage& truth);

}  // namespace strata::peeling
