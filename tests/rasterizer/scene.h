// tests/rasterizer/scene.h - random triangle soups in clip space.
#pragma once
#include "support.h"

namespace strata::rasterizer {

enum class SoupKind : std::uint8_t { flat, perspective, perspective_with_tiny_values, needs_clipping };

[[nodiscard]] inline RasterState scene_state(int width, int height) {
    RasterState state;
    state.viewport = {0, 0, width, height};
    return state;
}

[[nodiscard]] inline ClipVertex random_vertex(Random& random, SoupKind kind) {
    ClipVertex v;
    const float reach = kind == SoupKind::needs_clipping ? 3.0f : 1.0f;
    v.w = kind == SoupKind::flat ? 1.0f : random_float(random, 0.3f, 4);
    if (kind == SoupKind::needs_clipping) v.w = random_float(random, -1, 3);
    v.x = random_float(random, -reach, reach) * (kind == SoupKind::needs_clipping ? 2.0f : v.w);
    v.y = random_float(random, -reach, reach) * (kind == SoupKind::needs_clipping ? 2.0f : v.w);
    v.z = random_float(random, -reach, reach) * (kind == SoupKind::needs_clipping ? 2.0f : v.w);
    for (float& c : v.front) c = random_float(random, 0, 1);
    for (float& c : v.back) c = random_float(random, 0, 1);
    for (float& c : v.texcoord) c = random_float(random, -4, 4);
    if (kind == SoupKind::perspective_with_tiny_values) {
        v.front[1] = random_float(random, 0, 0x1p-140f);
        v.texcoord[0] = random_float(random, -0x1p-130f, 0x1p-130f);
    }
    return v;
}

// `triangles` triangles of their own vertices in two runs of materials 7 and 8, the second one mirrored and
// single-sided.
[[nodiscard]] inline TriangleSoup random_soup(std::uint64_t seed, int triangles, SoupKind kind) {
    Random random{seed};
    TriangleSoup soup;
    for (int i = 0; i < 3 * triangles; ++i) {
        soup.vertices.push_back(random_vertex(random, kind));
        soup.indices.push_back(static_cast<std::uint32_t>(i));
    }
    const auto half = static_cast<std::uint32_t>(triangles / 2 * 3);
    const auto all = static_cast<std::uint32_t>(triangles * 3);
    soup.runs = {{0, half, 7, 0, true, false}, {half, all - half, 8, 0, false, true}};
    return soup;
}

}  // namespace strata::rasterizer
