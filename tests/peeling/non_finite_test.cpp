// Tests the diagnostics of infinities and NaN on sums that overflow at known pixels.
#include <catch2/catch.hpp>
#include <limits>

#include "peeling/registry.h"
#include "pipeline/region/region.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

constexpr float infinity = std::numeric_limits<float>::infinity();

// Sums 40000 times every colour: two white fragments exceed binary16. Then draws a quad by `program` from the sums.
template <class Program>
RenderResult overflowing(const FragmentScene& scene, bool is_named, const Program& program) {
    strata::peeling::Algorithm algorithm = *strata::peeling::find_algorithm("unsorted");
    algorithm.body = [&](Region& region) {
        const Target sum = region.make(Format::rgba16f), far = region.make(Format::rgba32f),
                     result = region.make_color();
        if (is_named) region.set_name(sum, "sum");
        region.clear(sum, {});
        region.clear(far, {.color = {infinity, infinity, infinity, infinity}});
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
        state.depth_target = region.opaque_depth();
        state.color[0] = sum;
        state.blend[0] = blend_mode::sum;
        static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                    out.color[0][c][i] = 40000.0f * in.color[c][i];
        }));
        PassState quad;
        quad.color[0] = result;
        quad.reads[0] = sum;
        static_cast<void>(region.full_screen(quad, program));
        region.publish(result);
    };
    RenderOptions options = options_for(scene);
    options.tile_size = 8;
    options.audit = false;
    options.color_format = Format::rgba16f;
    const auto list = draw_list(scene);
    return strata::peeling::Renderer{list, {}, *find_profile("geforce8"), options}.render(algorithm, {}, {});
}

// One white fragment at every pixel, two at (5, 3), (20, 3) and (1, 9), in three of six tiles.
FragmentScene scene_with_three_overflows() {
    FragmentScene scene{32, 16};
    for (GivenPixel& pixel : scene.pixels) pixel.fragments = {{0.5f, {1, 1, 1, 1}}};
    for (const std::size_t p : {3u * 32 + 5, 3u * 32 + 20, 9u * 32 + 1})
        scene.pixels[p].fragments.push_back({0.25f, {1, 1, 1, 1}});
    return scene;
}

std::vector<Diagnostic> non_finite(const RenderResult& result) {
    std::vector<Diagnostic> found;
    for (const Diagnostic& d : result.frame.diagnostics)
        if (d.fault == Fault::non_finite_target) found.push_back(d);
    return found;
}

const auto zero = [](const FragmentBatch&, const Loads&, Outputs&) {};
// inf / inf where the sum has overflowed.
const auto quotient = [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
        out.color[0][0][i] = loads.color(0)[0][i] / loads.color(0)[3][i];
};

}  // namespace

TEST_CASE("a target of a user's algorithm that contains infinity is reported by name with its first pixel") {
    const auto found = non_finite(overflowing(scene_with_three_overflows(), true, zero));
    REQUIRE(found.size() == 1);  // the target that was cleared to infinity is not reported
    CHECK(found[0].pixels == 3);
    CHECK(found[0].first_x == 5);
    CHECK(found[0].first_y == 3);
    CHECK(found[0].detail == "target sum holds infinity or NaN");
}

TEST_CASE(
    "NaN in the picture is reported next to the infinity that caused it and targets without a name have their number") {
    const auto found = non_finite(overflowing(scene_with_three_overflows(), false, quotient));
    REQUIRE(found.size() == 2);
    for (const Diagnostic& d : found) {
        CHECK(d.pixels == 3);
        CHECK(d.first_x == 5);
    }
    CHECK(std::ranges::count(found, "target result holds infinity or NaN", &Diagnostic::detail) == 1);
}

TEST_CASE("a picture whose targets stay finite has no such diagnostic") {
    FragmentScene scene{8, 8};
    for (GivenPixel& pixel : scene.pixels) pixel.fragments = {{0.5f, {1, 1, 1, 1}}};
    CHECK(non_finite(overflowing(scene, true, quotient)).empty());
}
