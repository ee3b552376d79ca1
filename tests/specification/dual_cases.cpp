// tests/specification/dual_cases.cpp - pixels with fragments at a few depths, with ties, peeled by dual on geforce8.
#include <algorithm>
#include <ostream>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "tests/specification/cases.h"
#include "tests/specification/line.h"
#include "tests/support/fragment_scene.h"
#include "tests/support/random_numbers.h"

namespace strata::specification {
namespace {

using testing::random_int;

testing::GivenFragment random_fragment(testing::Random& random, int depths) {
    return {.depth = static_cast<float>(random_int(random, 1, depths)) / static_cast<float>(2 * depths),
            .color = testing::random_color(random)};
}

testing::FragmentScene random_scene(testing::Random& random) {
    constexpr int side = 32;
    testing::FragmentScene scene{side, side};
    const int depths = 1 << random_int(random, 2, 10);  // few depths, so that some tie
    for (testing::GivenPixel& pixel : scene.pixels) {
        for (int n = random_int(random, 0, 9); n > 0; --n) pixel.fragments.push_back(random_fragment(random, depths));
        if (random_int(random, 0, 3) == 0) pixel.opaque = random_fragment(random, depths);
    }
    return scene;
}

Line& color(Line& line, const pipeline::Rgba& rgba) {
    for (const float c : components(rgba)) line.bits(c);
    return line;
}

}  // namespace

void write_dual(std::ostream& out, std::uint64_t cases, std::uint64_t seed) {
    testing::Random random{seed};
    while (cases > 0) {
        const testing::FragmentScene scene = random_scene(random);
        const bool is_half = random_int(random, 0, 1) == 0;
        peeling::RenderOptions options;
        options.width = scene.width;
        options.height = scene.height;
        options.threads = 1;
        options.audit = false;
        options.color_format = is_half ? pipeline::Format::rgba16f : pipeline::Format::rgba8;
        options.max_passes = random_int(random, 0, 4);
        options.background = testing::random_color(random);
        const pipeline::DrawList list = testing::draw_list(scene);
        peeling::Renderer renderer{list, {}, *pipeline::find_profile("geforce8"), options};
        const peeling::RenderResult result = renderer.render(*peeling::find_algorithm("dual"));
        for (std::size_t p = 0; p < scene.pixels.size() && cases > 0; ++p, --cases) {
            Line line{out};
            line.word(is_half ? "rgba16f" : "rgba8").integer(options.max_passes);
            const auto& opaque = scene.pixels[p].opaque;
            if (opaque)
                line.bits(opaque->depth);
            else
                line.word("-");
            color(line, opaque ? opaque->color : options.background);
            line.integer(static_cast<std::int64_t>(scene.pixels[p].fragments.size()));
            for (const testing::GivenFragment& f : scene.pixels[p].fragments) color(line.bits(f.depth), f.color);
            line.answer();
            for (std::size_t c = 0; c < 4; ++c) {
                const std::uint32_t code = result.frame.color.codes[4 * p + c];
                if (is_half)
                    line.half(code);
                else
                    line.integer(code);
            }
        }
    }
}

}  // namespace strata::specification
