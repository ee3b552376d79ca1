// Tests user-defined algorithms. The expected values are sums of the shader's outputs over triangles that cover every
// pixel, worked out by hand.
#include <atomic>
#include <bit>
#include <catch2/catch.hpp>

#include "pipeline/region/region.h"
#include "strata/strata.h"

using namespace strata;
using namespace strata::pipeline;

namespace {

// Every fragment adds (gain a, 0, 0) and is counted.
struct Gain {
    float gain;
    std::atomic<std::uint64_t>* seen;
    void operator()(const FragmentBatch& in, const Loads&, Outputs& out) const {
        *seen += static_cast<std::uint64_t>(in.count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            out.color[0][0][i] = gain * in.color[3][i];
            out.color[0][1][i] = out.color[0][2][i] = out.color[0][3][i] = 0;
        }
    }
};

Algorithm adding(const Gain& program, bool whole_frame = false) {
    return own_algorithm(
        "adding",
        [program](Region& region) {
            const Target sum = region.make_color();
            region.copy(region.opaque_color(), sum);
            PassState state;
            state.color[0] = sum;
            state.blend[0] = blend_mode::sum;
            region.begin_iteration();
            static_cast<void>(region.draw(state, program));
            region.publish(sum);
        },
        whole_frame);
}

// Three triangles that each cover the whole frame, with alpha 0.5, 0.25 and 0.125.
Scene three_screens() {
    const float corners[] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
    Scene scene;
    for (const float alpha : {0.5f, 0.25f, 0.125f}) scene.add({.positions = {corners, 3}, .color = {1, 1, 1, alpha}});
    return scene;
}

const RenderOptions float_options{.width = 40, .height = 30, .color_format = Format::rgba32f, .tile_size = 8};

}  // namespace

TEST_CASE("a user-defined algorithm runs with its state in every execution and on every thread") {
    for (const Execution execution : {Execution::literal, Execution::replay})
        for (const int threads : {1, 3}) {
            std::atomic<std::uint64_t> seen = 0;
            RenderOptions options = float_options;
            options.execution = execution;
            options.threads = threads;
            const Rendering picture = render(three_screens(), adding({4.0f, &seen}), profile("ideal"), options);
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < picture.color().codes.size(); i += 4)
                wrong += std::bit_cast<float>(picture.color().codes[i]) != 4.0f * 0.875f;
            CHECK(wrong == 0);
            CHECK(picture.geometry_passes() == 1);
            CHECK(seen >= 3u * 40 * 30);
        }
}

TEST_CASE("a user-defined algorithm that takes the whole frame sees every fragment once") {
    std::atomic<std::uint64_t> seen = 0;
    const Rendering picture = render(three_screens(), adding({1.0f, &seen}, true), profile("ideal"), float_options);
    CHECK_FALSE(picture.is_refused());
    CHECK(seen == 3u * 40 * 30);
}

TEST_CASE("passes lists the passes of a user-defined algorithm and a device without its blending rejects it") {
    std::atomic<std::uint64_t> seen = 0;
    const auto shown = passes(three_screens(), adding({1.0f, &seen}), profile("ideal"), float_options);
    REQUIRE(shown.size() == 2);
    CHECK(shown[0].passed == 3u * 40 * 30);
    const Rendering refused = render(three_screens(), adding({1.0f, &seen}), profile("geforce3"), float_options);
    CHECK(refused.is_refused());
    CHECK_THROWS_AS(refused.color(), Refused);
}

TEST_CASE("an algorithm without a body is an input error that names it") {
    CHECK_THROWS_WITH(own_algorithm("empty", {}), Catch::Contains("algorithm 'empty': body"));
    Algorithm nothing;
    nothing.name = "nothing";
    CHECK_THROWS_WITH(render(three_screens(), nothing, profile("ideal"), float_options),
                      Catch::Contains("algorithm 'nothing': run"));
}
