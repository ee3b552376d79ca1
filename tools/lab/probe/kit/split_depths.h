// tools/lab/probe/kit/split_depths.h - searches a triangle for which two candidates for the NV2A's reciprocal give
// different window depths.
//
// Rule     The two differ in the reciprocal of the area, which changes the last bit of a 24-bit depth at few pixels:
//          for a difference of 2^-32 in the deficit at one pixel of 256 (window_z.h, truncated_weights.h). So a
//          suitable triangle is searched at random.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "rasterizer/rules/depth_hypothesis.h"
#include "tools/lab/probe/kit/random_generator.h"

namespace strata::probe {

// Corners in 1/16 pixel within 8 x 8 pixels, and their depths from -1 to 1.
struct SplitDepths {
    std::array<int, 3> x{}, y{};
    std::array<float, 3> z{};
};

using TwoReciprocals = std::pair<rasterizer::DepthHypothesis, rasterizer::DepthHypothesis>;

// Neighbours: reciprocals whose deficit differs by one unit, or by one bit from the exact area's.
[[nodiscard]] std::vector<TwoReciprocals> neighbouring_reciprocals();

// Empty if none is found soon.
[[nodiscard]] std::optional<SplitDepths> split_depths(RandomGenerator& random, const TwoReciprocals& two);

}  // namespace strata::probe
