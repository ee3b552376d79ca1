// tools/bench/mesa/gpu_scene.h - Strata's own clip-space vertices in OpenGL buffers: the vertex shader passes them on.
#pragma once
#include <string>
#include <vector>

#include "rasterizer/set_up/geometry.h"
#include "tools/bench/mesa/objects.h"

namespace strata::mesa {

class GpuScene {
  public:
    explicit GpuScene(const rasterizer::TriangleSoup& soup);

    // All triangles in submission order, in one call a run of equal facing state. The caller has bound everything else.
    void draw() const;

    // A program whose fragment text may call `vec4 shade()`: the interpolated straight colour of the fragment's side.
    [[nodiscard]] Handle make_program(const std::string& fragment) const;

  private:
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
