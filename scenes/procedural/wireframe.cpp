// scenes/procedural/wireframe.cpp - finds the sides of the teapot's cells (wireframe.h).
#include "scenes/procedural/wireframe.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/teapot.h"

namespace strata::scenes {
namespace {

using PositionKey = std::array<float, 3>;

constexpr float outwards = 1.0f / 64;
constexpr float glass_alpha = 0.25f;
constexpr Rgba wire_color{0.05f, 0.1f, 0.25f, 0.75f};

PositionKey key_of(const pipeline::Vec3& p) { return {p[0], p[1], p[2]}; }

// The vertices of a patch are in rows, so that the ends of a diagonal are a row and one vertex apart.
pipeline::Mesh wires_around(const pipeline::Mesh& pot, int tessellation) {
    const auto diagonal = static_cast<std::uint32_t>(tessellation) + 2;
    pipeline::Mesh wires;
    wires.name = "wires";
    wires.primitive = pipeline::Primitive::lines;
    for (std::size_t v = 0; v < pot.positions.size(); ++v) {
        pipeline::Vec3 p = pot.positions[v];
        for (int axis = 0; axis < 3; ++axis) p[axis] += outwards * pot.normals[v][axis];
        wires.positions.push_back(p);
    }
    std::set<std::pair<PositionKey, PositionKey>> known;
    for (std::size_t i = 0; i < pot.indices.size(); ++i) {
        const std::uint32_t a = pot.indices[i], b = pot.indices[i % 3 == 2 ? i - 2 : i + 1];
        if ((a < b ? b - a : a - b) == diagonal) continue;
        const auto ends = std::minmax({key_of(pot.positions[a]), key_of(pot.positions[b])});
        if (known.insert({ends.first, ends.second}).second)
            rasterizer::append_primitive(wires.indices, std::array{a, b});
    }
    return wires;
}

}  // namespace

Scene make_wireframe(const SceneOptions& options, int tessellation) {
    Scene scene = make_teapot(options, tessellation);
    scene.name = "wireframe";
    pipeline::DrawList& list = scene.list;
    list.materials[0].front[3] = list.materials[0].back[3] = glass_alpha;
    const Rgba color = from_encoded(wire_color, options.color_space);
    list.materials.push_back({.name = "wires",
                              .front = color,
                              .back = color,
                              .alpha_mode = pipeline::AlphaMode::blend,
                              .double_sided = true,
                              .unlit = true});
    list.meshes.push_back(wires_around(list.meshes[0], tessellation));
    list.instances.push_back({.mesh = 2, .material = 2});
    scene.bounds = bounds_of(list);
    return scene;
}

}  // namespace strata::scenes
