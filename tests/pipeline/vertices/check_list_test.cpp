// Tests that inconsistent draw lists are rejected with the name of the field, and that every accepted list can be
// prepared.
#include "pipeline/vertices/check_list.h"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::pipeline;
using strata::testing::Random;
using strata::testing::random_int;

// Two meshes, two materials, a texture, three instances and a light.
DrawList whole_list() {
    DrawList list;
    for (int m = 0; m < 2; ++m) {
        Mesh mesh;
        for (int i = 0; i < 8; ++i) {
            const auto x = static_cast<float>(i % 4) / 4.0f - 0.5f, y = static_cast<float>(i / 4) - 0.5f;
            mesh.positions.push_back({x, y, 0.25f * static_cast<float>(m)});
            mesh.normals.push_back({0, 0, 1});
            mesh.colors.push_back({1, 0.5f, x, 0.5f});
            mesh.texcoords.push_back({x, y});
        }
        mesh.indices = {0, 1, 4, 1, 5, 4, 2, 3, 6, 3, 7, 6};
        list.meshes.push_back(mesh);
    }
    list.textures.push_back({.name = "checks", .width = 2, .height = 2, .texels = std::vector<std::uint8_t>(16, 200)});
    list.materials = {{.name = "glass", .alpha_mode = AlphaMode::blend, .texture = 0},
                      {.name = "leaf", .alpha_mode = AlphaMode::mask}};
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 1}, {.mesh = 1, .material = 0}};
    list.light = ShadowLight{};
    return list;
}

// The error message for the changed list; "" if it is accepted.
std::string refused(const std::function<void(DrawList&)>& change) {
    DrawList list = whole_list();
    change(list);
    try {
        check(list);
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}

strata::rasterizer::RasterState sixteen_pixels() {
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, 16, 16};
    return state;
}

PreparedDraw prepared(const DrawList& list, const strata::rasterizer::RasterState& state = sixteen_pixels()) {
    PrepareOptions options{.depth_quotient = true, .tile_size = 8, .threads = 1};
    options.units[0].enabled = true;
    return prepare(list, {}, state, *find_profile("geforce8"), options);
}

}  // namespace

TEST_CASE("a draw list is rejected with the name of its first wrong field and the expected and found values") {
    CHECK(refused([](DrawList&) {}).empty());
    CHECK(refused([](DrawList& l) { l.meshes[1].indices[7] = 31; }) ==
          "draw list: meshes[1].indices[7]: expected less than 8, found 31");
    CHECK(refused([](DrawList& l) { l.meshes[0].indices.pop_back(); }) ==
          "draw list: meshes[0].indices: expected three per primitive, found 11");
    CHECK(refused([](DrawList& l) { l.meshes[1].positions.clear(); }) ==
          "draw list: meshes[1].normals: expected none or 0, found 8");
    CHECK(refused([](DrawList& l) { l.meshes[1].normals.pop_back(); }) ==
          "draw list: meshes[1].normals: expected none or 8, found 7");
    CHECK(refused([](DrawList& l) { l.meshes[0].colors.push_back({}); }) ==
          "draw list: meshes[0].colors: expected none or 8, found 9");
    CHECK(refused([](DrawList& l) { l.meshes[0].texcoords.resize(1); }) ==
          "draw list: meshes[0].texcoords: expected none or 8, found 1");
    CHECK(refused([](DrawList& l) { l.materials[1].texture = 1; }) ==
          "draw list: materials[1].texture: expected -1 to 0, found 1");
    CHECK(refused([](DrawList& l) { l.materials[1].texture = -2; }) ==
          "draw list: materials[1].texture: expected -1 to 0, found -2");
    CHECK(refused([](DrawList& l) { l.materials[0].alpha_mode = static_cast<AlphaMode>(9); }) ==
          "draw list: materials[0].alpha_mode: expected one of opaque, mask, blend, found 9");
    CHECK(refused([](DrawList& l) { l.materials[1].alpha_cutoff = std::numeric_limits<float>::quiet_NaN(); }) ==
          "draw list: materials[1].alpha_cutoff: expected a finite number, found nan");
    CHECK(refused([](DrawList& l) { l.textures[0].texels.pop_back(); }) ==
          "draw list: textures[0].texels: expected 16 bytes, found 15");
    CHECK(refused([](DrawList& l) { l.textures[0].width = 0, l.textures[0].texels.clear(); }) ==
          "draw list: textures[0].width: expected 1 to 16384, found 0");
    CHECK(refused([](DrawList& l) { l.textures[0].width = 16385; }) ==
          "draw list: textures[0].width: expected 1 to 16384, found 16385");
    CHECK(refused([](DrawList& l) { l.textures[0].height = 0; }) ==
          "draw list: textures[0].height: expected 1 to 16384, found 0");
    CHECK(refused([](DrawList& l) { l.textures[0].wrap_t = static_cast<TextureWrap>(3); }) ==
          "draw list: textures[0].wrap_t: expected one of repeat, mirrored_repeat, clamp_to_edge, found 3");
    CHECK(refused([](DrawList& l) { l.instances[2].mesh = 2; }) ==
          "draw list: instances[2].mesh: expected less than 2, found 2");
    CHECK(refused([](DrawList& l) { l.instances[0].material = 0xffffffff; }) ==
          "draw list: instances[0].material: expected less than 2, found 4294967295");
    CHECK(refused([](DrawList& l) { l.light->size_px = 0; }) ==
          "draw list: light.size_px: expected 1 to 16384, found 0");
    CHECK(refused([](DrawList& l) { l.light->offset_units = std::numeric_limits<float>::infinity(); }) ==
          "draw list: light.offset_units: expected a finite number, found inf");
}

