// scenes/procedural/volume_beam.cpp - builds the planes and the cone of volume_beam.h.
#include "scenes/procedural/volume_beam.h"

#include <cmath>

#include "rasterizer/base/numerics.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/wave.h"

namespace strata::scenes {
namespace {

// The single rounding of each vertex.
pipeline::Vec3 rounded(double x, double y, double z) noexcept {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// Appends slice i of the stack, in the middle of its share of [-1, 1]; 0 is the farthest from a viewer at +z.
void add_slice(pipeline::Mesh& mesh, int i, int slices, pipeline::ColorSpace space) {
    const double t = (i + 0.5) / slices;
    const double z = -1 + 2 * (i + 0.5) / slices;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 4; ++k) {
        // Quarters from 0.25 to 1, which differ from corner to corner and from slice to slice: the composite
        // then depends on the order of the layers everywhere.
        const float alpha = 0.25f * static_cast<float>(1 + (7 * i + 5 * k) % 4);
        mesh.positions.push_back(rounded((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, z));
        mesh.normals.push_back({0, 0, 1});
        mesh.colors.push_back(from_encoded({wave(t, 0), wave(t, 1.0 / 3), wave(t, 2.0 / 3), alpha}, space));
    }
    for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.indices.push_back(first + corner);
}

pipeline::Mesh planes(int slices, BeamOrder order, pipeline::ColorSpace space) {
    pipeline::Mesh mesh;
    mesh.name = "planes";
    // The order of the mesh is the drawing order; a slice's position and colour depend on i alone, so both orders draw
    // the same slices.
    for (int i = 0; i < slices; ++i) add_slice(mesh, order == BeamOrder::far ? i : slices - 1 - i, slices, space);
    return mesh;
}

// Bands along the axis, and segments around it; 5,000 triangles.
constexpr int rings = 50, segments = 50;

// Ring j of the truncated cone about the y axis: from radius 0.02 at y = 0.9 to radius 0.85 at y = -0.9.
void add_ring(pipeline::Mesh& mesh, int j, const pipeline::Rgba& color) {
    const double s = j / double{rings};
    const double y = 0.9 - 1.8 * s, radius = 0.02 + 0.83 * s;
    // The increase of the radius per unit downwards; the normal is tilted upwards by it.
    constexpr double slope = 0.83 / 1.8;
    const double length = std::sqrt(1 + slope * slope);
    for (int k = 0; k < segments; ++k) {
        const double angle = 2 * pi * k / segments;
        const double c = cos(angle), d = sin(angle);
        mesh.positions.push_back(rounded(radius * c, y, radius * d));
        mesh.normals.push_back(rounded(c / length, slope / length, d / length));
        mesh.colors.push_back(color);
    }
}

pipeline::Mesh cone(pipeline::ColorSpace space) {
    pipeline::Mesh mesh;
    mesh.name = "cone";
    for (int j = 0; j <= rings; ++j) add_ring(mesh, j, from_encoded({0.9f, 0.8f, 0.3f, 1}, space));
    constexpr std::uint32_t row = segments;
    for (std::uint32_t j = 0; j < rings; ++j) {
        for (std::uint32_t k = 0; k < row; ++k) {
            // The last segment ends at the ring's first vertex: no vertices are duplicated.
            const std::uint32_t a = j * row + k, b = j * row + (k + 1) % row;
            const std::uint32_t c = a + row, d = b + row;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    }
    return mesh;
}

}  // namespace

Scene make_volume_beam(const SceneOptions& options, int slices, BeamOrder order) {
    Scene scene;
    scene.name = "volume-beam";
    scene.list.meshes = {planes(slices, order, options.color_space), cone(options.color_space)};
    for (const char* name : {"planes", "cone"}) {
        scene.list.materials.push_back(
            {.name = name, .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = !options.light});
    }
    // Drawn from the near end, the planes are in front-to-back order at every pixel as seen from +z; drawn from the far
    // end they are not.
    scene.list.instances = {{.mesh = 0, .material = 0, .arrives_sorted = order == BeamOrder::near},
                            {.mesh = 1, .material = 1}};
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
