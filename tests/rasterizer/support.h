// tests/rasterizer/support.h - scenes given by window positions, and the fragments of a draw as a plain list.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::rasterizer {

using Random = std::mt19937_64;

[[nodiscard]] inline int random_int(Random& random, int low, int high) {  // low to high, both inclusive
    return low + static_cast<int>(random() % (static_cast<std::uint64_t>(high - low) + 1));
}
[[nodiscard]] inline float random_float(Random& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 40) * 0x1p-24f;
}

// A triangle that is already set up: snapped positions, window z, 1/w; attributes are 0.
[[nodiscard]] inline SetupTriangle window_triangle(const std::array<SubpixelPoint, 3>& p, int subpixel_bits,
                                                   const std::array<double, 3>& z = {0, 0, 0},
                                                   const std::array<float, 3>& inverse_w = {1, 1, 1}) {
    SetupTriangle t{};
    t.p = p;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto unit = static_cast<float>(1 << subpixel_bits);
        t.unsnapped[i] = {static_cast<float>(p[i].x) / unit, static_cast<float>(p[i].y) / unit};
    }
    t.z = z;
    t.inverse_w = inverse_w;
    t.given_z = z;
    for (std::size_t i = 0; i < 3; ++i) t.w[i] = 1.0f / inverse_w[i];
    return t;
}

[[nodiscard]] inline Geometry window_geometry(const std::vector<SetupTriangle>& triangles, int width, int height,
                                              const RasterRules& rules) {
    Geometry g;
    g.rules = rules;
    g.state.viewport = {0, 0, width, height};
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const SetupTriangle& t = triangles[i];
        const Rect box = intersection(centre_box(t.p, rules.subpixel_bits), g.state.viewport);
        g.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2},
                               i,
                               t.material,
                               box.area() == 0 ? PixelBox{} : in_viewport(box, g.state.viewport),
                               t.front_facing});
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& [r, green, b, a, s, tt] = t.attribute[k];
            const std::array color{r, green, b, a};
            g.vertices.push_back({.w = 1.0f / t.inverse_w[k], .front = color, .back = color, .texcoord = {s, tt}});
            g.corners.push_back({t.p[k], t.unsnapped[k], static_cast<float>(t.z[k]), t.inverse_w[k]});
        }
        g.offset_z.push_back(t.z);  // of any precision
        g.all_triangles.push_back(i);
    }
    return g;
}

[[nodiscard]] inline std::vector<SetupTriangle> triangles_of(const Geometry& geometry) {
    std::vector<SetupTriangle> triangles;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) triangles.push_back(geometry.triangle(i));
    return triangles;
}

struct Fragment {
    int x = 0, y = 0;
    std::uint32_t primitive = 0, material = 0, code = 0, exact_code = 0;
    std::uint32_t reference_code = 0;
    double reference_z = 0;
    float shader_z = 0;
    std::array<float, 4> color{};
    std::array<float, 2> texcoord{};
    bool front_facing = false;
    friend bool operator==(const Fragment&, const Fragment&) = default;
};

inline constexpr FragmentNeeds everything{true, true, true, true, true, true};
inline constexpr FragmentNeeds coverage_only{false, false, false, false, false, false};

struct DrawResult {
    std::vector<Fragment> fragments;
    std::uint64_t exact_fallbacks = 0;
    bool batches_are_sound = true;  // no pixel twice, one material, and pixel indices that match x and y
};

inline void append_batch(const FragmentBatch& batch, const Rect& region, const FragmentNeeds& needs,
                         DrawResult& result) {
    std::vector<std::uint32_t> pixels;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        Fragment f;
        f.x = batch.x[i];
        f.y = batch.y[i];
        f.primitive = batch.primitive[i];
        f.material = batch.material;
        if (needs.code) f.code = batch.code[i];
        if (needs.exact_code) f.exact_code = batch.exact_code[i];
        if (needs.shader_z) f.shader_z = batch.shader_z[i];
        if (needs.reference) f.reference_code = batch.reference_code[i], f.reference_z = batch.reference_z[i];
        for (std::size_t c = 0; c < 4 && needs.color; ++c) f.color[c] = batch.color[c][i];
        for (std::size_t c = 0; c < 2 && needs.texcoord; ++c) f.texcoord[c] = batch.texcoord[c][i];
        if (needs.facing) f.front_facing = batch.front_facing[i] != 0;
        const auto expected = static_cast<std::uint32_t>((f.y - region.y0) * region.width() + (f.x - region.x0));
        result.batches_are_sound &= batch.pixel[i] == expected;
        pixels.push_back(expected);
        result.fragments.push_back(f);
    }
    std::ranges::sort(pixels);
    result.batches_are_sound &= std::ranges::adjacent_find(pixels) == pixels.end();
}

[[nodiscard]] inline DrawResult draw(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs,
                                     const Rect& region, std::span<const std::uint32_t> triangles) {
    DrawResult result;
    TileRasterizer rasterizer{region};
    auto sink = [&](FragmentBatch& batch) { append_batch(batch, region, needs, result); };
    rasterizer.draw(geometry, triangles, depth, needs, BatchSink{sink});
    result.exact_fallbacks = rasterizer.exact_fallbacks();
    return result;
}

[[nodiscard]] inline DrawResult draw(const Geometry& geometry, const DepthRequest& depth = {},
                                     const FragmentNeeds& needs = everything) {
    return draw(geometry, depth, needs, geometry.state.viewport, geometry.all_triangles);
}

// Sorted by pixel and primitive, which must not depend on the order of the walk.
[[nodiscard]] inline std::vector<Fragment> by_pixel(std::vector<Fragment> fragments) {
    std::ranges::stable_sort(fragments, [](const Fragment& a, const Fragment& b) {
        return std::array{a.y, a.x} < std::array{b.y, b.x};
    });
    return fragments;
}

[[nodiscard]] inline SubpixelPoint random_point(Random& random, int width, int height, int subpixel_bits,
                                                int outside_px = 0) {
    const int unit = 1 << subpixel_bits;
    return {random_int(random, -outside_px * unit, (width + outside_px) * unit),
            random_int(random, -outside_px * unit, (height + outside_px) * unit)};
}

}  // namespace strata::rasterizer