TEST_CASE("attributes that a mesh may lack and vertices that are not finite and empty lists are accepted") {
    CHECK(refused([](DrawList& l) { l = {}; }).empty());
    CHECK(refused([](DrawList& l) { l.meshes[0].normals.clear(), l.meshes[0].colors.clear(); }).empty());
    CHECK(refused([](DrawList& l) { l.meshes[0].texcoords.clear(); }).empty());
    DrawList list = whole_list();
    list.meshes[0].texcoords.clear();
    list.meshes[0].positions[0][1] = std::numeric_limits<float>::quiet_NaN();
    CHECK(prepared(list).geometry.counters.non_finite > 0);
}

TEST_CASE("a view and a profile with an undefined value are rejected") {
    View view;
    view.vertex_path = static_cast<VertexPath>(6);
    CHECK_THROWS_WITH(check(view),
                      "view: vertex_path: expected one of separate, fused, reassociated, double_precision, "
                      "toward_zero, nv20, found 6");
    for (const DeviceProfile& profile : builtin_profiles()) CHECK_NOTHROW(check(profile));
    DeviceProfile profile = *find_profile("geforce3");
    profile.raster.subpixel_bits = 13;
    CHECK_THROWS_WITH(check(profile), "profile: raster.subpixel_bits: expected 0 to 12, found 13");
    profile.raster.subpixel_bits = 4;
    profile.raster.tie_rule = static_cast<strata::rasterizer::TieRule>(4);
    CHECK_THROWS_WITH(check(profile), "profile: raster.tie_rule: expected 0 to 3, found 4");
    DeviceProfile spans = *find_profile("softpipe");
    spans.raster.color = strata::rasterizer::ColorInterpolation::weights_8bit;
    CHECK_THROWS_WITH(
        check(spans),
        "profile: raster.coverage: expected snapped_edges with raster.color weights_8bit, found float_spans");
}

TEST_CASE("a list with any of its numbers changed is rejected by prepare or prepared") {
    constexpr std::uint64_t seed = 961;
    Random random{seed};
    int refusals = 0, done = 0;
    const auto number = [&]() -> std::uint32_t {
        return random_int(random, 0, 1) == 0 ? static_cast<std::uint32_t>(random_int(random, 0, 12))
                                             : static_cast<std::uint32_t>(random() >> random_int(random, 0, 40));
    };
    const auto size = [&] { return static_cast<std::size_t>(random_int(random, 0, 16)); };
    for (int n = 0; n < 3000; ++n) {
        DrawList list = whole_list();
        for (int changes = random_int(random, 1, 3); changes-- > 0;) {
            Mesh& mesh = list.meshes.empty() ? list.meshes.emplace_back() : list.meshes.front();
            switch (random_int(random, 0, 12)) {
                case 0: mesh.positions.resize(size()); break;
                case 1: mesh.normals.resize(size()); break;
                case 2: mesh.colors.resize(size()); break;
                case 3: mesh.texcoords.resize(size()); break;
                case 4: mesh.indices.resize(size()); break;
                case 5: mesh.indices.push_back(number()); break;
                case 6: list.materials.front().texture = static_cast<int>(number()); break;
                case 7: list.textures.front().width = static_cast<int>(number()); break;
                case 8: list.textures.front().texels.resize(4 * size()); break;
                case 9: list.instances.front().mesh = number(); break;
                case 10: list.instances.back().material = number(); break;
                case 11:
                    list.instances.back().model[size() % 4][size() % 4] = std::numeric_limits<double>::infinity();
                    break;
                default: list.meshes.resize(size() % 3); break;
            }
        }
        try {
            static_cast<void>(prepared(list));
            ++done;
        } catch (const strata::InputError& error) {
            ++refusals;
            if (!std::string_view{error.what()}.starts_with("draw list: ")) FAIL(error.what());
        }
    }
    INFO("seed " << seed << ": " << refusals << " refused, " << done << " prepared");
    CHECK(refusals > 1000);
    CHECK(done > 150);
}

TEST_CASE("an undefined state is rejected by prepare") {
    strata::rasterizer::RasterState state = sixteen_pixels();
    state.clip_plane_count = 7;
    CHECK_THROWS_WITH(prepared(whole_list(), state), "raster state: clip_plane_count: expected 0 to 6, found 7");
    state.clip_plane_count = 0;
    state.depth_far = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(prepared(whole_list(), state), "raster state: depth_far: expected a finite number, found nan");
}
