// Tests the option that blends named materials, against a list of materials changed by hand.
#include "scenes/blended_materials.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"

using namespace strata::scenes;
using strata::pipeline::AlphaMode;
using strata::pipeline::DrawList;

namespace {

DrawList three_materials() {
    DrawList list;
    list.materials = {
        {.name = "wall", .front = {0.5f, 0.5f, 0.5f, 1}, .back = {1, 0, 0, 1}},
        {.name = "pane", .front = {1, 1, 1, 0.5f}, .back = {1, 1, 1, 0.5f}, .alpha_mode = AlphaMode::blend},
        {.name = "leaf", .alpha_mode = AlphaMode::mask}};
    return list;
}

}  // namespace

TEST_CASE("named materials are blended with their own alpha times the requested one and no others") {
    DrawList list = three_materials();
    const std::vector<MaterialAlpha> wanted{{"wall", 0.25f}, {"pane", 0.5f}};
    blend_materials(list, wanted, "scene");
    DrawList expected = three_materials();
    expected.materials[0].alpha_mode = AlphaMode::blend;
    expected.materials[0].front[3] = expected.materials[0].back[3] = 0.25f;
    expected.materials[1].front[3] = expected.materials[1].back[3] = 0.25f;
    CHECK(list.materials == expected.materials);
}

TEST_CASE("an unknown material name and a material with an alpha cutoff are rejected") {
    DrawList list = three_materials();
    CHECK_THROWS_WITH(blend_materials(list, std::vector<MaterialAlpha>{{"pan", 0.5f}}, "room.glb"),
                      "room.glb: --alpha: expected a material of the scene (strata scene lists them), found 'pan' (did "
                      "you mean 'pane'?)");
    CHECK_THROWS_WITH(blend_materials(list, std::vector<MaterialAlpha>{{"leaf", 0.5f}}, "room.glb"),
                      "room.glb: --alpha: expected a material whose alphaMode is OPAQUE or BLEND, found 'leaf', whose "
                      "alphaMode is MASK");
}
