// Tests the layers of dual peeling against the fragments of a pixel sorted by depth and taken from both ends
// alternately; codes are computed by TargetModel.
#include <catch2/catch.hpp>
#include <map>

#include "tests/peeling/rendering.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::PeeledLayer;
using strata::pipeline::Rgba;
using strata::pipeline::Side;

// 0 to 15 fragments per pixel on eight depths, in random submission order, so that some tie.
FragmentScene columns_of_any_height(std::uint64_t seed) {
    FragmentScene scene{16, 8};
    Random random{seed};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        for (std::size_t i = 0; i < p % 16; ++i) {
            const float z = static_cast<float>(random_int(random, 1, 8)) / 16.0f;
            Rgba color = random_color(random);
            color[3] = std::max(color[3], 0.25f);
            scene.pixels[p].fragments.push_back({z, color});
        }
    return scene;
}

using LayerCodes = std::array<std::uint32_t, 4>;

// The layers of one pixel from near to far: MAX of the codes of each depth.
std::vector<LayerCodes> layers_of(const GivenPixel& pixel) {
    const TargetModel target;
    std::map<float, LayerCodes> layers;
    for (const auto& fragment : pixel.fragments) {
        LayerCodes& layer = layers[fragment.depth];
        for (std::size_t c = 0; c < 4; ++c)
            layer[c] = std::max(layer[c], static_cast<std::uint32_t>(target.code_255(fragment.color[c])));
    }
    std::vector<LayerCodes> sorted;
    for (const auto& [z, codes] : layers) sorted.push_back(codes);
    return sorted;
}

RenderResult peeled(const FragmentScene& scene, const std::string& algorithm, bool keep, const Running& running,
                    bool counters = false) {
    RenderOptions options = options_for(scene);
    options.counters = counters;
    options.keep_layers = keep;
    running.apply(options);
    return render(scene, {"geforce8_dx101", algorithm}, options);
}

// The layer at one end of [near, far) after `pass` passes have taken one from each end.
LayerCodes layer_left(const std::vector<LayerCodes>& layers, Side side, std::size_t pass) {
    if (2 * pass >= layers.size()) return {};
    const std::size_t near = pass, far = layers.size() - 1 - pass;
    if (side == Side::front) return layers[near];
    return far == near ? LayerCodes{} : layers[far];
}

}  // namespace

TEST_CASE("the layers of a dual peel are the nearest and the farthest depth found by each pass") {
    const FragmentScene scene = columns_of_any_height(71);
    for (const char* algorithm : {"dual", "dual_independent"})
        for (const Running& running : all_ways_of_running) {
            const RenderResult result = peeled(scene, algorithm, true, running);
            std::map<Side, std::size_t> passes;
            for (const PeeledLayer& layer : result.frame.layers) {
                const std::size_t pass = passes[layer.side]++;
                // Of tied fragments dual_independent keeps one, so its layers are compared only where there is no tie.
                const bool merges = std::string(algorithm) == "dual";
                const auto found = differences(layer.color, [&](std::size_t p) {
                    const auto layers = layers_of(scene.pixels[p]);
                    const bool ties = layers.size() != scene.pixels[p].fragments.size();
                    if (!ties || merges) return layer_left(layers, layer.side, pass);
                    LayerCodes own{};
                    std::copy_n(layer.color.codes.begin() + static_cast<std::ptrdiff_t>(4 * p), 4, own.begin());
                    return own;
                });
                INFO(algorithm << " pass " << pass << (layer.side == Side::back ? " back " : " front ") << found.first);
                CHECK(found.pixels == 0);
            }
            CHECK(passes[Side::front] >= 4);
            CHECK(passes[Side::front] == passes[Side::back]);
        }
}

TEST_CASE("keeping the layers of a dual peel changes neither its picture nor its passes nor its counters") {
    const FragmentScene scene = columns_of_any_height(72);
    for (const char* algorithm : {"dual", "dual_independent"}) {
        const RenderResult with = peeled(scene, algorithm, true, {}), without = peeled(scene, algorithm, false, {});
        CHECK(with.frame.color == without.frame.color);
        CHECK(with.frame.depth == without.frame.depth);
        CHECK(with.frame.passes == without.frame.passes);
        CHECK(peeled(scene, algorithm, true, {}, true).frame.counters ==
              peeled(scene, algorithm, false, {}, true).frame.counters);
        CHECK(without.frame.layers.empty());
    }
}
