// Tests bucket_peel against buckets of sorted depths in real numbers. peeling/reference/algorithms.md 24.
#include <catch2/catch.hpp>
#include <limits>
#include <map>

#include "peeling/programs/fixed_passes/buckets.h"
#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Fault;

const ExpectedRow expected_bucket_peel{{.algorithm = "bucket_peel",
                                        .devices = Devices::programmable,
                                        .passes = [](int) { return 6; },
                                        .targets = {"bounds", "buckets", "layer", "accumulated", "result"},
                                        .render_targets = 8,
                                        .loses_ties = true}};

struct Bucketed {
    Color3 color{};
    bool is_lost = false;
};

// The expected pixel. Fragments of equal depth are one layer: the greatest value of each channel of premultiplied
// colour and of alpha.
Bucketed bucketed(const GivenPixel& pixel) {
    std::map<float, RealLayer> by_depth;
    for (const GivenFragment& f : visible(pixel)) {
        const RealLayer own = layer_of(f);
        RealLayer& merged = by_depth.try_emplace(f.depth, RealLayer{{}, 1}).first->second;
        for (std::size_t c = 0; c < 3; ++c) merged.color[c] = std::max(merged.color[c], own.color[c]);
        merged.through = std::min(merged.through, own.through);
    }
    Bucketed result;
    RealLayer all;
    std::map<int, std::vector<RealLayer>> buckets;
    if (!by_depth.empty()) {
        const double near = by_depth.begin()->first, far = by_depth.rbegin()->first;
        for (const auto& [depth, layer] : by_depth)
            buckets[near == far ? 0 : std::min(15, static_cast<int>(16 * (depth - near) / (far - near)))].push_back(
                layer);
    }
    for (const auto& [number, layers] : buckets) {
        all = joined(all, layers.front());
        if (layers.size() > 1) all = joined(all, layers.back());
        result.is_lost |= layers.size() > 2;
    }
    result.color = over(all, behind(pixel));
    return result;
}

}  // namespace

TEST_CASE("a bucket is from 0 to 15 also for depths outside the bounds and for NaN") {
    using strata::peeling::bucket_of;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float minus_near = -0.5f, far = 0.75f;
    CHECK(bucket_of(false, 0.5f, minus_near, far) == 0);
    CHECK(bucket_of(false, 0.625f, minus_near, far) == 8);
    CHECK(bucket_of(false, 0.75f, minus_near, far) == 15);
    CHECK(bucket_of(false, 0.25f, minus_near, far) == 0);
    CHECK(bucket_of(false, 2.0f, minus_near, far) == 15);
    CHECK(bucket_of(false, 0.25f, -0.5f, 0.5f) == 0);
    CHECK(bucket_of(false, infinity, minus_near, infinity) == 0);
}

TEST_CASE(
    "bucket_peel composites the ends of 16 buckets and merges ties and reports lost fragments in every execution") {
    std::size_t lost = 0;
    for (const bool is_crowded : {false, true}) {
        FragmentScene scene = eighths_scene(61, 6);
        // In a quarter of the pixels one fragment is far away, so that all others are in one bucket.
        if (is_crowded)
            for (std::size_t p = 0; p < scene.pixels.size(); p += 4) {
                scene.pixels[p].opaque.reset();
                for (std::size_t i = 0; i < scene.pixels[p].fragments.size(); ++i)
                    scene.pixels[p].fragments[i].depth = i == 0 ? 0.9375f : static_cast<float>(i) / 1024;
            }
        RenderOptions options = eighths_options(scene);
        bool are_alike = true;
        const RenderResult result = rendered_alike(scene, "bucket_peel", options, are_alike);
        REQUIRE_FALSE(result.refusal);
        std::size_t losing = 0;
        CHECK(first_unlike(result.frame.color, [&](std::size_t p) {
                  const Bucketed pixel = bucketed(scene.pixels[p]);
                  losing += pixel.is_lost ? 1 : 0;
                  return pixel.color;
              }) == "");
        CHECK(are_alike);
        CHECK(diagnosed(result, Fault::buffer_overflow) == losing);
        lost += losing;
    }
    CHECK(lost > 10);
}
