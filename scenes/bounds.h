// scenes/bounds.h - the world-space bounding box of a draw list.
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

// Every vertex that an index refers to, transformed in binary64; non-finite vertices are ignored.
[[nodiscard]] Bounds bounds_of(const pipeline::DrawList& list);

}  // namespace strata::scenes
