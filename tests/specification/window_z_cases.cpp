// tests/specification/window_z_cases.cpp - random triangles over pixels, including slivers and steep ones, drawn on
// geforce3.
#include <bit>
#include <ostream>

#include "pipeline/device/profile.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/specification/cases.h"
#include "tests/specification/line.h"
#include "tests/support/random_numbers.h"

namespace strata::specification {
namespace {

using namespace rasterizer;
using testing::random_int;

constexpr int width = 640, height = 480;

// Clip-space positions with w = 1 in the viewport: anywhere, or near another one; depths similar, far apart, or at an
// end.
TriangleSoup random_triangles(testing::Random& random, int count) {
    TriangleSoup soup;
    const auto depth = [&](float near_to) {
        switch (random_int(random, 0, 3)) {
            case 0: return static_cast<float>(random_int(random, 0, 1));
            case 1: return near_to + static_cast<float>(random_int(random, -64, 64)) * 0x1p-24f;
            default: return testing::random_float(random, 0.0f, 1.0f);
        }
    };
    for (int t = 0; t < count; ++t) {
        const float x = testing::random_float(random, -1, 1), y = testing::random_float(random, -1, 1);
        const float reach = random_int(random, 0, 1) == 0 ? 2.0f : 0.125f, middle = testing::random_float(random, 0, 1);
        for (int k = 0; k < 3; ++k) {
            ClipVertex v;
            v.x = std::clamp(x + testing::random_float(random, -reach, reach), -1.0f, 1.0f);
            v.y = std::clamp(y + testing::random_float(random, -reach, reach), -1.0f, 1.0f);
            v.z = 2.0f * std::clamp(depth(middle), 0.0f, 1.0f) - 1.0f;
            soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back(v);
        }
    }
    soup.runs.push_back({.first_index = 0, .index_count = static_cast<std::uint32_t>(soup.indices.size())});
    return soup;
}

}  // namespace

void write_window_z(std::ostream& out, std::uint64_t cases, std::uint64_t seed) {
    testing::Random random{seed};
    RasterState state;
    state.viewport = {0, 0, width, height};
    state.depth_format = DepthFormat::d24;
    const RasterRules rules = pipeline::find_profile("geforce3")->raster;
    constexpr int few_pixels = 8;  // per triangle: many triangles test more than many pixels
    while (cases > 0) {
        Geometry geometry = set_up(random_triangles(random, 64), state, rules, 1);
        for (std::size_t t = 0; t < geometry.triangles.size() && cases > 0; ++t) {
            const std::uint32_t one[] = {static_cast<std::uint32_t>(t)};
            const auto& vertex = geometry.triangles[t].vertex;
            std::vector<std::array<std::uint32_t, 3>> pixels;  // x, y, code
            auto take = [&](FragmentBatch& batch) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                    pixels.push_back({batch.x[i], batch.y[i], batch.code[i]});
            };
            TileRasterizer{state.viewport}.draw(geometry, one, {DepthPath::window_z, DepthFormat::d24},
                                                {.shader_z = false, .color = false}, BatchSink{take});
            for (int k = 0; k < few_pixels && !pixels.empty() && cases > 0; ++k, --cases) {
                const auto& p = pixels[random() % pixels.size()];
                Line line{out};
                for (const std::uint32_t v : vertex) {
                    const WindowCorner& corner = geometry.corners[v];
                    line.integer(corner.p.x).integer(corner.p.y).bits(corner.z);
                }
                line.integer(p[0]).integer(p[1]).answer().integer(p[2]);
            }
        }
    }
}

}  // namespace strata::specification
