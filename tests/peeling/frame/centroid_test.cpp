// Tests the centroid of the samples that pass the depth test against a model that draws every sample's own fragments in
// order. pipeline/reference/fragment-stages.md 13.7.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

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
using strata::pipeline::Rgba;
using strata::rasterizer::Interpolation;

constexpr std::size_t pixel_samples = 4;

// Only transparent triangles, so that nothing is drawn before the peel; within the view, so that none is clipped.
TriangleScene panes(std::uint64_t seed) {
    TriangleScene scene = random_triangles(seed, 40);
    scene.list.instances.resize(1);
    for (auto& position : scene.list.meshes[0].positions) position[0] *= 0.75f, position[1] *= 0.75f;
    return scene;
}

RenderOptions options_at(Interpolation interpolation) {
    RenderOptions options;
    options.width = 45, options.height = 35;
    options.threads = 1;
    options.audit = false;
    options.color_format = strata::pipeline::Format::rgba32f;
    options.sampling.samples = pixel_samples;
    options.raster.interpolation = interpolation;
    options.keep_samples = true;
    options.max_passes = 1;
    return options;
}

struct Covered {
    unsigned mask = 0;
    std::array<std::uint32_t, pixel_samples> code{};
    std::array<Rgba, pixel_samples> color{};
    Rgba at_centre{};
};
// By triangle and pixel, in the order of triangles.
using Drawn = std::map<std::pair<std::uint32_t, std::uint32_t>, Covered>;

Drawn drawn_fragments(const TriangleScene& scene, const std::string& profile) {
    Drawn drawn;
    for (const Interpolation at : {Interpolation::sample, Interpolation::centre}) {
        Renderer renderer{scene.list, scene.view, *find_profile(profile), options_at(at)};
        for (const auto& f : renderer.fragments(*find_algorithm("front_to_back")).all) {
            Covered& covered = drawn[{f.primitive, f.pixel}];
            covered.mask |= 1u << f.sample;
            covered.code[f.sample] = f.code;
            (at == Interpolation::centre ? covered.at_centre : covered.color[f.sample]) = f.color;
        }
    }
    return drawn;
}

// The nearest layer over black, of every sample of every pixel.
std::vector<Rgba> nearest_layer(const Drawn& drawn, std::size_t pixels, bool by_passing) {
    std::vector<Rgba> color(pixel_samples * pixels, Rgba{0, 0, 0, 1});
    std::vector<std::uint32_t> depth(pixel_samples * pixels, std::bit_cast<std::uint32_t>(1.0f));
    for (const auto& [at, covered] : drawn) {
        unsigned passing = 0;
        for (std::size_t s = 0; s < pixel_samples; ++s)
            if ((covered.mask >> s & 1u) != 0 && covered.code[s] < depth[s * pixels + at.second]) passing |= 1u << s;
        const unsigned chosen = by_passing ? passing : covered.mask;
        if (passing == 0) continue;
        const Rgba c =
            chosen == 0xf ? covered.at_centre : covered.color[static_cast<std::size_t>(std::countr_zero(chosen))];
        for (std::size_t s = 0; s < pixel_samples; ++s) {
            if ((passing >> s & 1u) == 0) continue;
            depth[s * pixels + at.second] = covered.code[s];
            color[s * pixels + at.second] = {c[0] * c[3], c[1] * c[3], c[2] * c[3], 1};
        }
    }
    return color;
}

std::uint64_t unlike(const RenderResult& result, const std::vector<Rgba>& expected) {
    std::uint64_t wrong = 0;
    const std::size_t pixels = expected.size() / pixel_samples;
    for (std::size_t e = 0; e < expected.size(); ++e)
        for (std::size_t c = 0; c < 3; ++c) {
            const float found = std::bit_cast<float>(result.frame.samples[e / pixels].codes[4 * (e % pixels) + c]);
            const float wanted = expected[e][static_cast<int>(c)];
            if (std::fabs(found - wanted) <= 1e-4f * std::max(1.0f, std::fabs(wanted))) continue;
            ++wrong;
            break;
        }
    return wrong;
}

}  // namespace

TEST_CASE("the centroid is found among the samples that pass the depth test or that are covered as a profile says") {
    for (const std::uint64_t seed : {5701u, 5702u}) {
        const TriangleScene scene = panes(seed);
        const RenderOptions options = options_at(Interpolation::centroid);
        const auto pixels = static_cast<std::size_t>(options.width * options.height);
        for (const bool by_passing : {true, false}) {
            const std::string profile = by_passing ? "llvmpipe" : "ideal";
            const Drawn drawn = drawn_fragments(scene, profile);
            const RenderResult result = render(scene.list, scene.view, {profile, "front_to_back"}, options);
            INFO("seed " << seed << ", " << profile);
            CHECK(unlike(result, nearest_layer(drawn, pixels, by_passing)) == 0);
            CHECK(unlike(result, nearest_layer(drawn, pixels, !by_passing)) > 100);
            RenderOptions literal = options;
            literal.execution = strata::pipeline::Execution::literal;
            CHECK(render(scene.list, scene.view, {profile, "front_to_back"}, literal).frame.samples ==
                  result.frame.samples);
        }
    }
}
