// tools/lab/hard_cases/hard_exact.h - the exact answer of a hard case that is looked at from some view, and where it
// hangs by a thread.
//
// Rule     Corners go through the view in binary64 and are not snapped; coverage is the exact sign of the edge
//          functions (real_triangle.h); a fragment is visible from near to far, both included, and before the nearest
//          opaque one. A pixel is open to a slack if, with every corner and depth as far off as the slack allows, a
//          triangle may gain or lose the pixel's centre, or two depths, or a depth and the end of the range, may change
//          their order.
// Numbers  An edge function is bilinear in its two corners, so its change is bounded by them rigorously. A depth's
//          change is bounded to first order, times 5/4. Binary64 itself is off by less than 2^-48 of depth and 2^-40
//          pixel, which every slack includes. Colours are those of a triangle's first corner: all corners of these
//          cases have one.
// Tests    tests/tools/hard_cases/hard_exact_test.cpp: rational arithmetic
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "peeling/truth/real_triangle.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/hard_seen.h"

namespace strata::tools {

// How far the numbers of a picture may be from what they are.
struct Slack {
    double relative = 0;  // of each coordinate of a corner, as it is given
    double pixels = 0;    // of a corner in the window, along each axis
    double depth = 0;     // of a fragment, of the depth range 0 to 1
};

class ExactCase {
  public:
    // Every corner must lie in front of the eye.
    ExactCase(const scenes::HardCase& hard, const scenes::Scene& scene, const pipeline::View& view);

    // Of each pixel, row by row: the visible fragments, and all of them blended over the opaque surface in binary64.
    [[nodiscard]] Seen seen() const;
    [[nodiscard]] std::vector<bool> open_pixels(const Slack& slack) const;
    // The depth of a triangle's plane at a pixel's centre, whether or not it covers it.
    [[nodiscard]] double depth_at(std::uint32_t primitive, std::size_t pixel) const;

  private:
    using Point = std::array<double, 3>;  // window x, y and depth
    struct Surface {
        std::array<Vec3, 3> given;
        peeling::RealTriangle triangle;
        Rgba color;
    };
    struct Reach;

    [[nodiscard]] Point project(const Vec3d& position) const;
    void add(const pipeline::Mesh& mesh, std::vector<Surface>& surfaces) const;
    [[nodiscard]] Reach reach_of(const Surface& surface, const Slack& slack) const;
    void mark_open(const Surface& surface, const Slack& slack, std::vector<std::vector<std::array<double, 2>>>& depths,
                   std::vector<bool>& open) const;

    const scenes::HardCase& hard_;
    Matrix matrix_;
    std::vector<Surface> transparent_, opaque_;
};

}  // namespace strata::tools
