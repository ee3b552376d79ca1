// tests/rasterizer/values/quotient_triangles.h - random triangles whose depth is a quotient r / q of vertex values, as
// window geometry.
#pragma once
#include "rasterizer/values/depth_paths.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace strata::rasterizer {

inline constexpr int quotient_side = 12;
inline constexpr FragmentNeeds quotient_needs{.color = false, .reference = true};

struct QuotientTriangle {
    SetupTriangle setup;
    std::array<float, 3> r, q;
};

// r / q is within the buffer's range except for a few; q is w, and 1/w the window's.
[[nodiscard]] inline std::vector<QuotientTriangle> random_quotient_triangles(std::uint64_t seed, int count, int bits,
                                                                             double units) {
    Random random{seed};
    std::vector<QuotientTriangle> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        const int outside = triangles.size() % 3 == 0 ? 2000 : 4;
        const auto point = [&] { return random_point(random, quotient_side, quotient_side, bits, outside); };
        const std::array p{point(), point(), point()};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        QuotientTriangle t;
        std::array<float, 3> inverse_w{};
        std::array<double, 3> z{};
        const bool is_flat = triangles.size() % 7 == 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const float w = is_flat ? 1.0f : random_float(random, 0.2f, 9);
            const float depth = random_float(random, -0.2f, 1.2f);
            z[i] = double{depth * static_cast<float>(units)};
            t.q[i] = w;
            t.r[i] = static_cast<float>(z[i]) * w;
            inverse_w[i] = 1.0f / w;
        }
        t.setup = window_triangle(p, bits, z, inverse_w);
        triangles.push_back(t);
    }
    return triangles;
}

[[nodiscard]] inline Geometry quotient_geometry(const std::vector<QuotientTriangle>& triangles,
                                                const RasterRules& rules, DepthFormat format) {
    std::vector<SetupTriangle> setup;
    VertexExtras extras{.stride = 2, .has_rq = true, .values = {}};
    for (const QuotientTriangle& t : triangles) {
        setup.push_back(t.setup);
        for (std::size_t i = 0; i < 3; ++i) extras.values.insert(extras.values.end(), {t.r[i], t.q[i]});
    }
    Geometry geometry = window_geometry(setup, quotient_side, quotient_side, rules);
    geometry.state.depth_format = format;
    geometry.extras = std::move(extras);
    return geometry;
}

}  // namespace strata::rasterizer
