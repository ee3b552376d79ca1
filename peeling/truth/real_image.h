// peeling/truth/real_image.h - an image of binary64 values.
#pragma once
#include <vector>

namespace strata::pipeline {
struct Image;
}

namespace strata::peeling {

// Red, green and blue of every pixel, row by row.
struct RealImage {
    int width = 0, height = 0;
    std::vector<double> rgb;
    friend bool operator==(const RealImage&, const RealImage&) = default;
};

// The values of a colour image's codes.
[[nodiscard]] RealImage real_image(const pipeline::Image& image);

}  // namespace strata::peeling
