// tools/oracle/explain/fragment_facts.h - facts about a fragment that follow from its triangle alone: its mesh, its
// barycentric coordinates, and its depth by every path.
#pragma once
#include <span>

#include "tools/oracle/explain/history.h"

namespace strata::oracle {

// Fills mesh, triangle, barycentric and path_codes of the facts of each history; `histories` are the rectangle's pixels
// row by row.
void add_facts(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const rasterizer::Rect& pixels,
               std::span<History> histories);

}  // namespace strata::oracle
