// strata/scene.h - builds the scene to render: from a glTF file, a built-in scene, or triangles in a program's own
// memory; and its camera.
//
// Rule     Triangles are drawn in the order in which they are added. Without a camera, positions of added triangles are
//          in clip space (x, y and z from -1 to 1, w = 1), and a loaded scene has its own view or the default orbit of
//          `strata render`.
// Tests    tests/tools/library/scene_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "pipeline/vertices/draw_list.h"
#include "scenes/camera.h"
#include "scenes/scene.h"

namespace strata {
inline namespace v0_1 {

using pipeline::Primitive;
using pipeline::View;
using scenes::LookAt;
using scenes::SceneOptions;

// A vertex attribute in the caller's memory: `count` vectors of floats, whose first bytes are `stride_bytes` apart (0:
// without gaps). It is read by add() only, and need not be aligned.
struct VertexArray {
    const void* first = nullptr;
    std::size_t count = 0;  // number of vertices
    std::size_t stride_bytes = 0;

    VertexArray() = default;
    VertexArray(const void* data, std::size_t vertices, std::size_t stride = 0)
        : first{data}, count{vertices}, stride_bytes{stride} {}
};

// Triangles, or lines or points.
struct Triangles {
    std::string name{};
    VertexArray positions{};  // x y z
    VertexArray colors{};     // red green blue alpha, not premultiplied; empty: only `color`
    // Three per triangle, two per line, one per point; empty: the vertices in order.
    std::span<const std::uint32_t> indices{};
    // Multiplied with the vertices' colours.
    std::array<float, 4> color{1, 1, 1, 1};
    bool is_transparent = true;  // false: drawn before all transparent triangles, and hides those behind it
    bool is_double_sided = true;
    std::optional<std::array<double, 16>> model{};  // object to world, column by column; empty: the identity
    Primitive primitive = Primitive::triangles;     // or lines or points
};

class Scene {
  public:
    Scene() = default;
    // Without triangles yet; their colours and the frame's will be of that space.
    explicit Scene(pipeline::ColorSpace space) : space_{space} {}
    // The same names as for the command: a .gltf, .glb, .obj, .ply, .stl or .off file, or a built-in scene such as
    // "teapot". Throws InputError.
    explicit Scene(const std::string& spec, const SceneOptions& options = {});

    // Copies the triangles. Throws InputError, which names the field ("triangles 'door': colors.count: expected 3 or
    // none, found 2").
    Scene& add(const Triangles& triangles);

    Scene& look(const View& view);                                   // uses both matrices unchanged
    Scene& look_at(const LookAt& camera);                            // like gluLookAt and gluPerspective
    Scene& orbit(double azimuth_degrees, double elevation_degrees);  // shows the whole scene

    [[nodiscard]] const pipeline::DrawList& list() const noexcept { return scene_.list; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return scene_.warnings; }
    // Of its colours: SceneOptions::color_space.
    [[nodiscard]] pipeline::ColorSpace space() const noexcept { return space_; }
    // The camera for pictures of that size, in the clip convention of the options: clip_depth and depth_order of their
    // raster state. The matrices of look() and the view of a pack are used as they are.
    [[nodiscard]] View view(int width, int height, const rasterizer::RasterState& raster = {}) const;

  private:
    struct Orbit {
        double azimuth = 30, elevation = 20;
    };
    scenes::Scene scene_;
    bool is_loaded_ = false, is_pack_ = false;
    pipeline::ColorSpace space_ = pipeline::ColorSpace::encoded;
    std::optional<View> own_view_;
    std::optional<LookAt> look_at_;
    std::optional<Orbit> orbit_;
};

}  // namespace v0_1
}  // namespace strata
