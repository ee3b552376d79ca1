// peeling/truth/real_image.h - a picture of binary64 numbers.
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

// The values that the codes of a colour image stand for.
[[nodiscard]] RealImage real_image(const pipeline::Image& image);

}  // namespace strata::peeling
