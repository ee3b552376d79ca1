// tools/lab/hardware_check/drawing/fogged.h - draws with fog, and the two ways in which the suites' tests transform
// world points to the window.
//
// Source   pipeline/reference/fog-and-lighting.md 2 and 4, rasterizer/reference/chip-geometry.md 6.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/region/fragment_path.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"

namespace strata::hardware_check {

using pipeline::FogFunction;
using pipeline::FogRegisters;

// A vertex in the window and its fog coordinate.
struct FoggedVertex {
    ClipVertex vertex;
    float coordinate;
};

// Triangles that are drawn with the same registers.
class FoggedSoup {
  public:
    explicit FoggedSoup(const FogRegisters& registers) : registers_{registers} {
        soup_.extras = {.stride = 1, .has_fog = true, .values = {}};
    }
    void add_triangle(const FoggedVertex& a, const FoggedVertex& b, const FoggedVertex& c);
    void add_quad(const std::array<FoggedVertex, 4>& corner);
    // By the register combiners, without blending: every alpha of these tests is 1.
    void draw(pipeline::Surface& surface, const pipeline::Combiners& combiners) const;

  private:
    FogRegisters registers_;
    TriangleSoup soup_;
};

// Final stage: fog factor * colour + (1 - fog factor) * fog, and the colour's alpha.
[[nodiscard]] pipeline::Combiners mix_with_fog();

// "linear", "exp2_abs" and so on.
[[nodiscard]] std::optional<FogFunction> fog_function(std::string_view word);
// The registers that the tests set for planes 1 and 200 and density 0.025.
[[nodiscard]] FogRegisters usual_registers(FogFunction function, const Rgba& color);

// World points in the window: by the fixed pipeline, or by the programs of the tests, which multiply by the view and
// then by the projection, and divide.
class FogCamera {
  public:
    enum class Transform : std::uint8_t { fixed, program };
    explicit FogCamera(Transform transform, float depth_units = 16777215.0f);
    [[nodiscard]] ClipVertex vertex(const HostVector& world, const std::array<float, 4>& color) const;
    // The world point at window x, y and world z.
    [[nodiscard]] HostVector point(float x, float y, float world_z) const {
        return unprojected(camera_, x, y, world_z);
    }
    // In eye space, by the vertex engine.
    [[nodiscard]] HostVector eye(const HostVector& world) const { return chip_product(to_eye_, world); }

  private:
    Transform transform_;
    HostCamera camera_;
    CompositeMatrix whole_, to_eye_, to_window_;
};

}  // namespace strata::hardware_check
