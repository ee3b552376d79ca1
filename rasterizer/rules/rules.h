// rasterizer/rules/rules.h - how a device turns vertices into fragments, as a value. `DeviceProfile` (pipeline)
// contains one. Every field is a knob that a foreign rasterizer may set differently; the devices' own numbers stand in
// pipeline/device/profile.cpp.
#pragma once
#include <cstdint>

#include "rasterizer/rules/depth_code.h"
#include "rasterizer/rules/depth_hypothesis.h"
#include "rasterizer/rules/interpolation_hypothesis.h"

namespace strata::rasterizer {

// How window x and y become multiples of 1/2^n pixel (coverage.md 4.1).
enum class Snap : std::uint8_t { toward_zero, nearest_even };

// Which sides of a triangle own a centre that lies exactly on them, in y-down memory order (edge.h).
enum class TieRule : std::uint8_t { top_left, bottom_left, top_right, bottom_right };

// Near and far cut the polygon, or they drop the fragments outside n..f (depth.md 5.2).
enum class ZClip : std::uint8_t { per_primitive, per_fragment };
// A triangle with a corner at w <= 0 is cut at w > 0, or dropped whole (coverage.md 2.1).
enum class WClip : std::uint8_t { clip, drop };
// Window positions with a w that is negative, zero or infinite: dropped with what is not finite, or covered by the
// signs of w at the corners (coverage.md 5.8).
enum class WSigns : std::uint8_t { ignored, by_corner };
// x / w, or x * (1 / w), or that with NV20's vertex arithmetic (nv20_arithmetic.h).
enum class WDivide : std::uint8_t { quotient, reciprocal, nv20 };
// Scale, then offset: two roundings, or one of both together; fused_given: one for the vertices that were given, two
// for the corners that clipping made; half_pixel_first: two, and half a pixel is taken off the offset before
// (coverage.md 3.3).
enum class ViewportArithmetic : std::uint8_t { separate, fused, fused_given, half_pixel_first };
// Which way rows are counted where a rule depends on it (roundings of y, ties, planes): as memory has them, or along
// the clip space's y (coverage.md 3.7).
enum class YAxis : std::uint8_t { memory, clip };
// Which pixels are covered: by exact edges of the snapped corners, or by spans stepped in binary32 (float_spans.h).
enum class CoverageRule : std::uint8_t { snapped_edges, float_spans };
// Where polygons are cut: at the guard band in binary64, or at the view volume in binary32; view_volume_depth_first:
// near and far first, and new corners without a share of the way (coverage.md 2.8).
enum class ClipVolume : std::uint8_t { guard_band, view_volume, view_volume_depth_first };
// How the plane of a value is computed: exactly and rounded once, or step by step in binary32 (float_planes.h,
// ordered_planes.h).
enum class PlaneRule : std::uint8_t { exact, reciprocal_area, reciprocal_area_fused, least_corner, greatest_w };
// Through which corners planes of PlaneRule::greatest_w go: those of each piece that clipping left, or those that were
// given (depth.md 3.10).
enum class PlaneCorners : std::uint8_t { clipped, given };
// What a triangle's turn is taken from: the exact area of each piece, or binary32 products of the given corners' window
// positions, where pieces of another turn are lost (coverage.md 6.5).
enum class AreaSign : std::uint8_t { exact, single };
// A perspective attribute: its plane over that of 1 / w, or times the reciprocal of it (attributes.md 1.8).
enum class PerspectiveDivide : std::uint8_t { quotient, reciprocal };
// What a perspective attribute at a sample is divided by: 1 / w there, or at its pixel's centre; of planes of
// reciprocal_area from unsnapped corners alone (attributes.md 1.10).
enum class SampleDivisor : std::uint8_t { sample, centre };
// A colour that is the same at all corners: interpolated like any other, or kept to the bit, as a program's uniform is.
// Exact planes keep it either way (attributes.md 1.9).
enum class EqualColors : std::uint8_t { interpolated, kept };
// Planes of depth and attributes go through the snapped corners, or through the binary32 positions (depth.md 3.7).
enum class PlaneOrigin : std::uint8_t { snapped, unsnapped };
// The units of vertex z: depth 1 is 1, or the depth buffer's greatest value (coverage.md 3.4).
enum class WindowZ : std::uint8_t { unit_interval, buffer_units };
// Vertex colours by the exact perspective plane, or by the chip's 8-bit weights (attributes.md 2.1).
enum class ColorInterpolation : std::uint8_t { exact_plane, weights_8bit };
// Depths outside of the depth range become its ends; or a D32F target keeps them, and fixed-point codes wrap around; or
// they become 0 and 1 where they leave these, whatever the depth range (depth.md 2.9).
enum class DepthLimits : std::uint8_t { clamp, wrap, zero_to_one };
// Unit r of polygon offset: one code of the fixed-point format (D32F: 2^(e - 23) of the primitive), 2^(e - 23) always,
// 1 in the depth buffer's own units, whatever its format, or as format with two codes for one; differences: 2^(e - 23)
// of a depth and of two differences, for D16 1.01 / 65535.
enum class OffsetUnit : std::uint8_t { format, float_exponent, buffer, two_codes, differences };
// Where polygon offset is added: to z of the corners, or by the chip to the value of every fragment (window_z.h).
enum class OffsetRule : std::uint8_t { corners, fragments };

// How a fragment's depth is computed (depth.md 4): depth_paths.h, window_z.h, plane.h.
enum class DepthPath : std::uint8_t {
    window_z,
    perspective_rq,
    depth_replace,
    float32,
    float32_plane,
    exact,
    w_buffer  // w itself: w_buffer.h
};

// The defaults are those of geforce8 (pipeline/reference/devices.md 2); a profile names what differs.
struct RasterRules {
    // n of the 1/2^n pixel: 4, 8 or 12.
    int subpixel_bits = 8;
    Snap snap = Snap::nearest_even;
    CoverageRule coverage = CoverageRule::snapped_edges;
    TieRule tie_rule = TieRule::top_left;  // of snapped edges
    // x and y beyond +- this many pixels are clipped; 1 to 524288, with 12 subpixel bits 32768 (guard_band.h).
    int guard_band_px = 32768;
    ClipVolume clip = ClipVolume::guard_band;
    ZClip z_clip = ZClip::per_primitive;
    WClip w_clip = WClip::clip;
    WSigns w_signs = WSigns::ignored;  // of window positions
    WDivide w_divide = WDivide::quotient;
    ViewportArithmetic viewport = ViewportArithmetic::separate;
    YAxis y_axis = YAxis::memory;
    AreaSign area_sign = AreaSign::exact;  // of snapped edges
    PlaneOrigin plane_origin = PlaneOrigin::snapped;
    PlaneRule plane_rule = PlaneRule::exact;
    PlaneCorners plane_corners = PlaneCorners::clipped;
    PerspectiveDivide perspective = PerspectiveDivide::quotient;
    SampleDivisor sample_divisor = SampleDivisor::sample;
    WindowZ window_z = WindowZ::unit_interval;
    DepthPath depth_path = DepthPath::float32;  // the device's own
    DepthRounding depth_rounding = DepthRounding::nearest;
    DepthLimits depth_limits = DepthLimits::clamp;  // of path float32
    OffsetUnit offset_unit = OffsetUnit::format;
    OffsetRule offset_rule = OffsetRule::corners;  // of paths window_z and w_buffer
    ColorInterpolation color = ColorInterpolation::exact_plane;
    EqualColors equal_colors = EqualColors::interpolated;
    DepthHypothesis hypothesis{};             // what is assumed of the depth paths
    InterpolationHypothesis interpolation{};  // and of colours and texture coordinates
    friend bool operator==(const RasterRules&, const RasterRules&) = default;
};

}  // namespace strata::rasterizer
