// tools/probe/split_depths.h - a triangle on which two of the chip's reciprocals give different window depths.
//
// Rule     Its area's reciprocal differs between the two, which the last bit of a depth of 24 bits shows at a pixel: by
//          one unit of 2^-32 in a reciprocal's deficit at one pixel of 256 (window_z.h, cut_weight.h). So the triangle
//          is sought.
// Tests    tests/tools/probe/kit_test.cpp
#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "rasterizer/rules/depth_hypothesis.h"
#include "tools/probe/dice.h"

namespace strata::probe {

// Corners in 1/16 pixel within 8 x 8 pixels, and their depths from -1 to 1.
struct SplitDepths {
    std::array<int, 3> x{}, y{};
    std::array<float, 3> z{};
};

using TwoReciprocals = std::pair<rasterizer::DepthHypothesis, rasterizer::DepthHypothesis>;

// Neighbours: reciprocals that differ by one unit of the deficit, or of an exact area by one bit.
[[nodiscard]] std::vector<TwoReciprocals> neighbouring_reciprocals();

// None if chance finds none soon.
[[nodiscard]] std::optional<SplitDepths> split_depths(Dice& dice, const TwoReciprocals& two);

}  // namespace strata::probe
