// tools/lab/hard_cases/hard_exact.h - the exact answer of a hard case from a given view, and the pixels where it is
// sensitive to small errors.
//
// Rule     Corners are transformed in binary64 and not snapped; coverage is the exact sign of the edge functions
//          (real_triangle.h); a fragment is visible from near to far, both inclusive, and in front of the nearest
//          opaque one. A pixel is open to a slack if, with errors of every corner and depth up to the slack, a triangle
//          may gain or lose the pixel's centre, or two depths, or a depth and the end of the range, may change their
//          order.
// Numbers  An edge function is bilinear in its two corners, so the bound on its change is rigorous. A depth's change is
//          bounded to first order, times 5/4. The error of binary64 itself is below 2^-48 of depth and 2^-40 pixel,
//          which every slack includes. A triangle has the colour of its first corner: in these cases all corners of a
//          triangle have the same colour.
// Tests    tests/tools/lab/hard_cases/hard_exact_test.cpp: rational arithmetic
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "peeling/truth/real_triangle.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/moves/hard_result.h"

namespace strata::tools {

// Bounds on the errors of an image.
struct Slack {
    double relative = 0;  // of each input coordinate of a corner, relative
    double pixels = 0;    // of a corner in the window, per axis
    double depth = 0;     // of a fragment, in the depth range 0 to 1
};

class ExactCase {
  public:
    // Every corner must be in front of the eye.
    ExactCase(const scenes::HardCase& hard, const scenes::Scene& scene, const pipeline::View& view);

    // Per pixel, row by row: the visible fragments, and their colour blended over the opaque surface in binary64.
    [[nodiscard]] ResultPixels visible_pixels() const;
    [[nodiscard]] std::vector<bool> open_pixels(const Slack& slack) const;
    // The depth of a triangle's plane at a pixel's centre, whether or not the triangle covers it.
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
