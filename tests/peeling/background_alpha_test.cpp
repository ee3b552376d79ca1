// Tests backgrounds with alpha below 1. The expected pixel is computed in real numbers from its layers, far to near:
// premultiplied colours, and 1 - the product of all (1 - alpha), including that of the background. Opaque surfaces have
// alpha 1 over any background.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "tests/peeling/rendering.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Algorithm;
using strata::peeling::algorithms;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::TiePolicy;

// Up to four fragments per pixel, submitted far to near, so that each algorithm orders them correctly; all fragments of
// a pixel have one alpha, so that their average has the same transmittance.
FragmentScene layered(std::uint64_t seed) {
    Random random{seed};
    FragmentScene scene{8, 8};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        const float alpha = random_float(random, 0.1f, 0.9f);
        for (std::size_t i = p % 5; i-- > 0;) {
            Rgba color = random_color(random);
            color[3] = alpha;
            scene.pixels[p].fragments.push_back({static_cast<float>(2 * i + 1) / 16.0f, color});
        }
        if (p % 3 == 0) scene.pixels[p].opaque = GivenFragment{4.0f / 16.0f, {0.25f, 0.5f, 0.75f, 1}};
    }
    return scene;
}

struct Real {
    std::array<double, 3> color{};
    double alpha = 0;
};

Real composited(const GivenPixel& pixel, const Rgba& background) {
    Real all{{background[0], background[1], background[2]}, background[3]};
    if (pixel.opaque) all = {{pixel.opaque->color[0], pixel.opaque->color[1], pixel.opaque->color[2]}, 1};
    for (const GivenFragment& f : visible(pixel)) {  // far to near
        const double a = f.color[3];
        for (std::size_t c = 0; c < 3; ++c)
            all.color[c] = a * f.color[static_cast<Rgba::length_type>(c)] + (1 - a) * all.color[c];
        all.alpha = 1 - (1 - all.alpha) * (1 - a);
    }
    return all;
}

double value(const Image& image, std::size_t pixel, std::size_t channel) {
    return std::bit_cast<float>(image.codes[4 * pixel + channel]);
}

// Adds its fragments in float targets, in any order.
bool is_average(const Algorithm& algorithm) {
    return algorithm.ties == TiePolicy::none &&
           std::ranges::find(algorithm.features, Feature::float_targets) != algorithm.features.end();
}

// An algorithm that ignores order, or that requires the scene's one object to be sorted near to far.
bool is_disordered(const Algorithm& algorithm) { return is_average(algorithm) || algorithm.name == "object_sorted"; }

}  // namespace

TEST_CASE("every algorithm writes premultiplied colours and 1 - the product of 1 - alpha over a clear background") {
    const FragmentScene scene = layered(4);
    for (const Rgba& background : {Rgba{0, 0, 0, 0}, Rgba{0.25f, 0.125f, 0, 0.5f}})
        for (const Running& running : all_ways_of_running)
            for (const Algorithm& algorithm : algorithms()) {
                INFO(algorithm.name << " over alpha " << background[3]);
                RenderOptions options = options_for(scene);
                options.background = background;
                running.apply(options);
                const RenderResult result = render(scene, {"ideal", algorithm.name}, options);
                REQUIRE_FALSE(result.refusal);
                double worst = 0, worst_color = 0;
                std::uint64_t not_opaque = 0;
                for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
                    const Real wanted = composited(scene.pixels[p], background);
                    const double alpha = value(result.frame.color, p, 3);
                    if (algorithm.name == "weighted_sum") {
                        double sum = 0;
                        for (const GivenFragment& f : visible(scene.pixels[p])) sum += f.color[3];
                        const double behind = scene.pixels[p].opaque ? 1 : background[3];
                        worst = std::max(worst, std::abs(alpha - (1 - (1 - sum) * (1 - behind))));
                    } else {
                        worst = std::max(worst, std::abs(alpha - wanted.alpha));
                    }
                    not_opaque += scene.pixels[p].opaque && alpha != 1 ? 1 : 0;
                    for (std::size_t c = 0; c < 3 && !is_disordered(algorithm); ++c)
                        worst_color =
                            std::max(worst_color, std::abs(value(result.frame.color, p, c) - wanted.color[c]));
                }
                // Sums are halves where the device's own are not binary32.
                CHECK(worst < (is_average(algorithm) ? 1e-3 : 1e-5));
                CHECK(worst_color < 1e-5);
                CHECK(not_opaque == 0);
                CHECK((is_disordered(algorithm) || result.audit.max_difference < 1e-3));
            }
}

TEST_CASE("8-bit pictures over a clear background are within one code per layer of the real alpha in every execution") {
    const FragmentScene scene = layered(9);
    for (const Algorithm& algorithm : algorithms()) {
        if (is_average(algorithm)) continue;
        std::optional<Image> first;
        for (const Running& running : all_ways_of_running) {
            INFO(algorithm.name);
            RenderOptions options = options_for(scene);
            options.background = {0, 0, 0, 0};
            options.color_format = Format::rgba8;
            running.apply(options);
            const RenderResult result = render(scene, {"ideal", algorithm.name}, options);
            REQUIRE_FALSE(result.refusal);
            if (!first) first = result.frame.color;
            CHECK(result.frame.color == *first);
            double worst = 0;
            for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
                const double found = result.frame.color.codes[4 * p + 3];
                worst = std::max(worst, std::abs(found - 255 * composited(scene.pixels[p], options.background).alpha));
            }
            CHECK(worst <= 4);
            CHECK(result.audit.max_difference >= worst - 1e-9);
        }
    }
}

TEST_CASE("OVER onto a clear background is rejected where alpha has no separate factors") {
    const FragmentScene scene = layered(2);
    RenderOptions options = options_for(scene);
    options.background = {0, 0, 0, 0};
    const RenderResult result = render(scene, {"geforce3", "unsorted"}, options);
    REQUIRE(result.refusal);
    CHECK(result.refusal->extension == "EXT_blend_func_separate");
    options.background[3] = 1;
    CHECK_FALSE(render(scene, {"geforce3", "unsorted"}, options).refusal);
}
