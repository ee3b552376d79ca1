// rasterizer/rules/depth_hypothesis.h - what is not known for certain about the depth paths, as values to vary.
//
// Rule     A default is what captures of silicon prove where they do ([M]), else our assumption ([A]). Everything that
//          is computed from depths rests on one hypothesis, which is part of RasterRules; depth_hypotheses
//          (hypotheses.h) names the others.
// Source   depth.md 8; chip-depth.md 1, 3 and 4.
// Tests    tests/rasterizer/values/depth_paths_test.cpp
#pragma once
#include <cstdint>

namespace strata::rasterizer {

// n / d of perspective_rq and depth_replace. [A] the quotient, rounded once: depth.md 8.2; on DotZW a cut reciprocal
// fits slightly better (chip-depth.md 6.3).
enum class DivideRule : std::uint8_t {
    exact,           // rounded once
    cut_reciprocal,  // n * (1 / d cut toward zero), the product rounded
    low_reciprocal   // n * (1 / d rounded, then one unit in the last place toward zero), the product rounded
};

// How DepthPath::window_z becomes a code: by the chip's rule [M] (chip-depth.md 1.1: 4,927,976 of 4,927,976 words),
// from the exact plane, or from that plane rounded once to binary32; all in buffer units.
enum class WindowZRule : std::uint8_t { chip, exact, float32 };

// The chip's weights: edge values times a reciprocal of the exact area, or edge values cut to 24 bits times a
// reciprocal of their sum, which differs from pixel to pixel [M] (chip-float-depth.md 1: 4 words of 1,083,110 wrong, by
// `area` 3,228).
enum class WeightRule : std::uint8_t { area, cut_edges };

// Between which pixels a triangle's slope of w is taken: the middle of the first 2x2 quad that it draws along the
// steeper axis, or the last in the same 4x4 block [A] (chip-float-depth.md 4.5: either occurs).
enum class WSlope : std::uint8_t { first_quad, last_quad };

// Where DepthPath::float32_plane starts: at the triangle's first vertex, or at pixel corner (0, 0) of the surface [A].
enum class PlaneAnchor : std::uint8_t { first_vertex, window_corner };

inline constexpr int full_double = 53;

struct DepthHypothesis {
    // Significant bits of r/w, q/w and 1/w at a fragment: 16 to 24, or full_double (then the divides are binary64
    // too). [A] 24: depth.md 8.
    int interpolant_bits = 24;
    DivideRule divide = DivideRule::exact;
    WindowZRule window_z = WindowZRule::chip;
    WeightRule weights = WeightRule::cut_edges;
    // Of the chip's rule: significant bits of the reciprocal, 24 to 30 ([M] 29, or 28 of `area`: chip-depth.md 4), by
    // how many units of 2^-32 that of cut_edges is low before its cut, 0 to 8 ([M] between 1.82 and 2.86:
    // chip-float-depth.md 1.1), and the width of the aligned add, 24 to 29 ([M] 29: the last 5 are guard bits).
    int reciprocal_bits = 29, reciprocal_deficit = 2, sum_bits = 29;
    // The compared depth becomes a code by the rule of a depth write [M] (chip-depth.md 7.2); false: it is compared
    // as it is, and finds itself again (depth.md 6.2).
    bool quantize_reference = true;
    WSlope w_slope = WSlope::first_quad;
    PlaneAnchor plane_anchor = PlaneAnchor::first_vertex;
    friend bool operator==(const DepthHypothesis&, const DepthHypothesis&) = default;
};

}  // namespace strata::rasterizer
