// tests/fuzz/other_frames.h - changes of a frame that must not change its picture: another position, additional state,
// another order; and the frames for which this is true.
#pragma once
#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

// Adds white texels, an offset of 0, a scissor as large as the viewport, and all effects.
void add_idle_state(FrameCase& frame);

// Moves the viewport by whole tiles of every size. Only for devices whose planes are exact, not stepped from pixel to
// pixel.
inline constexpr int tiles_x = 384, tiles_y = 128;
[[nodiscard]] bool can_move(const FrameCase& frame);
void move_by_tiles(FrameCase& frame);

// True if no two transparent fragments of a pixel have equal depths and the algorithm orders them by depth alone.
[[nodiscard]] bool has_order_by_depth(const FrameCase& frame);
// Changes the order of the transparent instances and of the triangles in each.
void permute_triangles(FrameCase& frame);

}  // namespace strata::fuzz
