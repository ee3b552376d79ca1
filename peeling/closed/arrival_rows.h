// peeling/closed/arrival_rows.h - fragments put down pixel by pixel straight from the rasterizer's rows, without batches.
//
// Rule     A column holds the keys and colours that `append` of arrivals.h leaves for the batches of the same
//          triangles, each pixel's in the order of submission. Places differ: all fragments of a triangle of one colour
//          share one place.
// Tests    tests/peeling/closed/arrival_rows_test.cpp; tests/peeling/execution_test.cpp: against literal execution
#pragma once
#include <cstdint>
#include <span>

#include "peeling/closed/arrivals.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

// Puts down the fragments of `triangles` in `band`, whose first pixel is number 0, and adds their number to
// `fragments`. The arrays of `to` have room for rasterizer::row_padding words and places more than it says, before the
// first and behind the last. False if there was no room for a fragment; the contents of `to` are then incomplete.
[[nodiscard]] bool append_rows(Arrivals& to, const pipeline::RowSource& source,
                               std::span<const std::uint32_t> triangles, const rasterizer::Rect& band,
                               std::uint64_t& fragments) noexcept;

// Counts beforehand how much room append_rows will need. Adds to coverage[pixel] the number of fragments there (the
// array has row_padding entries behind the region's last pixel), and to places[y] the most places that the fragments of
// pixel row y take.
void count_rows(const pipeline::RowSource& source, const rasterizer::Rect& region, std::uint32_t* coverage,
                std::uint32_t* places) noexcept;

}  // namespace strata::peeling
