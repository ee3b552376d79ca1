// scenes/procedural/splats.h - a teapot as a cloud of points, each with a soft round texture.
//
// Rule     Points lie at random places of random triangles of the teapot's pot, in the order of their numbers; a colour
//          is the normal's, (n + 1) / 2, with alpha 1/2. The texture is white, 16 x 16 texels, with alpha 1 - r^2
//          within the circle. It covers each point with --point-sprites; else a point has its middle texel.
// Source   scenes/reference/scenes.md 15
// Tests    tests/scenes/procedural/splats_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_splats(const SceneOptions& options, std::uint64_t seed, std::uint32_t points);

}  // namespace strata::scenes
