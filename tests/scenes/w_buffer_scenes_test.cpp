// Tests w buffers on whole scenes: they store w of the exact plane of 1/w, scaled so that the far plane has the
// format's depth 1.
#include <catch2/catch.hpp>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "scenes/camera.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::DepthFormat;
using strata::rasterizer::DepthPath;
using strata::rasterizer::DepthRequest;
using strata::rasterizer::FragmentBatch;
using strata::rasterizer::Geometry;

// w in binary64: the sum of the edge values divided by the sum of edge values over w.
[[nodiscard]] double model_w(const Geometry& geometry, std::uint32_t triangle, int x, int y) {
    const auto& record = geometry.triangles[triangle];
    const strata::rasterizer::TriangleEdges edges{geometry.points(record), geometry.rules.tie_rule};
    const auto e = edges.at(strata::rasterizer::pixel_centre(x, y, geometry.rules.subpixel_bits));
    double above = 0, below = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        above += static_cast<double>(e[i]);
        below += static_cast<double>(e[i]) / double{geometry.vertices[record.vertex[i]].w};
    }
    return above / below;
}

[[nodiscard]] strata::pipeline::PreparedDraw drawn(const Scene& scene, DepthFormat format, double& far) {
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, 96, 72};
    state.depth_format = format;
    const strata::pipeline::View view = orbit_view(scene.bounds, 30, 20, 96.0 / 72.0);
    const auto& p = view.projection;
    far = p[3][2] / (p[2][2] + 1.0);  // the distance -z at which A z + B = -z, which is depth 1
    return prepare(scene.list, view, state, *strata::pipeline::find_profile("geforce3"), {});
}

}  // namespace

TEST_CASE("a w buffer of a scene stores w scaled so that the far plane is depth 1 in every format of the chip",
          "[slow]") {
    const Scene scene = load_scene("teapot", {});
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f}) {
        double far = 0;
        const auto prepared = drawn(scene, format, far);
        const Geometry& geometry = prepared.geometry;
        const double units = buffer_units(format);
        CHECK(double{geometry.state.w_scale} == Approx(units / far).epsilon(1e-6));
        std::uint64_t fragments = 0, wrong = 0, alike = 0;
        for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
            auto sink = [&](FragmentBatch& batch) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
                    const double w = model_w(geometry, t, batch.x[i], batch.y[i]) * double{geometry.state.w_scale};
                    const double held = buffer_value(batch.code[i], format),
                                 next = buffer_value(batch.code[i] + 1, format);
                    // A code is truncated from a value that is correct to about 20 bits.
                    wrong += w < held * (1 - 1e-6) || w > next * (1 + 1e-6) ? 1 : 0;
                    alike += batch.code[i] == batch.exact_code[i] ? 1 : 0;
                    ++fragments;
                }
            };
            const std::array one{t};
            strata::rasterizer::TileRasterizer rasterizer{geometry.state.viewport};
            rasterizer.draw(geometry, one, DepthRequest{DepthPath::w_buffer, format},
                            {.exact_code = true, .color = false}, strata::rasterizer::BatchSink{sink});
        }
        INFO(fragments << " fragments, " << alike << " alike in z");
        CHECK(fragments > 1000);
        CHECK(wrong == 0);
        CHECK(alike < fragments / 10);
    }
}

TEST_CASE("a parallel projection has no w to store and a perspective one has") {
    const Scene scene = load_scene("teapot", {});
    CHECK(strata::pipeline::has_perspective(orbit_view(scene.bounds, 30, 20, 1.0)));
    CHECK_FALSE(strata::pipeline::has_perspective({}));
}
