// tests/peeling/truth/chain_scene.h - random triangles in perspective: some are opaque, some cross the near plane, some
// are textured.
#pragma once
#include "pipeline/vertices/draw_list.h"
#include "tests/support/random_numbers.h"

namespace strata::testing {

struct ChainSceneParts {
    int transparent = 12, opaque = 4;
    bool has_texture = false, has_mask = false;
};

// Eye at the origin, looking along -z: w = -z, near 1, far 9.
inline const pipeline::View chain_view{.view = strata::identity,
                                       .projection = {1.5, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, -1.25, -1, 0, 0, -2.25, 0}};

inline void add_chain_triangles(Random& random, int count, pipeline::Mesh& mesh) {
    for (int i = 0; i < 3 * count; ++i) {
        const float z = random_float(random, -8, i % 7 == 0 ? 0.5f : -1.5f);
        const float x = random_float(random, -3, 3);
        const float y = random_float(random, -3, 3);
        mesh.positions.push_back({x, y, z});
        mesh.colors.push_back(random_color(random));
        const float s = random_float(random, -1, 2);
        const float t = random_float(random, -1, 2);
        mesh.texcoords.push_back({s, t});
        mesh.indices.push_back(static_cast<std::uint32_t>(i));
    }
}

[[nodiscard]] inline pipeline::DrawList random_chain_list(std::uint64_t seed, const ChainSceneParts& parts) {
    Random random{seed};
    pipeline::DrawList list;
    pipeline::Texture texture;
    texture.width = 4;
    texture.height = 2;
    texture.wrap_t = pipeline::TextureWrap::mirrored_repeat;
    for (int i = 0; i < 32; ++i) texture.texels.push_back(static_cast<std::uint8_t>(random_int(random, 0, 255)));
    list.textures = {texture};
    const int number = parts.has_texture ? 0 : -1;
    list.materials = {{.name = "glass",
                       .front = {1, 1, 1, 0.75f},
                       .back = {0.5f, 1, 1, 0.5f},
                       .alpha_mode = pipeline::AlphaMode::blend,
                       .texture = number,
                       .double_sided = true,
                       .unlit = true},
                      {.name = "wall",
                       .alpha_mode = parts.has_mask ? pipeline::AlphaMode::mask : pipeline::AlphaMode::opaque,
                       .texture = number,
                       .unlit = true}};
    list.meshes.resize(2);
    add_chain_triangles(random, parts.transparent, list.meshes[0]);
    add_chain_triangles(random, parts.opaque, list.meshes[1]);
    for (std::uint32_t i = 0; i < 2; ++i)
        if (!list.meshes[i].indices.empty()) list.instances.push_back({.mesh = i, .material = i});
    return list;
}

}  // namespace strata::testing
