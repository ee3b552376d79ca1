// Tests that every execution draws meshes with triangles of one or two pixels like literal execution, which is the
// definition.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/random_numbers.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::pipeline::DeviceProfile;
using strata::pipeline::Execution;

// Two wavy sheets with cells of about two thirds of a pixel at 76 x 52, whose corners have different colours or, in
// stripes, equal ones; an opaque sheet intersects them.
[[nodiscard]] TriangleScene sheets(std::uint64_t seed) {
    Random random{seed};
    TriangleScene scene;
    scene.view.projection = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5, 0};  // near 1, far 5
    scene.list.materials = {four_materials()[0], four_materials()[3]};
    constexpr std::uint32_t columns = 72, rows = 50;
    for (std::uint32_t sheet = 0; sheet < 3; ++sheet) {
        strata::pipeline::Mesh mesh;
        for (std::uint32_t i = 0; i < columns * rows; ++i) {
            const float x = static_cast<float>(i % columns), y = static_cast<float>(i / columns);
            const float z = 2 + 0.3f * static_cast<float>(sheet) + random_float(random, 0, 0.5f);
            mesh.positions.push_back({(x / columns - 0.5f + random_float(random, 0, 0.01f)) * z,
                                      (y / rows - 0.5f + random_float(random, 0, 0.01f)) * z, -z});
            mesh.normals.push_back({0, random_float(random, 0, 1), 1});
            mesh.colors.push_back(i / 40 % 3 == 0 ? strata::Rgba{0.25f, 0.5f, 0.75f, 0.5f} : random_color(random));
        }
        for (std::uint32_t i = 0; i + columns + 1 < columns * rows; ++i)
            for (const std::uint32_t v : {i, i + 1, i + columns, i + columns + 1, i + columns, i + 1})
                mesh.indices.push_back(v);
        scene.list.instances.push_back({.mesh = sheet, .material = sheet == 1 ? 1u : 0u});
        scene.list.meshes.push_back(std::move(mesh));
    }
    return scene;
}

[[nodiscard]] DeviceProfile with_unsnapped_planes() {
    DeviceProfile profile = *strata::pipeline::find_profile("geforce8");
    profile.name = "unsnapped";
    profile.raster.plane_origin = strata::rasterizer::PlaneOrigin::unsnapped;
    profile.raster.tie_rule = strata::rasterizer::TieRule::bottom_left;
    return profile;
}

}  // namespace

TEST_CASE("meshes of triangles of a pixel or two execute alike for any peel and sum and test", "[slow]") {
    const TriangleScene scene = sheets(811);
    const std::array profiles{*strata::pipeline::find_profile("geforce8"), *strata::pipeline::find_profile("ideal"),
                              with_unsnapped_planes()};
    std::uint64_t fragments = 0;
    for (const DeviceProfile& profile : profiles)
        for (const auto format : {strata::pipeline::Format::rgba8, strata::pipeline::Format::rgba32f})
            for (const bool all_transparent : {false, true})
                for (const char* algorithm : {"weighted_average", "weighted_sum", "dual", "front_to_back"}) {
                    RenderOptions options;
                    options.width = 76;
                    options.height = 52;
                    options.color_format = format;
                    if (all_transparent) options.alpha = 0.375f;
                    const auto drawn_by = [&](Execution execution, strata::Simd simd, int tile_size) {
                        options.execution = execution;
                        options.simd = simd;
                        options.tile_size = tile_size;
                        strata::peeling::Renderer renderer{scene.list, scene.view, profile, options};
                        return renderer.render(*strata::peeling::find_algorithm(algorithm), {}, {});
                    };
                    const auto expected = drawn_by(Execution::literal, strata::Simd::best, 32);
                    fragments += expected.frame.counters->fragments_rasterized;
                    for (const strata::Simd simd : strata::available_simd()) {
                        INFO(algorithm << " on " << profile.name << ", set " << static_cast<int>(simd));
                        CHECK(difference(drawn_by(Execution::replay, simd, 16), expected) == "");
                        CHECK(difference(drawn_by(Execution::replay, simd, 128), expected) == "");
                    }
                }
    CHECK(fragments > 100'000);
}
