// strata/scene.h - what is drawn: a glTF file, a built-in scene, or triangles from a program's own memory; and the
// camera.
//
// Rule     Triangles are drawn in the order in which they are added. Without a camera, positions of added triangles are
//          clip space (x, y and z from -1 to 1, w = 1), and a loaded scene is seen by its own view or by the orbit of
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

using pipeline::View;
using scenes::LookAt;
using scenes::SceneOptions;

// An attribute of the vertices in the caller's memory: `count` times so many floats, whose beginnings lie
// `stride_bytes` apart (0: one behind the other). It is read while add() runs, and may begin at any byte.
struct VertexArray {
    const void* first = nullptr;
    std::size_t count = 0;  // vertices
    std::size_t stride_bytes = 0;

    VertexArray() = default;
    VertexArray(const void* data, std::size_t vertices, std::size_t stride = 0)
        : first{data}, count{vertices}, stride_bytes{stride} {}
};

struct Triangles {
    std::string name{};
    VertexArray positions{};  // x y z
    VertexArray colors{};     // red green blue alpha, straight; none: `color` alone
    std::span<const std::uint32_t>
        indices{};  // three a triangle; none: three vertices a triangle, one behind the other
    // Times the vertices' colours.
    std::array<float, 4> color{1, 1, 1, 1};
    bool is_transparent = true;  // false: drawn before all transparent triangles, and hides what lies behind
    bool is_double_sided = true;
    std::optional<std::array<double, 16>> model{};  // object to world, by columns; none: the identity
};

class Scene {
  public:
    Scene() = default;
    // As the command takes it: a .gltf, .glb, .obj, .ply, .stl or .off file, or a built-in scene such as "teapot".
    // InputError.
    explicit Scene(const std::string& spec, const SceneOptions& options = {});

    // Copies them. InputError names the field ("triangles 'door': colors.count: expected 3 or none, found 2").
    Scene& add(const Triangles& triangles);

    Scene& look(const View& view);                                   // both matrices as they are
    Scene& look_at(const LookAt& camera);                            // as gluLookAt and gluPerspective
    Scene& orbit(double azimuth_degrees, double elevation_degrees);  // the whole scene

    [[nodiscard]] const pipeline::DrawList& list() const noexcept { return scene_.list; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return scene_.warnings; }
    // The camera for pictures of that size.
    [[nodiscard]] View view(int width, int height) const;

  private:
    struct Orbit {
        double azimuth = 30, elevation = 20;
    };
    scenes::Scene scene_;
    bool is_loaded_ = false;
    std::optional<View> own_view_;
    std::optional<LookAt> look_at_;
    std::optional<Orbit> orbit_;
};

}  // namespace v0_1
}  // namespace strata
