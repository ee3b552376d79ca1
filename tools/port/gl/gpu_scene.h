// tools/port/gl/gpu_scene.h - the scene in OpenGL buffers; the vertex shader passes clip-space positions and colours
// through.
#pragma once
#include "tools/port/gl/mesh.h"
#include "tools/port/port_settings.h"

namespace strata::port {

enum class Surfaces : std::uint8_t { opaque, transparent };

// The scene in buffers of the context. The constructor binds its vertex array and draw() relies on it: only one
// GpuScene may exist at a time.
class GpuScene {
  public:
    // Uploads the mesh, which is not needed afterwards.
    GpuScene(const IndexedMesh& mesh, FrameSize size, const PortSettings& settings);

    // Draws the selected primitives in order, in one call per run of equal facing state. Sets culling and front face;
    // the caller sets program, framebuffer, textures and blending.
    void draw(Surfaces surfaces = Surfaces::transparent) const;
    [[nodiscard]] bool has(Surfaces surfaces) const { return !runs_[static_cast<std::size_t>(surfaces)].empty(); }

    // A program whose fragment text may call `vec4 shade()`, the interpolated colour of the fragment's side, not
    // premultiplied, and use TEXEL, its own texel.
    [[nodiscard]] Handle make_program(const std::string& fragment, const std::vector<std::string>& samplers = {}) const;

  private:
    // Consecutive primitives with the same facing state: `count` indices from byte `first_byte` of the index buffer.
    struct Run {
        DrawKind kind = DrawKind::triangles;
        GLsizei count = 0;
        std::uintptr_t first_byte = 0;
        bool double_sided = true, mirrored = false;
    };
    void add_runs(const IndexedMesh& mesh);

    PortSettings settings_;
    FrameSize size_;
    float line_width_, point_size_;
    bool two_sided_;  // some vertex has a separate colour for the back
    std::array<std::vector<Run>, 2> runs_;
    Handle vertices_, indices_, layout_;
};

}  // namespace strata::port
