// tools/probe/split_weights.h - a triangle on which two of the chip's reciprocals give different 8-bit weights.
//
// Rule     The weight of one corner at a pixel lies within 2^-24 of itself of a whole number of 256ths: its w is solved
//          for that, and rounded. The last bits of the reciprocal decide on which side the cut weight comes to lie
//          (color_weights.h).
// Tests    tests/tools/probe/kit_test.cpp
#pragma once
#include <array>
#include <optional>

#include "tools/probe/dice.h"

namespace strata::probe {

// Corners in 1/16 pixel within 8 x 8 pixels, and their w.
struct SplitTriangle {
    std::array<int, 3> x{}, y{};
    std::array<float, 3> w{};
};

// None if chance finds none soon.
[[nodiscard]] std::optional<SplitTriangle> split_triangle(Dice& dice);

}  // namespace strata::probe
