// tests/rasterizer/dense.h - soups of many triangles of few pixels, as in dense meshes: they are set up and drawn in
// full groups.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/rasterizer/scene.h"

namespace strata::rasterizer {

struct DenseCase {
    TriangleSoup soup;
    RasterState state;
    RasterRules rules;
};

// A grid of cells of about `size` pixels over and beyond a window of 70 x 40, twice, one behind the other. Every 97th
// cell is larger, every 11th corner is on a pixel centre or on the previous corner, and points and lines follow at the
// end.
[[nodiscard]] inline TriangleSoup dense_soup(std::uint64_t seed, float size) {
    Random random{seed};
    TriangleSoup soup;
    const auto columns = static_cast<int>(84 / size), rows = static_cast<int>(48 / size);
    std::uint32_t corners = 0;
    const auto corner = [&](int column, int row, float depth) {
        const float x = (static_cast<float>(column) + random_float(random, -0.4f, 0.4f)) * size - 7;
        const float y = (static_cast<float>(row) + random_float(random, -0.4f, 0.4f)) * size - 4;
        const float w = random_float(random, 0.5f, 2);
        const bool is_centre = corners % 11 == 0;
        const float px = is_centre ? std::floor(x) + 0.5f : x, py = is_centre ? std::floor(y) + 0.5f : y;
        ClipVertex v{
            .x = (px / 35 - 1) * w, .y = (1 - py / 20) * w, .z = (depth + random_float(random, 0, 0.2f)) * w, .w = w};
        for (float& c : v.front) c = corners % 5 == 0 ? 0.5f : random_float(random, 0, 1);
        for (float& c : v.back) c = corners % 7 < 4 ? 0.25f : random_float(random, 0, 1);
        if (corners % 31 == 0 && corners > 0) v = soup.vertices.back();
        soup.vertices.push_back(v);
        return corners++;
    };
    for (int layer = 0; layer < 2; ++layer)
        for (int i = 0; i < columns * rows; ++i) {
            const int far = i % 97 == 0 ? 6 : 1, column = i % columns, row = i / columns;
            const float depth = layer == 0 ? 0.4f : -0.3f;
            const std::uint32_t a = corner(column, row, depth), b = corner(column + far, row, depth);
            const std::uint32_t c = corner(column, row + far, depth), d = corner(column + far, row + far, depth);
            for (const std::uint32_t v : {a, b, c, d, c, b}) soup.indices.push_back(v);
        }
    const auto half = static_cast<std::uint32_t>(soup.indices.size() / 6 * 3),
               all = static_cast<std::uint32_t>(soup.indices.size());
    soup.runs = {{0, half, 7, 0, true, false}, {half, all - half, 8, 1, false, true}};
    return soup;
}

// In a window of 70 x 40: corners then share rows and columns, and many areas are powers of two.
inline void move_to_half_pixels(TriangleSoup& soup) {
    const auto moved = [](float x, float w, float half_window) {
        return (std::round(2 * (x / w + 1) * half_window) / (2 * half_window) - 1) * w;
    };
    for (ClipVertex& v : soup.vertices) v.x = moved(v.x, v.w, 35), v.y = moved(v.y, v.w, 20);
}

[[nodiscard]] inline std::vector<DenseCase> dense_cases() {
    std::vector<DenseCase> cases;
    for (const float size : {0.7f, 1.5f, 3.0f})
        for (const TieRule tie : {TieRule::top_left, TieRule::bottom_left, TieRule::top_right, TieRule::bottom_right})
            for (const CullFace cull : {CullFace::none, CullFace::front, CullFace::back}) {
                DenseCase one{dense_soup(701 + cases.size(), size), scene_state(70, 40), {.tie_rule = tie}};
                one.state.cull = cull;
                one.rules.subpixel_bits = tie == TieRule::top_right ? 4 : 8;
                if (tie == TieRule::bottom_left) one.rules.plane_origin = PlaneOrigin::unsnapped;
                if (cull == CullFace::front) one.state.viewport = {3, 2, 73, 42};
                if (cull == CullFace::back) one.state.scissor = Rect{9, 5, 60, 33};
                cases.push_back(one);
            }
    return cases;
}

}  // namespace strata::rasterizer
