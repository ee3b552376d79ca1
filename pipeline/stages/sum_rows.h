// pipeline/stages/sum_rows.h - adds weighted sums of fragments directly to halves or binary32, row by row: the result
// of an additive pass of (c a, a) and 1 through batches, programs and blending. By default it replaces the draw of
// weighted_average and weighted_sum (peeling/algorithms/) on instruction sets that convert halves.
//
// Rule     Each fragment of the triangles, in submission order, whose code is LESS than the opaque one adds (c a, a) to
//          the sums and 1 to the count: halves like add_halves of lane_words.h, binary32 like blend_float.h with both
//          factors 1. Colours are those of PlaneAttributes.
// Tests    tests/peeling/execution/execution_test.cpp compares with literal execution.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "rasterizer/walk/rows.h"

namespace strata::pipeline {

enum class SumWords : std::uint8_t { halves, binary32 };

// One word per pixel of a region, row by row, followed by rasterizer::row_padding more words. Of two halves in a word,
// the first is the low one.
struct SumPlanes {
    SumWords words;
    // Halves: the sums of r a and g a share a word, those of b a and a are in the next plane. Binary32: one plane each.
    std::array<std::uint32_t*, 4> sums;
    // The count: binary32, or a half in the low bits with 0 in the high ones; null: not requested.
    std::uint32_t* count;
    // Depth codes of the opaque surfaces; null: every fragment passes.
    const std::uint32_t* opaque = nullptr;
    // DenormalRule::flush.
    bool flushes = false;
};

// Preconditions: rasterizer::row_walk_suits, which excludes instruction sets without half conversion, and colours are
// exact planes.
rasterizer::DepthDrawn add_sum_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                    const rasterizer::DepthRequest& depth, const rasterizer::Rect& region,
                                    const SumPlanes& planes) noexcept;

}  // namespace strata::pipeline
