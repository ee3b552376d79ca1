// tests/fuzz/scene_of_bytes.h - the scene of a case: few triangles, with all kinds of difficult geometry.
#pragma once
#include "pipeline/vertices/draw_list.h"
#include "tests/fuzz/byte_source.h"

namespace strata::fuzz {

[[nodiscard]] pipeline::View view_of(ByteSource& bytes);
// For a frame of this size in pixels: some meshes have their corners on pixel corners and centres.
[[nodiscard]] pipeline::DrawList list_of(ByteSource& bytes, const pipeline::View& view, int width, int height);

}  // namespace strata::fuzz
