// tests/support/random_triangles.h - random triangles in a perspective view: opaque, masked and transparent, lit and
// unlit, plain and textured. Some triangles occur twice, so that depths tie.
#pragma once
#include "tests/support/random_numbers.h"

namespace strata::testing {

struct TriangleScene {
    pipeline::DrawList list;
    pipeline::View view;
};

[[nodiscard]] inline pipeline::Texture random_texture(Random& random) {
    pipeline::Texture texture{.name = "noise", .width = 4, .height = 8, .texels = {}};
    for (int i = 0; i < 4 * 8 * 4; ++i) texture.texels.push_back(static_cast<std::uint8_t>(random_int(random, 0, 255)));
    return texture;
}

// 0: transparent, 1: transparent and textured, 2: masked and textured, 3: opaque, lit, single-sided.
[[nodiscard]] inline std::vector<pipeline::Material> four_materials() {
    using pipeline::AlphaMode;
    return {
        {.name = "glass", .alpha_mode = AlphaMode::blend, .double_sided = true, .unlit = true},
        {.name = "print", .back = {1, 0.5f, 1, 1}, .alpha_mode = AlphaMode::blend, .texture = 0, .double_sided = true},
        {.name = "leaf", .alpha_mode = AlphaMode::mask, .alpha_cutoff = 0.375f, .texture = 0, .double_sided = true},
        {.name = "stone", .back = {0.5f, 1, 1, 1}}};
}

// `reach`: fraction of the view that the triangles may fill, from its lower left corner. The eye is at the origin and
// looks down -z.
[[nodiscard]] inline TriangleScene random_triangles(std::uint64_t seed, int triangles, float reach = 1.0f) {
    Random random{seed};
    TriangleScene scene;
    scene.view.projection = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5, 0};  // near plane 1, far plane 5
    scene.list.materials = four_materials();
    scene.list.textures = {random_texture(random)};
    for (std::uint32_t material = 0; material < 4; ++material) {
        pipeline::Mesh mesh;
        for (int corner = 0; corner < (material < 2 ? 3 : 1) * triangles / 2; ++corner) {
            const float z = random_float(random, 1.1f, 4.8f);
            mesh.positions.push_back({(random_float(random, 0, 1.2f) * reach - 0.55f) * z,
                                      (random_float(random, 0, 1.2f) * reach - 0.55f) * z, -z});
            mesh.normals.push_back(
                {random_float(random, -1, 1), random_float(random, -1, 1), random_float(random, -1, 1)});
            mesh.colors.push_back(random_color(random));
            mesh.texcoords.push_back({random_float(random, -1, 2), random_float(random, -1, 2)});
        }
        const auto count = static_cast<std::uint32_t>(mesh.positions.size() / 3 * 3);
        for (std::uint32_t i = 0; i < count; ++i) mesh.indices.push_back(i);
        // repeated triangles, for ties
        for (std::uint32_t i = 0; material == 0 && i < count / 2 / 3 * 3; ++i) mesh.indices.push_back(i);
        scene.list.instances.push_back({.mesh = material, .material = material});
        scene.list.meshes.push_back(std::move(mesh));
    }
    return scene;
}

[[nodiscard]] inline TriangleScene opaque_only(std::uint64_t seed, int triangles) {
    TriangleScene scene = random_triangles(seed, triangles);
    scene.list.instances = {scene.list.instances[2], scene.list.instances[3]};
    return scene;
}

}  // namespace strata::testing
