// scenes/far_places.h - scenes whose coordinates are large, as those of maps: a warning, and their move to the origin.
//
// Rule     The step of a mesh is the distance between neighbouring binary32 numbers at its largest coordinate. A mesh
//          whose step is more than a thousandth of its size has lost its shape, and a warning says so.
//          recentre: a mesh that is farther from its origin than its size is moved by the least corner of its bounds,
//          which its instances get back in binary64; then instances, cameras, the scene's own view and
//          lights are moved so that the middle of the scene's bounds is the origin.
// Tests    tests/scenes/far_places_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

// The step of binary32 at numbers of this magnitude.
[[nodiscard]] double step_at(double magnitude) noexcept;

void warn_of_far_places(Scene& scene);

void recentre(Scene& scene);

}  // namespace strata::scenes
