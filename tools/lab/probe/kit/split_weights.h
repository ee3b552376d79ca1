// tools/lab/probe/kit/split_weights.h - searches a triangle for which two candidates for the NV2A's reciprocal give
// different 8-bit weights.
//
// Rule     The weight of one corner at a pixel is within a relative 2^-24 of a whole number of 256ths: its w is solved
//          for that, and rounded. The last bits of the reciprocal decide to which side the weight is truncated
//          (color_weights.h).
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <array>
#include <optional>

#include "tools/lab/probe/kit/random_generator.h"

namespace strata::probe {

// Corners in 1/16 pixel within 8 x 8 pixels, and their w.
struct SplitTriangle {
    std::array<int, 3> x{}, y{};
    std::array<float, 3> w{};
};

// Empty if none is found soon.
[[nodiscard]] std::optional<SplitTriangle> split_triangle(RandomGenerator& random);

}  // namespace strata::probe
