// Tests properties that all procedural scenes must have, and the error messages for their names.
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "scenes/scene.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;

namespace {

std::string message(const std::string& spec, const SceneOptions& options = {}) {
    try {
        (void)load_scene(spec, options);
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "accepted";
}

void check_is_sound(const Scene& scene) {
    for (const auto& mesh : scene.list.meshes) {
        CHECK(mesh.indices.size() % 3 == 0);
        std::size_t outside = 0;
        for (const auto index : mesh.indices) outside += index >= mesh.positions.size() ? 1 : 0;
        CHECK(outside == 0);
        CHECK((mesh.colors.empty() || mesh.colors.size() == mesh.positions.size()));
        CHECK((mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()));
    }
    for (const auto& instance : scene.list.instances) {
        CHECK(instance.mesh < scene.list.meshes.size());
        CHECK(instance.material < scene.list.materials.size());
        const bool unlit = scene.list.materials[instance.material].unlit;
        CHECK((unlit || !scene.list.meshes[instance.mesh].normals.empty()));
    }
}

}  // namespace

TEST_CASE(
    "every listed procedural scene loads by its name alone and is valid and has bounds that contain its vertices") {
    for (const ProceduralScene& entry : procedural_scenes()) {
        INFO(entry.name);
        CHECK(is_procedural(entry.name));
        const Scene scene = load_scene(entry.name, {});
        CHECK(scene.name == entry.name);
        check_is_sound(scene);
        for (const auto& mesh : scene.list.meshes) {
            for (const auto& p : mesh.positions) {
                for (std::size_t i = 0; i < 3; ++i) {
                    REQUIRE(double{p[i]} >= scene.bounds.lo[i]);
                    REQUIRE(double{p[i]} <= scene.bounds.hi[i]);
                }
            }
        }
    }
}

TEST_CASE("without light every material of a procedural scene is unlit") {
    for (const ProceduralScene& entry : procedural_scenes())
        for (const auto& material : load_scene(entry.name, {.light = false}).list.materials) CHECK(material.unlit);
}

TEST_CASE("in the linear space the colours of a procedural scene are decoded and nothing else changes") {
    for (const char* spec : {"teapot", "volume-beam:slices=3", "random:triangles=50"}) {
        const Scene a = load_scene(spec, {}),
                    b = load_scene(spec, {.color_space = strata::pipeline::ColorSpace::linear});
        CHECK(a.list.meshes[0].positions == b.list.meshes[0].positions);
        const auto decode = [](double e) { return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4); };
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& red = a.list.materials[0].front;
            const double expected = i < 3 ? decode(double{red[i]}) : double{red[i]};
            CHECK(double{b.list.materials[0].front[i]} == Approx(expected).epsilon(1e-6));
            if (a.list.meshes[0].colors.empty()) continue;
            const double vertex = double{a.list.meshes[0].colors[0][i]};
            CHECK(double{b.list.meshes[0].colors[0][i]} == Approx(i < 3 ? decode(vertex) : vertex).epsilon(1e-6));
        }
    }
}

TEST_CASE("every fault of a scene name gives one error message with the nearest name") {
    CHECK(message("teapt") ==
          "teapt: scene: expected a .gltf, .glb, .obj, .ply, .stl or .off file, a pack's folder, triangles in .npy or "
          ".json, or one of teapot, "
          "volume-beam, random, planes, shadow-demo, "
          "showroom, wireframe, hair, splats, hard, found 'teapt' (did you mean 'teapot'?)");
    CHECK_THAT(message("xyz"), Catch::EndsWith("found 'xyz'"));
    CHECK(message("volume-beam:slice=3") ==
          "volume-beam:slice=3: parameters: expected one of slices, order, found 'slice' (did you mean 'slices'?)");
    CHECK(message("volume-beam:slices") == "volume-beam:slices: parameters: expected key=value, found 'slices'");
    CHECK(message("volume-beam:") == "volume-beam:: parameters: expected key=value, found ''");
    CHECK(message("volume-beam:slices=3,slices=3") ==
          "volume-beam:slices=3,slices=3: slices: expected one value, found two");
    for (const char* number : {"0", "65537", "-1", "3.5", "", "0x10", " 3", "99999999999999999999"}) {
        CHECK_THAT(
            message("volume-beam:slices=" + std::string{number}),
            Catch::EndsWith("slices: expected a whole number from 1 to 65536, found '" + std::string{number} + "'"));
    }
    CHECK_THAT(message("volume-beam:order=nera"), Catch::EndsWith("found 'nera' (did you mean 'near'?)"));
    CHECK_THAT(message("random:triangles=10000001"), Catch::Contains("from 0 to 10000000"));
    CHECK_THAT(message("teapot", {.scene = 1}), Catch::Contains("--scene"));
    CHECK(message("teapot", {.scene = 0}) == "accepted");
}

TEST_CASE("a procedural scene has the same bits if the host program rounds upwards or toward zero") {
    for (const char* spec : {"teapot:tessellation=5", "volume-beam:slices=9", "random:triangles=50"}) {
        const Scene before = load_scene(spec, {});
        for (const int mode : {FE_UPWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            const Scene after = load_scene(spec, {});
            const int mode_after = std::fegetround();
            std::fesetround(FE_TONEAREST);
            CHECK(after.list.meshes == before.list.meshes);
            CHECK(after.list.materials == before.list.materials);
            CHECK(mode_after == mode);
        }
    }
}

TEST_CASE("procedural scenes and their messages are the same under a locale with decimal commas") {
    const Scene before = load_scene("volume-beam:slices=1000", {});
    const std::string fault = message("volume-beam:slices=70000");
    const strata::test::CommaLocale locale;
    CHECK(load_scene("volume-beam:slices=1000", {}).list.meshes == before.list.meshes);
    CHECK(message("volume-beam:slices=70000") == fault);
}
