// pipeline/stages/sum_rows.h - weighted sums of fragments straight into halves or binary32, row by row: what an
// additive pass of (c a, a) and 1 does through batches, programs and blending. It runs by default in place of the draw
// of weighted_average and weighted_sum (peeling/algorithms/), on sets that convert halves.
//
// Rule     Each fragment of the triangles, in submission order, whose code is LESS than the opaque one adds (c a, a) to
//          the sums and 1 to the count: halves as add_halves of lane_words.h adds, binary32 as blend_float.h adds with
//          both factors 1. Colours are those of FragmentValues::fill.
// Tests    tests/peeling/execution_test.cpp: against literal execution
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "rasterizer/walk/rows.h"

namespace strata::pipeline {

enum class SumWords : std::uint8_t { halves, binary32 };

// A region's pixels row by row, a word each, with rasterizer::row_padding more behind the last; of two halves the low
// one is first.
struct SumPlanes {
    SumWords words;
    // Halves: the sums of r a and g a share a word, those of b a and a the next plane's. Binary32: a plane each.
    std::array<std::uint32_t*, 4> sums;
    // The count, or in the low half its half and 0 in the high one; null: not wanted.
    std::uint32_t* count;
    // Depth codes of the opaque surfaces; null: every fragment passes.
    const std::uint32_t* opaque = nullptr;
    // DenormalRule::flush.
    bool flushes = false;
};

// Only where rasterizer::row_walk_suits, which leaves out the sets that convert no halves, and where colours are exact
// planes.
rasterizer::DepthDrawn add_sum_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                    const rasterizer::DepthRequest& depth, const rasterizer::Rect& region,
                                    const SumPlanes& planes) noexcept;

}  // namespace strata::pipeline
