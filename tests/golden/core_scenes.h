// tests/golden/core_scenes.h - five small scenes made without files, libraries or rounding, which the core alone can
// draw.
#pragma once
#include <vector>

#include "tests/golden/golden.h"

namespace strata::golden {

// soup, stack, crossing, ties, textured. Coordinates and the projection's entries are small binary fractions.
[[nodiscard]] std::vector<GoldenScene> core_scenes();

}  // namespace strata::golden
