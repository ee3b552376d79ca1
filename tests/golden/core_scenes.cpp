// tests/golden/core_scenes.cpp - builds the five scenes of core_scenes.h.
#include "tests/golden/core_scenes.h"

namespace strata::golden {

namespace {

using pipeline::Vec3;

// Eye at the origin looking down -z: cot(fovy/2) = 2, near 1, far 5, every entry a binary fraction.
pipeline::View perspective() {
    pipeline::View view;
    view.projection = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5, 0};
    return view;
}

std::uint32_t next(std::uint32_t& state) {  // Numerical Recipes' generator; its upper bits
    state = state * 1664525u + 1013904223u;
    return state >> 16;
}

float fraction(std::uint32_t& state) { return static_cast<float>(next(state) % 256) / 256.0f; }

// Builds a draw list from quads and triangles, each with its own material.
struct Builder {
    pipeline::DrawList list;

    pipeline::Material& add(std::vector<Vec3> corners, const pipeline::Rgba& color, pipeline::AlphaMode mode) {
        pipeline::Mesh mesh;
        mesh.normals.assign(corners.size(), Vec3{0, 0, 1});
        mesh.texcoords = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
        mesh.texcoords.resize(corners.size());
        mesh.indices =
            corners.size() == 3 ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3};
        mesh.positions = std::move(corners);
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        list.meshes.push_back(std::move(mesh));
        list.materials.push_back({.name = "", .front = color, .back = color, .alpha_mode = mode, .double_sided = true});
        list.instances.push_back({.mesh = number, .material = number});
        return list.materials.back();
    }
};

std::vector<Vec3> square(float half, float z_left, float z_right) {
    return {{-half, -half, z_left}, {half, -half, z_right}, {half, half, z_right}, {-half, half, z_left}};
}

pipeline::DrawList soup() {
    Builder builder;
    std::uint32_t state = 7;
    for (int i = 0; i < 40; ++i) {
        std::vector<Vec3> corners(3);
        for (Vec3& p : corners)
            p = {fraction(state) * 3 - 1.5f, fraction(state) * 3 - 1.5f, -1.5f - fraction(state) * 3};
        const pipeline::Rgba color{fraction(state), fraction(state), fraction(state), 0.25f + fraction(state) / 2};
        builder.add(corners, color, pipeline::AlphaMode::blend);
    }
    return builder.list;
}

pipeline::DrawList stack() {  // drawn neither front to back nor back to front
    Builder builder;
    for (int i = 0; i < 8; ++i) {
        const float z = -1.5f - static_cast<float>(i * 5 % 8) * 0.375f;
        builder.add(square(1.0f, z, z), {static_cast<float>(i) / 8, 0.5f, 1, 0.375f}, pipeline::AlphaMode::blend);
    }
    return builder.list;
}

pipeline::DrawList crossing() {
    Builder builder;
    builder.add(square(1.25f, -1.5f, -4), {1, 0, 0, 0.5f}, pipeline::AlphaMode::blend);
    builder.add(square(1.25f, -4, -1.5f), {0, 1, 0, 0.5f}, pipeline::AlphaMode::blend);
    builder.add(square(1.25f, -2.75f, -2.75f), {0, 0, 1, 0.5f}, pipeline::AlphaMode::blend);
    return builder.list;
}

pipeline::DrawList ties() {  // the same square three times, in front of an opaque one
    Builder builder;
    builder.add(square(1.5f, -4, -4), {0.25f, 0.25f, 0.25f, 1}, pipeline::AlphaMode::opaque);
    for (int i = 0; i < 3; ++i) {
        const auto channel = static_cast<std::size_t>(i);
        pipeline::Rgba color{0, 0, 0, 0.5f};
        color[channel] = 1;
        builder.add(square(1, -2, -3), color, pipeline::AlphaMode::blend);
    }
    return builder.list;
}

pipeline::DrawList textured() {
    Builder builder;
    pipeline::Texture texture{.name = "ramp", .width = 4, .height = 4, .texels = {}};
    for (int i = 0; i < 16; ++i) {
        for (const int value : {i * 17, 255 - i * 9, i * 7, 255 - i * 15})
            texture.texels.push_back(static_cast<std::uint8_t>(value));
    }
    builder.list.textures.push_back(texture);
    builder.add(square(1.5f, -3.5f, -3), {1, 1, 1, 1}, pipeline::AlphaMode::mask).texture = 0;
    builder.add(square(1, -2, -4), {1, 1, 0.5f, 0.75f}, pipeline::AlphaMode::blend).texture = 0;
    builder.add(square(0.75f, -3, -1.5f), {0.5f, 1, 1, 0.75f}, pipeline::AlphaMode::blend).texture = 0;
    return builder.list;
}

}  // namespace

std::vector<GoldenScene> core_scenes() {
    std::vector<GoldenScene> scenes(5);
    scenes[0] = {.name = "soup", .list = soup()};
    scenes[1] = {.name = "stack", .list = stack()};
    scenes[2] = {.name = "crossing", .list = crossing()};
    scenes[3] = {.name = "ties", .list = ties()};
    scenes[4] = {.name = "textured", .list = textured()};
    for (GoldenScene& scene : scenes) scene.view = perspective();
    return scenes;
}

}  // namespace strata::golden
