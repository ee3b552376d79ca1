// tools/oracle/pack/draw_json.h - the objects of "draws" in a pack: the triangles that passes draw, in clip space and
// snapped.
//
// Rule     tools/oracle/pack/PACK.md. The arrays come from pipeline::transform and rasterizer::set_up.
// Tests    tests/tools/oracle/pack/pack_draws_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "scenes/packs/pack_files.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

// For the opaque and the transparent list, unless empty.
[[nodiscard]] nlohmann::ordered_json draws_json(const peeling::FrameRequest& input, scenes::PackFiles& files);

// The indices of the transparent list's triangles in the submission order `order`; empty: as listed.
[[nodiscard]] std::vector<std::uint32_t> submission_of(const peeling::FrameRequest& input, peeling::ListOrder order);

}  // namespace strata::oracle
