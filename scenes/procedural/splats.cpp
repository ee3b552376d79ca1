// scenes/procedural/splats.cpp - scatters points over the teapot (splats.h).
#include "scenes/procedural/splats.h"

#include <algorithm>

#include "rasterizer/base/split_mix.h"
#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/teapot.h"

namespace strata::scenes {
namespace {

constexpr int cells = 16, texels = 16;
constexpr float point_alpha = 0.5f;

pipeline::Texture soft_disc() {
    pipeline::Texture disc;
    disc.width = disc.height = texels;
    disc.wrap_s = disc.wrap_t = pipeline::TextureWrap::clamp_to_edge;
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            // In half texels from the middle; the circle touches the sides.
            const int dx = 2 * x + 1 - texels, dy = 2 * y + 1 - texels, squared = dx * dx + dy * dy;
            const int inside = std::max(texels * texels - squared, 0);
            disc.texels.insert(disc.texels.end(),
                               {255, 255, 255, static_cast<std::uint8_t>(255 * inside / (texels * texels))});
        }
    return disc;
}

pipeline::Mesh scattered_over(const pipeline::Mesh& pot, std::uint64_t seed, std::uint32_t points,
                              pipeline::ColorSpace space) {
    pipeline::Mesh cloud;
    cloud.name = "splats";
    cloud.primitive = pipeline::Primitive::points;
    SplitMix64 random{seed};
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::size_t first = 3 * static_cast<std::size_t>(random.below(pot.indices.size() / 3));
        float u = random.unit(), v = random.unit();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        const auto mixed = [&](const std::vector<pipeline::Vec3>& of) {
            const auto& a = of[pot.indices[first]];
            const auto& b = of[pot.indices[first + 1]];
            const auto& c = of[pot.indices[first + 2]];
            pipeline::Vec3 mix;
            for (int axis = 0; axis < 3; ++axis)
                mix[axis] = a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]);
            return mix;
        };
        const pipeline::Vec3 n = mixed(pot.normals);
        cloud.positions.push_back(mixed(pot.positions));
        cloud.texcoords.push_back({0.5f, 0.5f});
        cloud.colors.push_back(
            from_encoded({0.5f + 0.5f * n[0], 0.5f + 0.5f * n[1], 0.5f + 0.5f * n[2], point_alpha}, space));
        rasterizer::append_primitive(cloud.indices, {&i, 1});
    }
    return cloud;
}

}  // namespace

Scene make_splats(const SceneOptions& options, std::uint64_t seed, std::uint32_t points) {
    Scene scene;
    scene.name = "splats";
    pipeline::DrawList& list = scene.list;
    list.textures.push_back(soft_disc());
    list.materials.push_back({.name = "splats",
                              .alpha_mode = pipeline::AlphaMode::blend,
                              .texture = 0,
                              .double_sided = true,
                              .unlit = true});
    const Scene teapot = make_teapot(options, cells);
    list.meshes.push_back(scattered_over(teapot.list.meshes[0], seed, points, options.color_space));
    list.instances.push_back({.mesh = 0, .material = 0});
    scene.bounds = bounds_of(list);
    return scene;
}

}  // namespace strata::scenes
