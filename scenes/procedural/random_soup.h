// scenes/procedural/random_soup.h - random triangles for tests: all sizes, facings and alphas, and exact ties.
//
// Rule     Corners are on a grid of 1/8192 in [-1, 1]^3. On average, of 16 triangles one repeats the last new one, one
//          repeats it with the opposite facing, one is in its plane with sides of half the length, one is parallel to
//          the xy plane at a multiple of 1/8; the others are new, in a box of half side 1 to 1/64. A quarter have one
//          colour per corner, the others one colour; one colour in eight has alpha 1, the others more than 0. Unlit,
//          two-sided, BLEND. Only integers are used, so nothing is rounded.
// Source   splitmix64 (Steele, Lea, Flood 2014), seeded with the parameter itself.
// Tests    tests/scenes/procedural/random_soup_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_random_soup(const SceneOptions& options, std::uint64_t seed, std::uint32_t triangles);

}  // namespace strata::scenes
