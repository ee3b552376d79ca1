// rasterizer/setup.h - one source triangle becomes set-up triangles, or is dropped and counted.
//
// Rule     In this order: a vertex that is not finite drops the triangle, and so does a window position, 1 / w or u / w
//          that is not (non_finite); clipping (clipped, outside); per piece: zero area after snapping (degenerate),
//          facing by the sign of the snapped area (culled), no pixel centre of the viewport in its bounding box
//          (outside, if all its pieces go that way).
// Source   hardware.md 1 and 13; D3D 11.3 15.11 (facing after snapping).
// Tests    tests/rasterizer/setup_test.cpp
#pragma once
#include <array>
#include <vector>

#include "rasterizer/clip.h"
#include "rasterizer/geometry.h"
#include "rasterizer/window.h"

namespace strata::rasterizer {

struct SourceTriangle {
    std::array<const ClipVertex*, 3> corner;
    std::uint32_t number = 0;     // in the soup's listing
    std::uint32_t primitive = 0;  // in submission order
    const TriangleRun* run = nullptr;
};

class TriangleSetup {
  public:
    TriangleSetup(const RasterState& state, const RasterRules& rules);

    // Appends what is left of `triangle` to `out` and counts what is not.
    void add(const SourceTriangle& triangle, std::vector<SetupTriangle>& out, SetupCounters& counters) const;

  private:
    enum class Fate : std::uint8_t { kept, culled, outside, degenerate, non_finite };

    [[nodiscard]] Fate add_piece(const std::array<const ClipVertex*, 3>& corner, const SourceTriangle& triangle,
                                 std::vector<SetupTriangle>& out) const;
    [[nodiscard]] Fate add_clipped(const SourceTriangle& triangle, std::uint32_t planes,
                                   std::vector<SetupTriangle>& out) const;
    [[nodiscard]] bool is_front(std::int64_t area, bool mirrored) const noexcept;
    [[nodiscard]] bool is_culled(bool front) const noexcept;

    RasterState state_;
    RasterRules rules_;
    Clipper clipper_;
    WindowTransform window_;
};

}  // namespace strata::rasterizer
