// Tests peeling by a shadow map: it is correct where the compared depth is the stored one, and otherwise fails in known
// ways.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Outcome;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::rasterizer::DepthPath;

// Transparent triangles in a perspective view, none with an alpha that is stored as 0.
TriangleScene visible_triangles(std::uint64_t seed, int count) {
    TriangleScene scene = random_triangles(seed, count);
    for (Mesh& mesh : scene.list.meshes)
        for (Rgba& color : mesh.colors) color[3] = 0.25f + 0.5f * color[3];
    for (std::size_t i = 3; i < scene.list.textures[0].texels.size(); i += 4)
        scene.list.textures[0].texels[i] = static_cast<std::uint8_t>(128 + scene.list.textures[0].texels[i] / 2);
    return scene;
}

RenderOptions options_of(int width, int height) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.threads = 1;
    options.keep_layers = true;
    return options;
}

RenderResult run(const TriangleScene& scene, const Machine& machine, const RenderOptions& options) {
    return render(scene.list, scene.view, machine, options);
}

}  // namespace

TEST_CASE(
    "with depth replace the result equals that of sequential depth units in every layer and depth and pass count") {
    const TriangleScene scene = visible_triangles(411, 60);
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        RenderOptions options = options_of(64, 48);
        options.depth = format;
        const RenderResult fixed = run(scene, {"geforce3", "shadow_map_depth_replace"}, options);
        options.depth_path = DepthPath::depth_replace;
        const RenderResult units = run(scene, {"geforce3", "depth_units"}, options);
        REQUIRE(fixed.outcome == Outcome::done);
        REQUIRE(units.outcome == Outcome::done);
        CHECK(fixed.frame.color == units.frame.color);
        CHECK(fixed.frame.depth == units.frame.depth);
        CHECK(fixed.frame.passes.geometry == units.frame.passes.geometry);
        REQUIRE(fixed.frame.layers.size() == units.frame.layers.size());
        CHECK(fixed.frame.layers.size() > 8);
        for (std::size_t i = 0; i < fixed.frame.layers.size(); ++i) {
            CHECK(fixed.frame.layers[i].color == units.frame.layers[i].color);
            CHECK(fixed.frame.layers[i].depth == units.frame.layers[i].depth);
        }
        CHECK(fixed.audit.order_errors == 0u);
        CHECK_FALSE(has_diagnostic(fixed, Fault::endless));
    }
}

TEST_CASE(
    "without depth replace some fragments survive their own peel and some layers are lost and the audit counts them") {
    const TriangleScene scene = visible_triangles(412, 60);
    RenderOptions options = options_of(64, 48);
    const RenderResult broken = run(scene, {"geforce3", "shadow_map"}, options);
    REQUIRE(broken.outcome == Outcome::done);
    CHECK(broken.audit.order_errors.value_or(0) > 0);
    const RenderResult fixed = run(scene, {"geforce3", "shadow_map_depth_replace"}, options);
    CHECK(broken.frame.color != fixed.frame.color);
}

TEST_CASE("a compared depth that is not rounded like the stored one never ends and a diagnostic gives the reason") {
    const TriangleScene scene = visible_triangles(413, 12);
    RenderOptions options = options_of(32, 32);
    options.quantize_reference = false;
    const RenderResult result = run(scene, {"geforce3", "shadow_map_depth_replace"}, options);
    REQUIRE(result.outcome == Outcome::done);
    REQUIRE(has_diagnostic(result, Fault::endless));
    CHECK(result.audit.order_errors.value_or(0) > 0);
    for (const Diagnostic& d : result.frame.diagnostics)
        if (d.fault == Fault::endless) CHECK_THAT(d.detail, Catch::Contains("not rounded like the stored one"));
}

TEST_CASE("layers are selectable and a truncated peel is reported") {
    const TriangleScene scene = visible_triangles(414, 60);
    RenderOptions options = options_of(64, 48);
    options.max_passes = 3;
    const RenderResult three = run(scene, {"geforce3", "shadow_map_depth_replace"}, options);
    CHECK(three.frame.layers.size() == 3);
    CHECK(three.frame.passes.geometry == 3);
    CHECK(has_diagnostic(three, Fault::truncated));
    options.max_passes = 0;
    const RenderResult all = run(scene, {"geforce3", "shadow_map_depth_replace"}, options);
    for (std::size_t i = 0; i < 3; ++i) CHECK(three.frame.layers[i].color == all.frame.layers[i].color);
}

TEST_CASE("a bias in the written depth prevents fragments from surviving their own peel") {
    const TriangleScene scene = visible_triangles(415, 40);
    RenderOptions options = options_of(64, 48);
    const RenderResult none = run(scene, {"geforce3", "shadow_map"}, options);
    options.raster.polygon_offset = {.enabled = true, .factor = 0, .units = 2048};
    const RenderResult biased = run(scene, {"geforce3", "shadow_map"}, options);
    CHECK(has_diagnostic(none, Fault::endless));
    CHECK_FALSE(has_diagnostic(biased, Fault::endless));
}
