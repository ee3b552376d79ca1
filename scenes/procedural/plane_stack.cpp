// scenes/procedural/plane_stack.cpp - the formula of plane_stack.h, plane by plane.
#include "scenes/procedural/plane_stack.h"

#include "rasterizer/base/numerics.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/wave.h"

namespace strata::scenes {
namespace {

// Appends plane i. The grid has cells + i squares per side, so two planes share no edge: where they nearly coincide,
// their depths come from different triangles and round differently, which is the purpose of the scene.
void add_plane(pipeline::Mesh& mesh, const PlaneStack& stack, int i, const pipeline::Rgba& color) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const int cells = stack.cells + i;
    // Distance of this plane from the middle of the stack along z, in units of the scene; `gap` counts steps of
    // 2^-20.
    const double offset = (i - (stack.count - 1) * 0.5) * stack.gap * 0x1p-20;
    for (int row = 0; row <= cells; ++row) {
        const double y = -1 + 2.0 * row / cells;
        for (int column = 0; column <= cells; ++column) {
            const double x = -1 + 2.0 * column / cells;
            const double z = (0.4375 * x + 0.3125 * y) + offset;
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
            mesh.colors.push_back(color);
        }
    }
    // Vertices per row: one more than squares.
    const auto width = static_cast<std::uint32_t>(cells) + 1;
    // Both triangles of a square are counterclockwise seen from +z and share the diagonal from a to d.
    for (std::uint32_t row = 0; row + 1 < width; ++row)
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t a = first + row * width + column, b = a + 1, c = a + width, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
}

}  // namespace

Scene make_plane_stack(const SceneOptions& options, const PlaneStack& stack) {
    Scene scene;
    scene.name = "planes";
    pipeline::Mesh mesh;
    mesh.name = "planes";
    for (int i = 0; i < stack.count; ++i) {
        // The colours go once round the wheel; the last plane differs from the first.
        const double t = static_cast<double>(i) / stack.count;
        add_plane(mesh, stack, i,
                  from_encoded({wave(t, 0), wave(t, 1.0 / 3), wave(t, 2.0 / 3), 1}, options.color_space));
    }
    scene.list.meshes = {std::move(mesh)};
    scene.list.materials.push_back(
        {.name = "planes", .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = true});
    scene.list.instances = {{.mesh = 0, .material = 0}};
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
