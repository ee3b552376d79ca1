// scenes/procedural/shadow_demo.cpp - builds the draw list of shadow_demo.h.
#include "scenes/procedural/shadow_demo.h"

#include "scenes/bounds.h"
#include "scenes/camera.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/teapot.h"

namespace strata::scenes {
namespace {

// Corners in order round the quad, counterclockwise as seen from the side that the normal points to; two
// triangles share the diagonal from the first to the third.
pipeline::Mesh quad(const char* name, const std::array<pipeline::Vec3, 4>& corners, pipeline::Vec3 normal) {
    pipeline::Mesh mesh;
    mesh.name = name;
    mesh.positions.assign(corners.begin(), corners.end());
    mesh.normals.assign(4, normal);
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// The colour is given encoded and converted to the frame's space. Both sides have the same colour; --no-light makes
// every material unlit.
pipeline::Material material(const char* name, pipeline::Rgba color, pipeline::AlphaMode mode,
                            const SceneOptions& options) {
    const pipeline::Rgba encoded = from_encoded(color, options.color_space);
    return {.name = name,
            .front = encoded,
            .back = encoded,
            .alpha_mode = mode,
            .double_sided = true,
            .unlit = !options.light};
}

}  // namespace

Scene make_shadow_demo(const SceneOptions& options) {
    using pipeline::AlphaMode;
    Scene scene;
    scene.name = "shadow-demo";
    // The teapot's ground is left out: this scene's is larger and opaque. It is a little below y = 0, where the pot's
    // bottom would tie with it.
    scene.list.meshes = {
        std::move(make_teapot(options, 16).list.meshes[0]),
        quad("ground", {{{-4.3f, -0.01f, 4.5f}, {4.7f, -0.01f, 4.5f}, {4.7f, -0.01f, -4.5f}, {-4.3f, -0.01f, -4.5f}}},
             {0, 1, 0}),
        quad("pane", {{{2.2f, 0.0f, 3.4f}, {4.2f, 0.0f, 0.6f}, {4.2f, 2.2f, 0.6f}, {2.2f, 2.2f, 3.4f}}},
             {0.814f, 0, 0.581f})};
    scene.list.materials = {material("teapot", {0.85f, 0.35f, 0.15f, 1}, AlphaMode::opaque, options),
                            material("ground", {0.75f, 0.75f, 0.7f, 1}, AlphaMode::opaque, options),
                            material("pane", {0.2f, 0.5f, 0.9f, 0.4f}, AlphaMode::blend, options)};
    // The ground is drawn first, then the pot, then the pane: opaque surfaces before transparent ones.
    scene.list.instances = {{.mesh = 1, .material = 1}, {.mesh = 0, .material = 0}, {.mesh = 2, .material = 2}};
    // The light's image is square, hence aspect 1. Near and far enclose the scene closely, because the map's depths are
    // spread over that range.
    const pipeline::View light =
        look_at({.eye = {-5.5, 6.5, 3}, .center = {0.2, 0.8, 0}, .fovy_degrees = 75, .near = 2, .far = 18}, 1);
    scene.list.light = pipeline::ShadowLight{.view = light.view,
                                             .projection = light.projection,
                                             .size_px = 1024,
                                             .ambient = 0.4f,
                                             .offset_factor = 1.5f,
                                             .offset_units = 8.0f};
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
