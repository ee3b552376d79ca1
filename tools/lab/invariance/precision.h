// tools/lab/invariance/precision.h - how close two surfaces may be until a depth buffer stores one code for both, by
// their distance from the eye: `strata invariance --precision NEAR:FAR`.
//
// Rule     A surface parallel to the image at distance d is transformed, set up and drawn as by every frame, and its
//          code read at one pixel. The step at d is the least e, to a thousandth, for which the code of d + e is
//          farther than that of d; of sixteen surfaces at d (1 + k / 1024), the largest. No step: none up to the far
//          plane.
// Tests    tests/tools/lab/invariance/precision_test.cpp
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rasterizer/rules/raster_state.h"
#include "rasterizer/rules/rules.h"

namespace strata::tools {

// A depth buffer, what is stored in it, and the convention of the view.
struct DepthChoice {
    std::string name, profile;
    rasterizer::DepthFormat format;
    rasterizer::DepthPath path;
    bool is_reversed = false;  // GREATER, near at 1, clip space from 0 to w
};
[[nodiscard]] std::span<const DepthChoice> depth_choices();

// 0 < near < far, in units of the scene.
struct DepthSpan {
    double near = 0, far = 0;
};

[[nodiscard]] std::optional<double> depth_step(const DepthChoice& choice, const DepthSpan& span, double distance);

// The distances 1, 2 and 5 times a power of ten from near on and before far.
[[nodiscard]] std::vector<double> distances_in(const DepthSpan& span);

// The steps of every choice at a distance.
struct PrecisionRow {
    double distance = 0;
    std::vector<std::optional<double>> steps{};
};
[[nodiscard]] std::vector<PrecisionRow> precision_rows(const DepthSpan& span);
// A row for each distance, a column for each choice; as CSV with a title, or for people.
[[nodiscard]] std::string precision_csv(const std::vector<PrecisionRow>& rows);
[[nodiscard]] std::string precision_table(const std::vector<PrecisionRow>& rows);

}  // namespace strata::tools
