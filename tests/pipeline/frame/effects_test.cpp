// Tests the effects that passes need on small lists whose tiles are known, against the rule of effects.h.
#include "pipeline/frame/effects.h"

#include <catch2/catch.hpp>

namespace {

using namespace strata;
using namespace strata::pipeline;

// Squares over pixels [x, x + 4) x [0, 4) of a 16 x 8 frame: two tiles of 8.
PreparedDraw squares(const std::vector<float>& xs) {
    DrawList list;
    list.materials = {{.name = "blend", .alpha_mode = AlphaMode::blend, .double_sided = true, .unlit = true}};
    for (const float x : xs) {
        const float l = x / 8 - 1, r = (x + 4) / 8 - 1, top = 1, bottom = 0;
        list.instances.push_back({static_cast<std::uint32_t>(list.meshes.size()), 0});
        Mesh& mesh = list.meshes.emplace_back();
        mesh.positions = {{l, top, 0}, {r, top, 0}, {l, bottom, 0}, {r, bottom, 0}};
        mesh.indices = {0, 1, 2, 2, 1, 3};
    }
    rasterizer::RasterState state;
    state.viewport = {0, 0, 16, 8};
    return prepare(list, {}, state, *find_profile("geforce8"), {.tile_size = 8, .threads = 1});
}

}  // namespace

TEST_CASE("a tile is empty or opaque only or single or layered according to the fragments of its own pixels") {
    const TileCensus nothing = count_tiles(squares({}), squares({}));
    CHECK(nothing == TileCensus{.tiles = 2, .empty = 2, .transparent_fragments = {0}, .opaque_fragments = {0}});
    // Next to each other in one tile: two fragments, but no pixel has both.
    const TileCensus single = count_tiles(squares({0, 4}), squares({8}));
    CHECK(single == TileCensus{.tiles = 2,
                               .opaque_only = 1,
                               .single = 1,
                               .with_opaque = 1,
                               .transparent_fragments = {32},
                               .opaque_fragments = {16}});
    const TileCensus layered = count_tiles(squares({0, 3, 8}), squares({}));
    CHECK(layered ==
          TileCensus{.tiles = 2, .single = 1, .layered = 1, .transparent_fragments = {48}, .opaque_fragments = {0}});
}

TEST_CASE("a pass needs the values that it uses and under Effects::all everything") {
    const MaterialNeeds plain;
    PassState state;
    state.needs = {.shader_z = false, .code = false, .exact_code = false, .color = false};
    CHECK(pass_needs(state, plain, Effects::needed) == state.needs);
    PassState testing = state;
    testing.depth.enabled = true;
    CHECK(pass_needs(testing, plain, Effects::needed).code);
    testing = state;
    testing.needs.reference = true;  // a compared depth is compared with the stored one
    CHECK(pass_needs(testing, plain, Effects::needed).code);
    testing = state;
    testing.depth_unit_count = 1;
    CHECK(pass_needs(testing, plain, Effects::needed).code);
    testing = state;
    testing.stencil = {.enabled = true, .two_sided = true, .front = {}, .back = {}};
    CHECK(pass_needs(testing, plain, Effects::needed).facing);
    const MaterialNeeds textured{.texcoord = true};
    CHECK_FALSE(pass_needs(state, textured, Effects::needed).texcoord);  // its colour is not used
    const MaterialNeeds masked{.texcoord = true, .color = true};
    CHECK(pass_needs(state, masked, Effects::needed).color);
    CHECK(pass_needs(state, masked, Effects::needed).texcoord);
    const auto all = pass_needs(state, plain, Effects::all);
    CHECK((all.shader_z && all.code && all.color && all.texcoord && all.facing && !all.exact_code));
}

TEST_CASE("a tile's materials need no more than the list's and nothing if no triangle has them") {
    PreparedDraw list = squares({0, 8});  // one square per tile
    for (std::uint32_t t = 0; t < list.geometry.triangles.size(); ++t)
        list.geometry.triangles[t].material = list.geometry.bin(1).front() <= t ? 1 : 0;
    const Texture texture;
    list.materials = {{}, {.texture = &texture, .mask = {.enabled = true}}};
    list.needs = {.texcoord = true, .color = true};
    CHECK(needs_of(list, list.geometry.bin(0)) == MaterialNeeds{});
    CHECK(needs_of(list, list.geometry.bin(1)) == list.needs);
    CHECK(needs_of(list, {}) == MaterialNeeds{});
}
