// tests/fuzz/other_frames.h - frames in another place, with more state or in another order, that must stay the same
// picture; and for which frames that may be asked.
#pragma once
#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

// White texels, an offset of 0, a scissor as large as the viewport, and all effects.
void add_idle_state(FrameCase& frame);

// The viewport further by whole tiles of every size: asked of devices whose planes are exact, not stepped from pixel to
// pixel.
inline constexpr int tiles_x = 384, tiles_y = 128;
[[nodiscard]] bool can_move(const FrameCase& frame);
void move_by_tiles(FrameCase& frame);

// No two transparent fragments of a pixel have one depth, and the algorithm takes them by their depth alone.
[[nodiscard]] bool has_order_by_depth(const FrameCase& frame);
// Transparent instances in another order, and the triangles of each.
void permute_triangles(FrameCase& frame);

}  // namespace strata::fuzz
