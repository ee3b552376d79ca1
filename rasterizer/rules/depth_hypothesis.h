// rasterizer/rules/depth_hypothesis.h - parameters of the depth computation whose hardware value is not certain. The
// chip is NV2A.
//
// Rule     Defaults are measured on hardware ([M]) or assumed ([A]). RasterRules contains one DepthHypothesis, on which
//          everything computed from depths depends; depth_hypotheses (hypotheses.h) lists the alternatives.
// Source   rasterizer/reference/depth.md 8; chip-depth.md 1, 3 and 4.
// Tests    tests/rasterizer/values/depth_paths_test.cpp
#pragma once
#include <cstdint>

namespace strata::rasterizer {

// n / d of perspective_rq and depth_replace. [A] the default is the quotient, rounded once: depth.md 8.2; on DotZW a
// truncated reciprocal fits slightly better (chip-depth.md 6.3).
enum class DivideRule : std::uint8_t {
    exact,           // rounded once
    cut_reciprocal,  // n * (1 / d truncated toward zero), the product rounded
    low_reciprocal   // n * (1 / d rounded, then one unit in the last place toward zero), the product rounded
};

// How DepthPath::window_z is computed: by the chip's rule [M] (chip-depth.md 1.1: 4,927,976 of 4,927,976 codes equal),
// from the exact plane, or from that plane rounded once to binary32; all in buffer units.
enum class WindowZRule : std::uint8_t { chip, exact, float32 };

// The chip's weights. area: edge values times a reciprocal of the exact area. cut_edges [M]: edge values truncated to
// 24 bits times a reciprocal of their sum, which differs from pixel to pixel (chip-float-depth.md 1: 4 codes of
// 1,083,110 wrong, with `area` 3,228).
enum class WeightRule : std::uint8_t { area, cut_edges };

// The pixel pair between which a triangle's slope of w is measured along the steeper axis: the two pixels in the middle
// of the first 2x2 quad drawn, or of the last quad in the same 4x4 block [A] (chip-float-depth.md 4.5: captures show
// both).
enum class WSlope : std::uint8_t { first_quad, last_quad };

// The origin of DepthPath::float32_plane: the triangle's first vertex, or pixel corner (0, 0) of the surface [A].
enum class PlaneAnchor : std::uint8_t { first_vertex, window_corner };

inline constexpr int full_double = 53;

struct DepthHypothesis {
    // Significant bits of r/w, q/w and 1/w at a fragment: 16 to 24, or full_double (divisions are then in binary64
    // too). [A] 24: depth.md 8.
    int interpolant_bits = 24;
    DivideRule divide = DivideRule::exact;
    WindowZRule window_z = WindowZRule::chip;
    WeightRule weights = WeightRule::cut_edges;
    // Three parameters of the chip's rule. reciprocal_bits: significant bits of the reciprocal, 24 to 30 ([M] 29, or 28
    // with `area`: chip-depth.md 4). reciprocal_deficit: with cut_edges the reciprocal is scaled by 1 - deficit * 2^-32
    // before truncation, 0 to 8 ([M] between 1.82 and 2.86: chip-float-depth.md 1.1). sum_bits: width of the aligned
    // sum, 24 to 29 ([M] 29: the last 5 are guard bits).
    int reciprocal_bits = 29, reciprocal_deficit = 2, sum_bits = 29;
    // true: the compared depth is converted to a code like a depth write [M] (chip-depth.md 7.2). false: it is compared
    // unquantized, so a fragment may pass the test against its own stored depth (depth.md 6.2).
    bool quantize_reference = true;
    WSlope w_slope = WSlope::first_quad;
    PlaneAnchor plane_anchor = PlaneAnchor::first_vertex;
    friend bool operator==(const DepthHypothesis&, const DepthHypothesis&) = default;
};

}  // namespace strata::rasterizer
