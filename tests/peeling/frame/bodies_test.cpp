// Tests passes that no algorithm of the papers has, written against Region as a user would. Every execution must give
// the same pixels, which are those that the passes define.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "pipeline/region/region.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

}  // namespace

// The first clear of the opaque depth is recorded, so that tests against it may be skipped; later contents must be
// tested.
TEST_CASE(
    "a depth that an algorithm copies or clears into the opaque depth hides what is behind it in every execution") {
    const bool clears = GENERATE(false, true);
    FragmentScene scene{20, 12};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        scene.pixels[p].fragments = {{p % 2 == 0 ? 0.25f : 0.75f, {1, 1, 1, 1}}};
    strata::peeling::Algorithm algorithm = *strata::peeling::find_algorithm("unsorted");
    algorithm.body = [clears](strata::pipeline::Region& region) {
        using namespace strata::pipeline;
        const Target half = region.make_depth(), result = region.make_color();
        region.clear(clears ? region.opaque_depth() : half, {.depth = 0.5f});
        if (!clears) region.copy(half, region.opaque_depth());
        region.clear(result, {});
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
        state.depth_target = region.opaque_depth();
        state.color[0] = result;
        state.needs.shader_z = state.needs.code = false;
        static_cast<void>(
            region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; }));
        region.publish(result);
    };
    for (const auto& running : all_ways_of_running) {
        RenderOptions options = options_for(scene);
        running.apply(options);
        options.audit = false;
        const auto list = draw_list(scene);
        strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile("geforce8"), options};
        const RenderResult result = renderer.render(algorithm, {}, {});
        for (std::size_t p = 0; p < scene.pixels.size(); ++p)
            CHECK(result.frame.color.codes[4 * p] == (p % 2 == 0 ? 255u : 0u));
    }
}

// The second layer's program writes the window position; its fragments are found by their keys, without rasterizing
// them again.
TEST_CASE("a program sees the same window position in a pass that visits only selected fragments") {
    FragmentScene scene{20, 12};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        for (const float depth : {0.75f, 0.25f, 0.5f, 0.875f, 0.625f, 0.9375f})
            scene.pixels[p].fragments.push_back({depth, {1, 1, 1, 1}});
    strata::peeling::Algorithm algorithm = *strata::peeling::find_algorithm("front_to_back");
    algorithm.resolve_loop = nullptr;
    algorithm.body = [](strata::pipeline::Region& region) {
        using namespace strata::pipeline;
        const Target first = region.make_depth(), second = region.make_depth(), result = region.make_color();
        region.clear(result, {});
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = first;
        state.needs.color = false;
        state.selection = {.keeps = KeptFragments::nearest};
        region.clear(first, {.depth = 1.0f});
        region.clear(second, {.depth = 1.0f});
        static_cast<void>(region.draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {}));
        state.depth_target = second;
        state.color[0] = result;
        state.reads[0] = first;
        state.selection.near = strata::pipeline::KeyBound::beyond(first);
        static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                out.alive[i] &= mask(in.code[i] > loads.depth(0)[i]);
                out.color[0][0][i] = static_cast<float>(in.x[i]) / 255.0f;
                out.color[0][1][i] = static_cast<float>(in.y[i]) / 255.0f;
            }
        }));
        region.publish(result);
    };
    for (const auto& running : all_ways_of_running) {
        RenderOptions options = options_for(scene);
        running.apply(options);
        options.tile_size = 8;
        options.audit = false;
        options.color_format = strata::pipeline::Format::rgba8;
        const auto list = draw_list(scene);
        strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile("geforce8"), options};
        const RenderResult result = renderer.render(algorithm, {}, {});
        for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
            CHECK(result.frame.color.codes[4 * p] == p % 20);
            CHECK(result.frame.color.codes[4 * p + 1] == p / 20);
        }
    }
}

// An unclamped D32F buffer keeps -1, whose bits as an integer are larger than those of any depth.
TEST_CASE("nothing passes LESS against a depth below 0 in a pass that visits only selected fragments") {
    FragmentScene scene{20, 12};
    for (GivenPixel& pixel : scene.pixels)
        for (const float depth : {0.75f, 0.25f, 0.5f, 0.875f, 0.625f, 0.9375f})
            pixel.fragments.push_back({depth, {1, 1, 1, 1}});
    strata::peeling::Algorithm algorithm = *strata::peeling::find_algorithm("front_to_back");
    algorithm.resolve_loop = nullptr;
    algorithm.body = [](strata::pipeline::Region& region) {
        using namespace strata::pipeline;
        const Target depth = region.make_depth(), result = region.make_color();
        region.clear(result, {});
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = depth;
        state.selection = {.keeps = KeptFragments::nearest};
        for (const float cleared : {1.0f, -1.0f}) {
            if (cleared < 0) state.color[0] = result;
            region.clear(depth, {.depth = cleared});
            static_cast<void>(region.draw(
                state, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; }));
        }
        region.publish(result);
    };
    for (const auto& running : all_ways_of_running) {
        RenderOptions options = options_for(scene);
        running.apply(options);
        options.audit = false;
        options.raster.depth_clamp = false;
        const auto list = draw_list(scene);
        strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile("geforce8"), options};
        const RenderResult result = renderer.render(algorithm, {}, {});
        CHECK(std::ranges::count(result.frame.color.codes, 0u) == std::ssize(result.frame.color.codes));
    }
}
