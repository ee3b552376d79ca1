// Tests multi_layer and adaptive against lists of layers and of steps in real numbers. peeling/reference/algorithms.md
// 19.
#include <catch2/catch.hpp>
#include <list>

#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

const ExpectedRow expected_multi_layer{{.algorithm = "multi_layer",
                                        .devices = Devices::ideal_alone,
                                        .passes = [](int) { return 1; },
                                        .targets = {"depths", "layer", "result"},
                                        .render_targets = 5}};
const ExpectedRow expected_adaptive{{.algorithm = "adaptive",
                                     .devices = Devices::ideal_alone,
                                     .passes = [](int) { return 2; },
                                     .targets = {"depths", "transmittances", "sums", "result"},
                                     .render_targets = 2}};

struct DeepLayer {
    float depth;
    RealLayer layer;
};

// Each fragment is inserted before the first layer that is not nearer. If there are more than k layers, the last two
// are merged.
Color3 layered_model(const GivenPixel& pixel, std::size_t k) {
    std::list<DeepLayer> layers;
    for (const GivenFragment& f : visible(pixel)) {
        auto position = layers.begin();
        while (position != layers.end() && position->depth < f.depth) ++position;
        layers.insert(position, {f.depth, layer_of(f)});
        if (layers.size() <= k) continue;
        const RealLayer last = layers.back().layer;
        layers.pop_back();
        layers.back().layer = joined(layers.back().layer, last);
    }
    RealLayer all;
    for (const DeepLayer& one : layers) all = joined(all, one.layer);
    return over(all, behind(pixel));
}

struct Step {
    double depth, through;
};

// The transmittance as a function of depth: its steps, of which the one with the least area is removed if there are
// more than k.
std::vector<Step> visibility_model(const GivenPixel& pixel, std::size_t k) {
    std::vector<Step> steps;
    for (const GivenFragment& f : visible(pixel)) {
        const double a = f.color[3];
        double before = 1;
        std::size_t position = 0;
        for (Step& s : steps)
            if (s.depth < f.depth) {
                before = s.through;
                ++position;
            } else {
                s.through *= 1 - a;
            }
        steps.insert(steps.begin() + static_cast<std::ptrdiff_t>(position), {f.depth, before * (1 - a)});
        if (steps.size() <= k) continue;
        std::size_t least = 1;
        const auto area = [&](std::size_t i) {
            return (steps[i].depth - steps[i - 1].depth) * (steps[i - 1].through - steps[i].through);
        };
        for (std::size_t i = 2; i < k; ++i)
            if (area(i) < area(least)) least = i;
        steps[least - 1].through = steps[least].through;
        steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(least));
    }
    return steps;
}

Color3 adaptive_model(const GivenPixel& pixel, std::size_t k) {
    const std::vector<Step> steps = visibility_model(pixel, k);
    RealLayer all;
    if (!steps.empty()) all.through = steps.back().through;
    for (const GivenFragment& f : visible(pixel)) {
        double seen = 1;
        for (const Step& s : steps)
            if (s.depth < f.depth) seen = s.through;
        const RealLayer own = layer_of(f);
        for (std::size_t c = 0; c < 3; ++c) all.color[c] += seen * own.color[c];
    }
    return over(all, behind(pixel));
}

}  // namespace

TEST_CASE("multi_layer keeps k layers and merges the two farthest with the exact result in every execution") {
    const FragmentScene scene = eighths_scene(11, 6);
    for (int k = 1; k <= 6; ++k) {
        RenderOptions options = eighths_options(scene);
        options.algorithm.nodes = k;
        bool are_alike = true;
        const RenderResult result = rendered_alike(scene, "multi_layer", options, are_alike);
        INFO(k << " nodes");
        REQUIRE_FALSE(result.refusal);
        CHECK(first_unlike(result.frame.color, [&](std::size_t p) {
                  return layered_model(scene.pixels[p], static_cast<std::size_t>(k));
              }) == "");
        CHECK(are_alike);
    }
}

TEST_CASE("multi_layer and adaptive are exact in any order if no pixel has more fragments than nodes") {
    const FragmentScene scene = eighths_scene(12, 6, false);
    for (const char* algorithm : {"multi_layer", "adaptive"}) {
        RenderOptions options = eighths_options(scene);
        options.algorithm.nodes = 6;
        CHECK(render(scene, {"ideal", algorithm}, options).audit.max_difference == 0);
    }
}

TEST_CASE(
    "multi_layer with more layers than a pass has targets is rejected and the message names the greatest number") {
    const FragmentScene scene = eighths_scene(13, 2);
    RenderOptions options = eighths_options(scene);
    options.algorithm.nodes = 7;
    const RenderResult result = render(scene, {"ideal", "multi_layer"}, options);
    REQUIRE(result.refusal);
    CHECK(result.refusal->message(*strata::pipeline::find_profile("ideal")) ==
          "profile ideal has no targets for more than 6 layers and their depths in one pass; use --nodes 6");
}

TEST_CASE(
    "adaptive weights colours by the k steps that remain after removing those of least area with the exact result") {
    const FragmentScene scene = eighths_scene(14, 6);
    for (int k = 1; k <= 8; ++k) {
        RenderOptions options = eighths_options(scene);
        options.algorithm.nodes = k;
        bool are_alike = true;
        const RenderResult result = rendered_alike(scene, "adaptive", options, are_alike);
        INFO(k << " nodes");
        CHECK(first_unlike(result.frame.color, [&](std::size_t p) {
                  return adaptive_model(scene.pixels[p], static_cast<std::size_t>(k));
              }) == "");
        CHECK(are_alike);
    }
}
