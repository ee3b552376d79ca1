// Tests the counts of layers lost, doubled and misplaced at samples on scenes whose outcome is known by hand.
#include "peeling/sample_hazard.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::find_algorithm;
using strata::peeling::measure_samples;
using strata::peeling::RenderOptions;
using strata::peeling::SampleHazard;
using strata::pipeline::find_profile;
using strata::pipeline::LoadedSample;
using strata::rasterizer::Interpolation;

// Quads that fill the view, each at its depths at the left and right side; a projection without perspective.
[[nodiscard]] TriangleScene tilted_quads(const std::vector<std::array<float, 2>>& depths, float right = 1.0f) {
    TriangleScene scene;
    scene.list.materials = {
        {.name = "glass", .alpha_mode = strata::pipeline::AlphaMode::blend, .double_sided = true, .unlit = true}};
    for (const auto& [left_z, right_z] : depths) {
        strata::pipeline::Mesh mesh;
        for (const float y : {-1.0f, 1.0f})
            for (const bool is_right : {false, true}) {
                mesh.positions.push_back({is_right ? right : -1.0f, y, is_right ? right_z : left_z});
                mesh.colors.push_back({0.5f, 0.5f, 0.5f, 0.5f});
            }
        mesh.indices = {0, 1, 2, 2, 1, 3};
        scene.list.meshes.push_back(mesh);
        scene.list.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.list.meshes.size() - 1)});
    }
    return scene;
}

[[nodiscard]] SampleHazard hazard_of(const TriangleScene& scene, const char* algorithm, Interpolation interpolation,
                                     LoadedSample loads = LoadedSample::own) {
    RenderOptions options;
    options.width = options.height = 8;
    options.threads = 1;
    options.raster.interpolation = interpolation;
    options.sampling = {.samples = 4, .loads = loads};
    return measure_samples({scene.list, scene.view, *find_profile("ideal"), options}, *find_algorithm(algorithm));
}

}  // namespace

TEST_CASE("a peel with programs at samples that loads its own sample loses nothing") {
    const TriangleScene scene = random_triangles(4511, 40);
    for (const char* algorithm : {"front_to_back", "dual", "dual_independent", "depth_units"}) {
        const SampleHazard hazard = hazard_of(scene, algorithm, Interpolation::sample);
        INFO(algorithm << ": " << hazard.lost << " lost, " << hazard.doubled << " doubled, " << hazard.misplaced
                       << " misplaced");
        CHECK(hazard.layers > 300);
        CHECK(hazard.lost + hazard.doubled + hazard.misplaced == 0);
        CHECK(hazard.at_silhouettes + hazard.at_inner_edges + hazard.inside == 0);
        CHECK(hazard.ended);
    }
}

TEST_CASE("one tilted quad peeled by its depth at the centre is found again at the samples nearer than it") {
    // Depth grows to the right: samples 0 and 2 of the standard four lie left of the centre and store a nearer depth.
    const TriangleScene scene = tilted_quads({{-0.5f, 0.5f}});
    const SampleHazard pixel = hazard_of(scene, "front_to_back", Interpolation::centre);
    CHECK(pixel.samples == 8 * 8 * 4);
    CHECK(pixel.layers == 8 * 8 * 4);
    CHECK(pixel.lost == 0);
    CHECK(pixel.doubled == 8 * 8 * 2);
    CHECK_FALSE(pixel.ended);
    // Only the diagonal's pixels have samples of two triangles.
    CHECK(pixel.at_silhouettes == 0);
    CHECK(pixel.at_inner_edges + pixel.inside == 8 * 8 * 2);
    CHECK(pixel.at_inner_edges == 8 * 2);
    // One triangle a pixel, two on the diagonal.
    CHECK(pixel.programs == 8 * 8 + 8);
    CHECK(hazard_of(scene, "front_to_back", Interpolation::sample).programs == 8 * 8 * 4);
    const SampleHazard dual = hazard_of(scene, "dual", Interpolation::centre);
    CHECK(dual.lost + dual.doubled + dual.misplaced == 0);
}

TEST_CASE("a fixed-function depth unit compares every sample's own depth and loses nothing") {
    const TriangleScene scene = tilted_quads({{-0.5f, 0.5f}, {0.3f, 0.6f}});
    const SampleHazard hazard = hazard_of(scene, "depth_units", Interpolation::centre);
    CHECK(hazard.layers == 2 * 8 * 8 * 4);
    CHECK(hazard.lost + hazard.doubled + hazard.misplaced == 0);
}

TEST_CASE("a layer that the loaded sample does not have hides what lies between at the others") {
    // The near quad ends in the middle of a column of pixels: samples 0 and 2 see it, samples 1 and 3 do not. With
    // loads of sample 0 the second pass of those two drops what lies before sample 0's layer: nothing. Their far layer
    // is found in the first pass and again in the second.
    const TriangleScene far = tilted_quads({{0.4f, 0.4f}});
    TriangleScene scene = tilted_quads({{-0.4f, -0.4f}}, 0.125f);
    scene.list.meshes.push_back(far.list.meshes[0]);
    scene.list.instances.push_back({.mesh = 1});
    const SampleHazard hazard = hazard_of(scene, "front_to_back", Interpolation::sample, LoadedSample::zero);
    CHECK(hazard.lost == 0);
    CHECK(hazard.doubled == 8 * 2);
    CHECK(hazard.at_silhouettes == 8 * 2);
    CHECK(hazard_of(scene, "front_to_back", Interpolation::sample, LoadedSample::resolved).doubled == 8 * 2);
}
