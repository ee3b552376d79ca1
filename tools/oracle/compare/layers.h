// tools/oracle/compare/layers.h - compares the layers of one pixel.
//
// Rule     Layers are the named parts of a file, in the file's order. A pixel has the layers whose alpha is above 0
//          (without alpha: with any nonzero channel). Two layers are equal if their colours are, and their depths if
//          both files have them.
// Tests    tests/tools/oracle/compare/compare_layers_test.cpp
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "tools/oracle/compare/compare.h"

namespace strata::oracle {

struct LayerTarget {
    const TargetImage* color = nullptr;
    const TargetImage* depth = nullptr;  // null if the part has none
};

// Empty for an image without named parts.
[[nodiscard]] std::vector<LayerTarget> layers_of(const Picture& picture);

// none: the layers are equal; color or depth: the number is the same, and one layer differs in that way.
[[nodiscard]] Kind compare_layers(std::span<const LayerTarget> reference, std::span<const LayerTarget> candidate,
                                  std::size_t pixel);

}  // namespace strata::oracle
