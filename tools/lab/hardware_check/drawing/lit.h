// tools/lab/hardware_check/drawing/lit.h - draws with vertices that the lighting unit has lit.
//
// Source   pipeline/reference/fog-and-lighting.md 5 and 6.
#pragma once
#include <bit>
#include <span>

#include "pipeline/lighting/lighting_unit.h"
#include "pipeline/region/fragment_path.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/host_matrices.h"

namespace strata::hardware_check {

using pipeline::LightingRegisters;

// A world point and what else a vertex has.
struct WorldVertex {
    HostVector point;
    pipeline::Three normal{};
    std::array<float, 4> diffuse{1, 1, 1, 1}, specular{};
};

// The default camera with the fixed pipeline: lights vertices and projects them.
class LitCamera {
  public:
    LitCamera();
    [[nodiscard]] HostVector point(float x, float y, float world_z) const {
        return unprojected(camera_, x, y, world_z);
    }
    // The triangles of world vertices, three each.
    [[nodiscard]] TriangleSoup lit(const LightingRegisters& registers, std::span<const WorldVertex> vertices) const;

  private:
    HostCamera camera_;
    CompositeMatrix whole_, to_eye_;
};

// The same for vertices whose points are in the window, and in eye space.
[[nodiscard]] TriangleSoup lit_in_window(const LightingRegisters& registers, std::span<const WorldVertex> vertices);

// The specular parameters of power 125.
inline constexpr std::array<float, 6> power_125{std::bit_cast<float>(0xbf78df9cu), std::bit_cast<float>(0xc04d3531u),
                                                std::bit_cast<float>(0x404efd4au), std::bit_cast<float>(0xbf71f52eu),
                                                std::bit_cast<float>(0xc048fa21u), std::bit_cast<float>(0x404c7cd6u)};

// An infinite light as the tests set it: its direction and half vector, for a view along +z.
[[nodiscard]] pipeline::LightRegisters infinite_light(const pipeline::Three& direction);

// Spare 0 = primary (if wanted) + secondary colour (if wanted), alphas likewise or 1; the final stage shows it.
enum class Shown : std::uint8_t { primary, secondary, both };
enum class ShownAlpha : std::uint8_t { own, one };
[[nodiscard]] pipeline::Combiners show_lit(Shown shown, ShownAlpha alpha = ShownAlpha::own);

// A surface of the profile in one colour.
[[nodiscard]] pipeline::Surface cleared_to(const pipeline::DeviceProfile& profile, Argb color);
// Draws with these combiners, blended OVER.
void draw_lit(pipeline::Surface& surface, const pipeline::Combiners& combiners, const TriangleSoup& soup);

}  // namespace strata::hardware_check
