// tools/bench/mesa/gpu_scene.h - Strata's own clip-space vertices in OpenGL buffers: the vertex shader passes them on.
#pragma once
#include <string>
#include <vector>

#include "rasterizer/set_up/geometry.h"
#include "tools/bench/mesa/objects.h"

namespace strata::mesa {

// The scene in buffers of the context. It binds its vertex array when it is made and relies on it
// in draw(): one GpuScene lives at a time.
class GpuScene {
  public:
    // Uploads the soup, which may end afterwards. Vertices must be transformed and not yet clipped.
    explicit GpuScene(const rasterizer::TriangleSoup& soup);

    // Draws all triangles in submission order, in one call for each run of equal facing state. Sets
    // culling and front face; program, framebuffer, textures and blending are the caller's.
    void draw() const;

    // A program whose fragment text may call `vec4 shade()`: the interpolated straight colour of the fragment's side.
    [[nodiscard]] Handle make_program(const std::string& fragment) const;

  private:
    // Neighbouring triangles with the same facing state: `count` indices from byte `first_byte` of
    // the index buffer.
    struct Run {
        GLsizei count = 0;
        std::uintptr_t first_byte = 0;
        bool double_sided = true, mirrored = false;
    };
    void add_runs(const rasterizer::TriangleSoup& soup);

    bool two_sided_;  // some vertex has a colour of its own for the back
    std::vector<Run> runs_;
    Handle vertices_, indices_, layout_;
};

}  // namespace strata::mesa
