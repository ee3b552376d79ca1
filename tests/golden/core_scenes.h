// tests/golden/core_scenes.h - five small scenes made without a file, a library or a rounding: what the core alone can
// draw.
#pragma once
#include <vector>

#include "tests/golden/golden.h"

namespace strata::golden {

// soup, stack, crossing, ties, textured. Coordinates are small binary fractions, the projection's entries too.
[[nodiscard]] std::vector<GoldenScene> core_scenes();

}  // namespace strata::golden
