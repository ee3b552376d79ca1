// pipeline/fragments/record_rows.h - records the fragments of a tile row by row instead of batch by batch.
//
// Rule     The record is that of TileFragments::append for the batches of TileRasterizer::draw: the same fragments in
//          the same order with the same values. Rows provide depths, codes and colours by exact planes; they do not
//          support textures or MASK.
// Tests    tests/pipeline/fragments/record_rows_test.cpp
#pragma once
#include <cstdint>
#include <span>

#include "pipeline/fragments/tile_fragments.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// True if rows provide the values that `needs` names.
[[nodiscard]] constexpr bool rows_have(const rasterizer::FragmentNeeds& needs) noexcept {
    return !needs.exact_code && !needs.reference && !needs.texcoord && !needs.facing && !needs.has_extras();
}

// Adds the fragments of `triangles` in `region` to a record that has been started, and returns their number.
// Preconditions: rasterizer::row_walk_suits, and rows_have of the recorded values.
std::uint64_t record_rows(TileFragments& to, const rasterizer::Geometry& geometry,
                          std::span<const std::uint32_t> triangles, const rasterizer::DepthRequest& depth,
                          const rasterizer::Rect& region);

}  // namespace strata::pipeline
