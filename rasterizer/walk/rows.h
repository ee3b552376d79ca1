// rasterizer/walk/rows.h - passes that draw triangles directly into stored pixels, row by row and without batches: when
// they are possible, and the depth-only pass, which the rasterizer itself provides.
//
// Rule     The stored values and the counts of fragments and of passed fragments are those of batches that are tested
//          one after the other: TileRasterizer::draw is the definition.
// Tests    tests/rasterizer/walk/rows_test.cpp
#pragma once
#include <cstdint>
#include <span>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/plane.h"
#include "rasterizer/walk/depth_drawn.h"

namespace strata::rasterizer {

// The widest region that rows can walk: the largest tile.
inline constexpr int max_row_pixels = 128;
// Words after a region's last pixel. Rows read whole vectors there and write back what they read.
inline constexpr std::size_t row_padding = 8;
// Instruction sets with fewer lanes of binary64 are faster with batches and do not use rows.
inline constexpr std::size_t row_walk_lanes = 4;

// True if rows can replace the batches of `geometry` in `region` with the selected instruction set.
[[nodiscard]] bool row_walk_suits(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept;

// The same for a depth-only pass: draw_depth_rows also implements NV2A's window z.
[[nodiscard]] bool depth_rows_suit(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept;

// Every fragment of `triangles` (see TileRasterizer::draw) whose code is LESS than the stored one replaces it, in
// submission order. `codes` has the region's pixels row by row, followed by row_padding words. Precondition:
// depth_rows_suit.
DepthDrawn draw_depth_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;

// The two implementations: DepthPath::float32, and DepthPath::window_z by NV2A's rule.
DepthDrawn draw_float_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;
DepthDrawn draw_window_z_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                              const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;

// For the kernels: replaces values[i] by the exact plane at (x[i], y[i]) for every set bit i of `lanes`.
void decide_lanes(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index, const std::int32_t* x,
                  const std::int32_t* y, std::uint32_t lanes, float* values) noexcept;
// The filter of a plane of equal values: certain everywhere.
[[nodiscard]] FilterPlane constant_filter(const RationalPlane& plane, const Geometry& geometry,
                                          std::uint32_t index) noexcept;

}  // namespace strata::rasterizer
