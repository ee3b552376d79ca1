// scenes/bounds.h - the world-space box round everything that a draw list draws.
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

// Every vertex that an index names, transformed in binary64; non-finite ones do not count.
[[nodiscard]] Bounds bounds_of(const pipeline::DrawList& list);

}  // namespace strata::scenes
