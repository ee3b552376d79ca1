// Tests the count of duplicated and lost layers on layers and traces written by hand, one pixel per line.
#include "peeling/audit/peel_errors.h"

#include <catch2/catch.hpp>

#include "peeling/audit/region_trace.h"

using namespace strata::peeling;
using strata::pipeline::TraceEntry;

namespace {

struct Pixel {
    std::vector<std::uint32_t> layers;      // layer of each fragment, in submission order
    std::vector<std::uint32_t> composited;  // composited keys; a fragment's key is ten times its layer, plus one
};

// Two adjacent regions of a frame two rows high.
PeelErrors errors_of(const std::vector<Pixel>& pixels) {
    const int width = static_cast<int>(pixels.size() / 2);
    std::vector<LayerFragment> fragments;
    std::vector<RegionTrace> traces(2);
    traces[0].rect = {0, 0, 1, 2};
    traces[1].rect = {1, 0, width, 2};
    for (std::uint32_t p = 0; p < pixels.size(); ++p) {
        std::uint32_t primitive = 0;
        for (const std::uint32_t layer : pixels[p].layers) fragments.push_back({p, primitive++, layer, 10 * layer + 1});
        const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
        RegionTrace& trace = traces[x == 0 ? 0 : 1];
        const int pixel = y * trace.rect.width() + x - trace.rect.x0;
        for (const std::uint32_t key : pixels[p].composited)
            trace.entries.push_back({.pixel = static_cast<std::uint32_t>(pixel), .key = key});
    }
    return peel_errors(fragments, traces, width, 2);
}

}  // namespace

TEST_CASE("a layer composited several times is one duplicate and one never composited is one loss") {
    const PeelErrors errors = errors_of({{{1, 2, 3}, {11, 21, 31}},
                                         {{1, 2, 3}, {11, 11, 11, 11}},
                                         {{}, {}},
                                         {{4, 2}, {21}},
                                         {{5}, {51, 51}},
                                         {{6, 6, 7}, {61, 71}}});
    CHECK(errors.layers == 11);
    CHECK(errors.layers_max == 3);
    CHECK(errors.duplicated == 2);
    CHECK(errors.lost == 3);
    CHECK(errors.total() == 5);
    CHECK(errors.touched == PixelCount{3, 1, 0});
    CHECK(errors.map ==
          std::vector<std::uint8_t>{0, layer_duplicated | layer_lost, 0, layer_lost, layer_duplicated, 0});
}

TEST_CASE("a depth that no fragment of the pixel has is not a layer") {
    const PeelErrors errors = errors_of({{{1}, {11, 99}}, {{}, {11}}});
    CHECK(errors.layers == 1);
    CHECK(errors.total() == 0);
}
