// tools/oracle/program/drawing/opaque_pass.h - what a port may have done to its opaque surfaces: other lists of the
// scene, each with a sentence.
//
// Rule     Of a pixel's opaque fragments some are lost, and one of the others stays: the nearest, the farthest, the
//          last or the first drawn, by depths of fewer bits. Layers are tested against the one that stays, the right
//          one, or none. The lost ones meet a condition on their properties, or a layer that writes depth hides them.
//          All of these are scored on a sample; the best are given as lists.
// Tests    tests/tools/oracle/program/drawing_test.cpp: pictures by plain code on lists of the test
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/program/drawing/surfaces.h"
#include "tools/oracle/program/properties.h"

namespace strata::oracle::program {

// The lists of a scene that is drawn in another way.
struct OtherLists {
    std::string words{};
    double price = 0;  // bits
    Lists lists{};
};

// The best few.
[[nodiscard]] std::vector<OtherLists> other_opaque_passes(const SceneSurfaces& surfaces);

}  // namespace strata::oracle::program
