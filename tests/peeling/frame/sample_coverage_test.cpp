// Tests alpha to coverage, sample coverage and sample mask against pictures put together from samples drawn without
// them, and queries against counts.
#include <catch2/catch.hpp>

#include "peeling/render.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::find_algorithm;
using strata::peeling::Renderer;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::find_profile;
using strata::pipeline::Image;
using strata::rasterizer::SampleCoverage;

// One triangle over the whole view, of one alpha.
[[nodiscard]] strata::pipeline::DrawList glass_of(float alpha) {
    strata::pipeline::DrawList list;
    list.materials = {
        {.name = "glass", .alpha_mode = strata::pipeline::AlphaMode::blend, .double_sided = true, .unlit = true}};
    strata::pipeline::Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
    mesh.colors.assign(3, {1, 1, 1, alpha});
    mesh.indices = {0, 1, 2};
    list.meshes = {mesh};
    list.instances = {{}};
    return list;
}

// The number of samples of the middle pixel that something was drawn to, by their numbers.
[[nodiscard]] std::vector<int> covered_samples(float alpha, int samples, const SampleCoverage& coverage,
                                               const char* profile = "geforce8") {
    const strata::pipeline::DrawList list = glass_of(alpha);
    RenderOptions options;
    options.width = options.height = 4;
    options.threads = 1;
    options.raster.sample_coverage = coverage;
    options.sampling.samples = samples;
    options.keep_samples = true;
    Renderer renderer{list, {}, *find_profile(profile), options};
    const RenderResult result = renderer.render(*find_algorithm("front_to_back"));
    CHECK(result.outcome == strata::peeling::Outcome::done);
    const std::vector<Image>& colors = result.frame.samples;
    std::vector<int> covered;
    for (std::size_t s = 0; s < colors.size(); ++s)
        if (colors[s].codes[colors[s].index(1, 1)] != 0) covered.push_back(static_cast<int>(s));
    return covered;
}

[[nodiscard]] std::vector<int> first_samples(int count) {
    std::vector<int> samples;
    for (int s = 0; s < count; ++s) samples.push_back(s);
    return samples;
}

}  // namespace

TEST_CASE("alpha to coverage covers the first samples of the share that alpha is") {
    for (const int samples : {2, 4, 8})
        for (int step = 1; step <= 32; ++step) {
            const float alpha = static_cast<float>(step) / 32.0f;
            // In thirty-seconds: floor(alpha n + 1/2).
            CHECK(covered_samples(alpha, samples, {.by_alpha = true}) == first_samples((step * samples + 16) / 32));
            CHECK(covered_samples(alpha, samples, {}) == first_samples(samples));
        }
}

TEST_CASE("sample coverage and mask leave out the samples that they do not name") {
    CHECK(covered_samples(0.5f, 4, {.value = 0.5f}) == std::vector{0, 1});
    CHECK(covered_samples(0.5f, 4, {.value = 0.5f, .is_inverted = true}) == std::vector{2, 3});
    CHECK(covered_samples(0.5f, 4, {.value = 0.0f}).empty());
    CHECK(covered_samples(0.5f, 4, {.mask = 0b1010}) == std::vector{1, 3});
    CHECK(covered_samples(0.5f, 4, {.value = 0.5f, .mask = 0b1010}) == std::vector{1});
    CHECK(covered_samples(0.5f, 4, {.by_alpha = true, .mask = 0b1110}) == std::vector{1});
}

TEST_CASE("opaque surfaces keep the samples that a mask or a coverage leaves out") {
    const TriangleScene scene = opaque_only(1410, 30);
    RenderOptions options;
    options.width = 21, options.height = 17;
    const auto drawn = [&](const SampleCoverage& coverage) {
        options.raster.sample_coverage = coverage;
        options.sampling.samples = 4;
        options.keep_samples = true;
        Renderer renderer{scene.list, scene.view, *find_profile("geforce8"), options};
        return renderer.render(*find_algorithm("front_to_back")).frame.samples;
    };
    const std::vector<Image> all = drawn({});
    REQUIRE(all.size() == 4);
    CHECK(std::ranges::any_of(all[3].codes, [](std::uint32_t code) { return code != 0 && code != 255; }));
    CHECK(drawn({.mask = 0b0001}) == all);
    CHECK(drawn({.value = 0.25f}) == all);
}

TEST_CASE("llvmpipe rounds the share of alpha up and that of sample coverage down") {
    for (int step = 1; step <= 32; ++step) {
        const float share = static_cast<float>(step) / 32.0f;
        CHECK(covered_samples(share, 4, {.by_alpha = true}, "llvmpipe") == first_samples((step * 4 + 31) / 32));
        CHECK(covered_samples(0.5f, 4, {.value = share}, "llvmpipe") == first_samples(step * 4 / 32));
    }
}

TEST_CASE("a sample that is masked out makes a peel end after one pass") {
    const strata::pipeline::DrawList list = glass_of(0.5f);
    RenderOptions options;
    options.width = options.height = 4;
    options.raster.sample_coverage.mask = 0;
    options.sampling.samples = 4;
    Renderer renderer{list, {}, *find_profile("geforce8"), options};
    CHECK(renderer.render(*find_algorithm("front_to_back")).frame.passes.geometry == 1);
}

TEST_CASE("a depth pass leaves out samples in every execution") {
    const strata::pipeline::DrawList list = glass_of(0.5f);
    RenderOptions options;
    options.width = options.height = 4;
    options.depth = strata::pipeline::DepthFormat::d24;
    options.raster.sample_coverage.mask = 0b10;
    options.sampling.samples = 2;
    options.keep_samples = true;
    for (const Running& running : all_ways_of_running) {
        running.apply(options);
        Renderer renderer{list, {}, *find_profile("geforce8"), options};
        const RenderResult result = renderer.depth_pass();
        REQUIRE(result.frame.samples.size() == 2);
        CHECK(result.frame.samples[0].codes[5] == 0xffffff);
        CHECK(result.frame.samples[1].codes[5] < 0xffffff);
        CHECK(result.frame.depth.codes[5] == result.frame.samples[1].codes[5]);
    }
}

TEST_CASE("a depth pass refuses shading once a pixel where the depth is replaced") {
    const strata::pipeline::DrawList list = glass_of(0.5f);
    RenderOptions options;
    options.width = options.height = 4;
    options.depth_path = strata::rasterizer::DepthPath::depth_replace;
    options.raster.interpolation = strata::rasterizer::Interpolation::centre;
    options.sampling.samples = 2;
    Renderer renderer{list, {}, *find_profile("ideal"), options};
    CHECK(renderer.depth_pass().outcome == strata::peeling::Outcome::refused);
}

TEST_CASE("a published peel that counts in its program ends if all samples are left out") {
    const strata::pipeline::DrawList list = glass_of(0.5f);
    RenderOptions options;
    options.width = options.height = 4;
    options.raster.sample_coverage.mask = 0;
    options.formulation = strata::pipeline::Formulation::published;  // does not reset its registers
    options.sampling.samples = 2;
    Renderer renderer{list, {}, *find_profile("ideal"), options};
    const RenderResult result = renderer.render(*find_algorithm("coherent_ideal"));
    CHECK(result.frame.passes.geometry <= 13);  // 6 D + 7 for one fragment (keys-and-counts.md 3.4)
    CHECK(std::ranges::any_of(result.frame.diagnostics, [](const strata::pipeline::Diagnostic& diagnostic) {
        return diagnostic.detail.find("samples that are left out") != std::string::npos;
    }));
}
