// tools/oracle/pack/draw_json.h - the objects of "draws" in a pack: triangles as passes draw them, in clip space and
// snapped.
//
// Rule     tools/oracle/PACK.md. The arrays are those of the machine itself: pipeline::transform and
//          rasterizer::set_up.
// Tests    tests/tools/oracle/pack_draws_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "scenes/packs/pack_files.h"
#include "tools/oracle/passes.h"

namespace strata::oracle {

// Of the opaque and of the transparent list, those that hold a triangle.
[[nodiscard]] nlohmann::ordered_json draws_json(const RunInput& input, scenes::PackFiles& files);

// The numbers of the transparent list's triangles in the order in which `order` submits them; empty: as listed.
[[nodiscard]] std::vector<std::uint32_t> submission_of(const RunInput& input, peeling::ListOrder order);

}  // namespace strata::oracle
