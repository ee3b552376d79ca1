// peeling/closed/arrival_rows.h - fragments put down pixel by pixel straight from the rasterizer's rows, without batches.
//
// Rule     What comes up again is what `append` of arrivals.h leaves of the same triangles' batches: the same keys and colours, a
//          pixel's in the order of submission. Places are others: a triangle of one colour has one place for all its fragments.
// Tests    tests/peeling/closed/arrival_rows_test.cpp; tests/peeling/execution_test.cpp: against literal execution
#pragma once
#include <cstdint>
#include <span>

#include "peeling/closed/arrivals.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

// Puts the fragments of `triangles` in `band` down; pixels count from the band's first, and `to` has rasterizer::row_padding words
// and places more than it says, behind the last and before the first. Adds how many there were to `fragments`. False if there was
// no room for one of them: then `to` is of no more use.
[[nodiscard]] bool append_rows(Arrivals& to, const pipeline::RowSource& source,
                               std::span<const std::uint32_t> triangles, const rasterizer::Rect& band,
                               std::uint64_t& fragments) noexcept;

// What that needs of `region`: coverage[pixel] += its fragments, of which there are row_padding more; places[row] += the places that
// they take at most.
void count_rows(const pipeline::RowSource& source, const rasterizer::Rect& region, std::uint32_t* coverage,
                std::uint32_t* places) noexcept;

}  // namespace strata::peeling
