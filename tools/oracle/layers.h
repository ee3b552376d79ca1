// tools/oracle/layers.h - what became of the layers of one pixel.
//
// Rule     Layers are the parts of a file that have names, in the file's order. A pixel has those whose alpha is above
//          0 (any channel other than 0 where there is no alpha). Two layers are equal if their colours are, and their
//          depths where both files have them.
// Tests    tests/tools/oracle/compare_layers_test.cpp
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "tools/oracle/compare.h"

namespace strata::oracle {

struct LayerTarget {
    const Target* color = nullptr;
    const Target* depth = nullptr;  // null where the part has none
};

// Empty for a picture without named parts.
[[nodiscard]] std::vector<LayerTarget> layers_of(const Picture& picture);

// none: the layers are equal; color and depth: as many, and one of them differs so.
[[nodiscard]] Kind compare_layers(std::span<const LayerTarget> reference, std::span<const LayerTarget> candidate,
                                  std::size_t pixel);

}  // namespace strata::oracle
