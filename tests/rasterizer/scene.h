// tests/rasterizer/scene.h - random triangle soups in clip space, and random triangles in the window.
#pragma once
#include "tests/rasterizer/support.h"

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

// `triangles` triangles with separate vertices in two runs of materials 7 and 8; the second run is mirrored and
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

struct Device {
    RasterRules rules;
    DepthRequest depth;
};

// Triangles of about `size` pixels, every fourth a sliver, with corners on or next to the subpixels of `rules`.
[[nodiscard]] inline Geometry random_triangles(std::uint64_t seed, int count, int size, const Device& device) {
    Random random{seed};
    const int unit = 1 << device.rules.subpixel_bits;
    const auto coordinate = [&](int middle, int reach) {
        return std::clamp(middle + random_int(random, -reach * unit, reach * unit), -32767 * unit, 32767 * unit);
    };
    std::vector<SetupTriangle> triangles;
    for (int i = 0; i < count; ++i) {
        const int x = random_int(random, 0, 70 * unit), y = random_int(random, 0, 40 * unit);
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& q : p) q = {coordinate(x, size), i % 4 == 0 ? y : coordinate(y, size)};
        if (i % 4 == 0) p[2].y += random_int(random, 1, unit);
        if (Edge{p[0], p[1]}.at(p[2]) == 0) continue;
        const auto value = [&] { return random_float(random, 0.1f, 1); };
        SetupTriangle t = window_triangle(p, device.rules.subpixel_bits, {value(), value(), value()});
        if (i % 5 == 0) t.z = {value(), t.z[0], t.z[0]};
        for (std::size_t k = 0; k < 3; ++k) {
            if (device.rules.window_z == WindowZ::buffer_units) t.z[k] = static_cast<float>(t.z[k] * 0xffffff);
            t.unsnapped[k][0] += random_float(random, -0.001f, 0.001f);
            t.inverse_w[k] = i % 3 == 0 ? 1 : value();
            for (float& u : t.attribute[k]) u = i % 7 == 0 ? 0.25f : value();
        }
        t.material = static_cast<std::uint32_t>(i / 40);
        triangles.push_back(t);
    }
    Geometry geometry = window_geometry(triangles, 70, 40, device.rules);
    geometry.state.depth_format = device.depth.format;
    return geometry;
}

}  // namespace strata::rasterizer
