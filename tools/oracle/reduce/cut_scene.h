// tools/oracle/reduce/cut_scene.h - reduces a scene to some of its triangles, or to a part of its window.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vertices/draw_list.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::oracle {

// A triangle of a scene: the index of its instance, and its index in the mesh.
struct TriangleName {
    std::uint32_t instance = 0, triangle = 0;
    friend bool operator==(const TriangleName&, const TriangleName&) = default;
};

// In submission order without sorting.
[[nodiscard]] std::vector<TriangleName> triangles_of(const pipeline::DrawList& list);

// The scene with only those triangles, in their order, without the meshes, vertices, materials and textures that are no
// longer used.
[[nodiscard]] pipeline::DrawList cut(const pipeline::DrawList& list, std::span<const TriangleName> kept);

// The view that shows a rectangle of a window of width x height pixels in a window of the rectangle's size.
// It takes two products and a difference per entry in binary64, so triangles may snap slightly differently than in the
// whole window.
[[nodiscard]] pipeline::View through(const pipeline::View& view, int width, int height, const rasterizer::Rect& part);

}  // namespace strata::oracle
