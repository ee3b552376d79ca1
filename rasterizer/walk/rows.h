// rasterizer/walk/rows.h - passes that draw triangles straight into what is stored, row by row and without batches:
// when they are possible, and the one that the rasterizer has itself, a pass of depth alone.
//
// Rule     What is left at a pixel, and how many fragments there were and passed, is what batches would leave that are
//          tested one after the other: TileRasterizer::draw is the definition.
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
// Words behind a region's last pixel. Rows read whole vectors there, and write back what they read.
inline constexpr std::size_t row_padding = 8;
// Sets with fewer lanes of binary64 are faster with batches: they walk no rows.
inline constexpr std::size_t row_walk_lanes = 4;

// Whether rows can do what the batches of `geometry` would hold, in `region` and on the chosen instruction set.
[[nodiscard]] bool row_walk_suits(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept;

// The same for a pass of depth alone: draw_depth_rows knows the chip's window z, too.
[[nodiscard]] bool depth_rows_suit(const Geometry& geometry, const DepthRequest& depth, const Rect& region) noexcept;

// Every fragment of `triangles` (as TileRasterizer::draw takes them) whose code is LESS than the stored one replaces
// it, in submission order. `codes`: the region's pixels row by row, and row_padding words more. Only where
// depth_rows_suit.
DepthDrawn draw_depth_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;

// Its two ways: DepthPath::float32, and DepthPath::window_z by the chip's rule.
DepthDrawn draw_float_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;
DepthDrawn draw_window_z_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                              const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept;

// For the kernels. Replaces values[i] by the exact plane at (x[i], y[i]), for every bit i of `lanes`.
void decide_lanes(const RationalPlane& plane, const Geometry& geometry, std::uint32_t index, const std::int32_t* x,
                  const std::int32_t* y, std::uint32_t lanes, float* values) noexcept;
// A plane of equal values as the filter sees it: certain everywhere.
[[nodiscard]] FilterPlane constant_filter(const RationalPlane& plane, const Geometry& geometry,
                                          std::uint32_t index) noexcept;

}  // namespace strata::rasterizer
