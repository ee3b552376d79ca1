// tools/oracle/reduce/cut_scene.h - a scene with some of its triangles, or seen through a part of its window.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vertices/draw_list.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::oracle {

// A triangle of a scene: of which instance, and which of its mesh's.
struct TriangleName {
    std::uint32_t instance = 0, triangle = 0;
    friend bool operator==(const TriangleName&, const TriangleName&) = default;
};

// In the order in which they are submitted where nothing sorts them.
[[nodiscard]] std::vector<TriangleName> triangles_of(const pipeline::DrawList& list);

// The scene with those triangles alone, in their order; without the meshes, vertices, materials and textures that
// nothing needs then.
[[nodiscard]] pipeline::DrawList cut(const pipeline::DrawList& list, std::span<const TriangleName> kept);

// The view that shows the rectangle of a window of width x height pixels in a window of the rectangle's size.
// Numbers  Two products and a difference an entry in binary64: triangles may snap a little differently than in the
//          whole window.
[[nodiscard]] pipeline::View through(const pipeline::View& view, int width, int height, const rasterizer::Rect& part);

}  // namespace strata::oracle
