// Tests which values the passes of one tile compute, read from their log; which primitives they draw; and how a
// region's pixels are read back.
#include <bit>
#include <catch2/catch.hpp>
#include <vector>

#include "pipeline/region/region.h"
#include "tests/pipeline/frames.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr int tile_side = 8;

// Two adjacent tiles with a fragment each; that of the right one has a texture if `is_textured`.
DrawList two_tiles(bool is_textured) {
    FragmentScene left{2 * tile_side, tile_side};
    left.pixels[3].fragments = {{0.5f, {1, 1, 1, 0.5f}}};
    DrawList list = draw_list(left);
    Mesh mesh;
    add_fragment(mesh, left, 12, {0.25f, {1, 1, 1, 0.5f}});
    list.textures.push_back({});
    list.textures[0].width = list.textures[0].height = 1;
    list.textures[0].texels = {255, 255, 255, 255};
    list.materials.push_back(list.materials[0]);
    list.materials.back().texture = is_textured ? 0 : -1;
    list.instances.push_back({.mesh = static_cast<std::uint32_t>(list.meshes.size()), .material = 2});
    list.meshes.push_back(std::move(mesh));
    return list;
}

PassState colors_before_surface(Region& region) {
    PassState state;
    state.color[0] = region.make_color();
    state.needs = {.shader_z = false, .code = false};
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    return state;
}

void draw_colors(Region& region, const PassState& state) {
    static_cast<void>(
        region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; }));
}

std::vector<PassRecord> logged_passes(const DrawList& list, const Body& body) {
    const TestFrame test{list, {}, 2 * tile_side, tile_side, "geforce8", tile_side};
    return run(test.frame, body, Execution::replay, 1, {}, {.log_passes = true}).pass_log.passes;
}

}  // namespace

TEST_CASE("a tile computes coordinates for the textures of its own triangles only") {
    for (const bool is_textured : {false, true}) {
        const auto passes = logged_passes(two_tiles(is_textured), [](Region& region) {
            const PassState state = colors_before_surface(region);
            draw_colors(region, state);
            region.publish(state.color[0]);
        });
        REQUIRE(passes.size() == 2);
        CHECK_FALSE(passes[0].samples_textures);
        CHECK_FALSE(passes[0].called_for.texcoord);
        CHECK(passes[1].samples_textures == is_textured);
        CHECK(passes[1].called_for.texcoord == is_textured);
    }
}

TEST_CASE("before a cleared surface no pass computes a depth for its test until one writes the depth") {
    const auto passes = logged_passes(two_tiles(false), [](Region& region) {
        PassState state = colors_before_surface(region);
        draw_colors(region, state);
        draw_colors(region, state);
        state.depth.write = true;
        draw_colors(region, state);
        state.depth.write = false;
        draw_colors(region, state);
        region.publish(state.color[0]);
    });
    REQUIRE(passes.size() == 8);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        INFO("pass " << i % 4);
        CHECK(passes[i].needs.code == (i % 4 >= 2));
    }
}

// The first pass's test cannot fail and is skipped; a quad at the depth of the cleared surface must fail it.
TEST_CASE("a test that one pass may skip is made by the following quad") {
    const TestFrame test{two_tiles(false), {}, 2 * tile_side, tile_side, "geforce8", tile_side};
    const Body body = [](Region& region) {
        PassState state = colors_before_surface(region);
        draw_colors(region, state);
        const DrawCounts drawn = region.full_screen(state, [](const FragmentBatch&, const Loads&, Outputs& out) {
            out.replaces_depth = true;
            out.depth.fill(std::bit_cast<std::uint32_t>(1.0f));
            for (Lanes<float>& channel : out.color[0]) channel.fill(1.0f);
        });
        CHECK_FALSE(region.any(drawn.passed, Idle::no));
        region.publish(state.color[0]);
    };
    for (const Execution execution : {Execution::literal, Execution::replay}) {
        const FrameResult result = run(test.frame, body, execution, 1);
        CHECK(result.color.codes[0] == 0);
        CHECK(result.color.codes[4 * 3] != 0);
    }
}

// Of two fragments on pixel 3 the nearer one is of the other primitive. Depths are exact, and so are their codes.
TEST_CASE("a depth-only pass draws the named primitives by rows and by batches") {
    FragmentScene scene{tile_side, tile_side};
    scene.pixels[3].fragments = {{0.5f, {1, 1, 1, 0.5f}}, {0.25f, {1, 1, 1, 0.5f}}};
    const std::vector<PrimitiveRange> named{{0, 1}};
    for (const bool is_part : {false, true})
        for (const Execution execution : {Execution::literal, Execution::replay}) {
            const TestFrame test{scene, "geforce8", tile_side};
            std::uint32_t found = 0;
            const Body body = [&](Region& region) {
                PassState state;
                state.needs = {.shader_z = false, .code = false, .color = false};
                state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
                state.depth_target = region.make_depth();
                region.clear(state.depth_target, {});
                if (is_part) state.primitives = named;
                static_cast<void>(region.draw_depth(state));
                found = region.storage(state.depth_target).depth(0)[3];
                region.publish(region.opaque_color());
            };
            static_cast<void>(run(test.frame, body, execution, 1));
            CHECK(std::bit_cast<float>(found) == (is_part ? 0.5f : 0.25f));
        }
}

// Pixel p of a row of two and a half batches gets red p; only sample 0 is drawn to, the others keep green 1.
TEST_CASE("an image of rows that are longer than a batch has every pixel and sample and channel at its position") {
    constexpr int row_px = 1024;
    FragmentScene scene{row_px, 1};
    for (std::size_t p = 0; p < row_px; ++p)
        scene.pixels[p].fragments = {{0.5f, {static_cast<float>(p), 0.25f, 0.5f, 0.75f}}};
    const TestFrame test{scene, "geforce8", 64};
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    for (const Format format : {Format::rgba32f, Format::r32f})
        for (const int samples : {1, 8}) {
            PassState state;
            state.color[0] = region.make(format, samples);
            state.sample_mask = 1;
            region.clear(state.color[0], {.color = {-1, 1, 1, 1}});
            draw_colors(region, state);
            const Image image = region.targets().image(state.color[0]);
            const std::size_t channels = format == Format::r32f ? 1 : 4,
                              of_pixel = channels * static_cast<std::size_t>(samples);
            REQUIRE(image.codes.size() == row_px * of_pixel);
            int wrong = 0;
            for (std::size_t p = 0; p < row_px; ++p)
                for (std::size_t k = 0; k < of_pixel; ++k) {
                    const Rgba own{static_cast<float>(p), 0.25f, 0.5f, 0.75f}, cleared{-1, 1, 1, 1};
                    const float expected = k < channels ? own[k] : cleared[k % channels];
                    wrong += std::bit_cast<float>(image.codes[p * of_pixel + k]) != expected ? 1 : 0;
                }
            INFO(samples << " samples of " << channels << " channels");
            CHECK(wrong == 0);
        }
}
