// tools/oracle/picture/read_deep.h - converts a deep EXR part to layers: the first layer is each pixel's nearest
// sample, and so on.
//
// Rule     Samples are sorted by Z, those of equal Z in the file's order; a part without Z keeps the file's order, and
//          NaN comes last. A pixel with fewer samples has zeros in the remaining layers. R, G, B and A are a layer's
//          colour, Z is its depth; other channels are ignored.
// Tests    tests/tools/oracle/picture/read_deep_test.cpp
#pragma once
#include <string>
#include <vector>

#include "scenes/exr/parts.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// InputError, which names `path`, for a part without R, G, B or A of one type, and for more than 2^26 samples in all
// layers.
[[nodiscard]] std::vector<TargetImage> layers_of_deep(const scenes::StoredPart& part, const std::string& path);

}  // namespace strata::oracle
