// rasterizer/rules/rules.h - how a device turns vertices into fragments, as a value. `DeviceProfile` (pipeline)
// contains one. Every field is a choice that another rasterizer may make differently; the devices' values are in
// pipeline/device/profile.cpp.
#pragma once
#include <cstdint>

#include "rasterizer/rules/depth_code.h"
#include "rasterizer/rules/depth_hypothesis.h"
#include "rasterizer/rules/interpolation_hypothesis.h"
#include "rasterizer/rules/primitive.h"

namespace strata::rasterizer {

// Rounding of window x and y to multiples of 1/2^n pixel (rasterizer/reference/coverage.md 4.1).
enum class Snap : std::uint8_t { toward_zero, nearest_even };

// The sides of a triangle that own a centre exactly on them, in y-down memory order (edge.h).
enum class TieRule : std::uint8_t { top_left, bottom_left, top_right, bottom_right };

// Near and far either clip the polygon or drop the fragments outside n..f (depth.md 5.2).
enum class ZClip : std::uint8_t { per_primitive, per_fragment };
// A triangle with a corner at w <= 0 is clipped to w > 0, or dropped completely (coverage.md 2.1).
enum class WClip : std::uint8_t { clip, drop };
// Triangles with window positions and a w that is negative, zero or infinite: dropped like those with values that are
// not finite, or covered according to the signs of w at the corners (coverage.md 5.8).
enum class WSigns : std::uint8_t { ignored, by_corner };
// x / w; x * (1 / w); or the latter with NV20's vertex arithmetic (nv20_arithmetic.h).
enum class WDivide : std::uint8_t { quotient, reciprocal, nv20 };
// Scale, then offset. separate: two roundings. fused: one rounding of both. fused_given: one for the given vertices,
// two for the corners that clipping creates. half_pixel_first: two, with half a pixel subtracted from the offset
// beforehand (coverage.md 3.3).
enum class ViewportArithmetic : std::uint8_t { separate, fused, fused_given, half_pixel_first };
// The direction in which rows are counted where a rule depends on it (rounding of y, ties, planes): in memory order, or
// along clip-space y (coverage.md 3.7).
enum class YAxis : std::uint8_t { memory, clip };
// Coverage by exact edges of the snapped corners, or by spans stepped in binary32 (float_spans.h).
enum class CoverageRule : std::uint8_t { snapped_edges, float_spans };
// Where polygons are clipped: at the guard band in binary64, or at the view volume in binary32.
// view_volume_depth_first: near and far first, and new corners computed without an interpolation parameter (coverage.md
// 2.8).
enum class ClipVolume : std::uint8_t { guard_band, view_volume, view_volume_depth_first };
// How the plane of a value is evaluated: exactly and rounded once, or step by step in binary32 (float_planes.h,
// ordered_planes.h).
enum class PlaneRule : std::uint8_t { exact, reciprocal_area, reciprocal_area_fused, least_corner, greatest_w };
// The corners that define planes of PlaneRule::greatest_w: those of each piece after clipping, or those of the given
// triangle (depth.md 3.10).
enum class PlaneCorners : std::uint8_t { clipped, given };
// The source of a triangle's winding: the exact area of each piece, or binary32 products of the given corners' window
// positions, in which case pieces with a different winding are lost (coverage.md 6.5).
enum class AreaSign : std::uint8_t { exact, single };
// A perspective attribute is its plane divided by that of 1 / w, or multiplied by the reciprocal of that (attributes.md
// 1.8).
enum class PerspectiveDivide : std::uint8_t { quotient, reciprocal };
// The divisor of a perspective attribute at a sample: 1 / w there, or at its pixel's centre. Only for reciprocal_area
// planes from unsnapped corners (attributes.md 1.10).
enum class SampleDivisor : std::uint8_t { sample, centre };
// A colour that is equal at all corners: interpolated like any other, or kept bit for bit, like a program's uniform.
// Exact planes keep it either way (attributes.md 1.9).
enum class EqualColors : std::uint8_t { interpolated, kept };
// Planes of depth and attributes pass through the snapped corners, or through the binary32 positions (depth.md 3.7).
enum class PlaneOrigin : std::uint8_t { snapped, unsnapped };
// The units of vertex z: depth 1 is 1, or the depth buffer's greatest value (coverage.md 3.4).
enum class WindowZ : std::uint8_t { unit_interval, buffer_units };
// Vertex colours by the exact perspective plane, or by NV2A's 8-bit weights (attributes.md 2.1).
enum class ColorInterpolation : std::uint8_t { exact_plane, weights_8bit };
// Depths outside the depth range. clamp: they become its ends. wrap: a D32F target keeps them, and fixed-point codes
// wrap around. zero_to_one: they are clamped to 0 and 1, whatever the depth range (depth.md 2.9).
enum class DepthLimits : std::uint8_t { clamp, wrap, zero_to_one };
// Unit r of polygon offset. format: one code of the fixed-point format (D32F: 2^(e - 23) of the primitive).
// float_exponent: 2^(e - 23) always. buffer: 1 in the depth buffer's own units, whatever its format. two_codes: like
// format with two codes instead of one. differences: 2^(e - 23) of a depth and of two differences, for D16 1.01 /
// 65535.
enum class OffsetUnit : std::uint8_t { format, float_exponent, buffer, two_codes, differences };
// Polygon offset is added to z of the corners, or by NV2A to the value of every fragment (window_z.h).
enum class OffsetRule : std::uint8_t { corners, fragments };

// Which pixels a line covers. none: lines are refused. band: NV2A's, by the style of the state. diamond_exit: OpenGL's
// and Direct3D's line of one pixel per step of its longer direction, and OpenGL's wide lines. shifted_ends: llvmpipe's
// parallelogram. pixel_steps: softpipe's steps between the pixels of the ends, and two triangles for wide lines
// (lines-and-points.md 2 to 4).
enum class LineRule : std::uint8_t { none, band, diamond_exit, shifted_ends, pixel_steps };
// Which pixels a point covers. none: points are refused. square: the centres within half its size, left and upper side
// included. reciprocal: the same by NV2A's reciprocal, which includes the right and lower side unless the size is a
// power of two. subpixel_square: llvmpipe's, whose size is rounded to subpixels and at least a pixel; left and lower
// side included. two_triangles: softpipe's, moved by an eighth of a pixel to the right and upwards (lines-and-points.md
// 5).
enum class PointRule : std::uint8_t { none, square, reciprocal, subpixel_square, two_triangles };

// How a fragment's depth is computed (depth.md 4): depth_paths.h, window_z.h, plane.h.
enum class DepthPath : std::uint8_t {
    window_z,
    perspective_rq,
    depth_replace,
    float32,
    float32_plane,
    exact,
    w_buffer,     // w itself: w_buffer.h
    logarithmic,  // written by a program, like the next: program_depth.h
    packed_rgba8
};

// True for depths that a program writes, not the rasterizer.
[[nodiscard]] constexpr bool is_written_by_program(DepthPath path) noexcept {
    return path == DepthPath::logarithmic || path == DepthPath::packed_rgba8;
}

// The defaults are those of geforce8 (pipeline/reference/devices.md 2); a profile lists the differences.
struct RasterRules {
    // n of the subpixel grid of 1/2^n pixel: 0 to 12. A Geometry's coordinates have 4, 8 or 12 bits, of which the last
    // `unused_bits` are 0 in positions (with_coordinates).
    int subpixel_bits = 8, unused_bits = 0;
    Snap snap = Snap::nearest_even;
    CoverageRule coverage = CoverageRule::snapped_edges;
    TieRule tie_rule = TieRule::top_left;  // for snapped edges
    // Positions beyond +- this many pixels in x or y are clipped; 1 to 524288, with 12 subpixel bits at most 32768
    // (guard_band.h).
    int guard_band_px = 32768;
    ClipVolume clip = ClipVolume::guard_band;
    ZClip z_clip = ZClip::per_primitive;
    WClip w_clip = WClip::clip;
    WSigns w_signs = WSigns::ignored;  // for window positions
    WDivide w_divide = WDivide::quotient;
    ViewportArithmetic viewport = ViewportArithmetic::separate;
    YAxis y_axis = YAxis::memory;
    AreaSign area_sign = AreaSign::exact;  // for snapped edges
    PlaneOrigin plane_origin = PlaneOrigin::snapped;
    PlaneRule plane_rule = PlaneRule::exact;
    PlaneCorners plane_corners = PlaneCorners::clipped;
    PerspectiveDivide perspective = PerspectiveDivide::quotient;
    SampleDivisor sample_divisor = SampleDivisor::sample;
    WindowZ window_z = WindowZ::unit_interval;
    DepthPath depth_path = DepthPath::float32;  // the path of the device's fixed function
    DepthRounding depth_rounding = DepthRounding::nearest;
    DepthLimits depth_limits = DepthLimits::clamp;  // for path float32
    OffsetUnit offset_unit = OffsetUnit::format;
    OffsetRule offset_rule = OffsetRule::corners;  // for paths window_z and w_buffer
    ColorInterpolation color = ColorInterpolation::exact_plane;
    EqualColors equal_colors = EqualColors::interpolated;
    LineRule lines = LineRule::none;
    PointRule points = PointRule::none;
    DepthHypothesis hypothesis{};             // assumptions about the depth paths
    InterpolationHypothesis interpolation{};  // and about colours and texture coordinates
    friend bool operator==(const RasterRules&, const RasterRules&) = default;
};

// Planes of a line or point are known for exact planes of snapped corners and for llvmpipe's (float_planes.h).
[[nodiscard]] constexpr bool has_shape_planes(const RasterRules& r) noexcept {
    if (r.plane_rule == PlaneRule::exact) return r.plane_origin == PlaneOrigin::snapped;
    const bool is_stepped =
        r.plane_rule == PlaneRule::reciprocal_area || r.plane_rule == PlaneRule::reciprocal_area_fused;
    return is_stepped && r.plane_origin == PlaneOrigin::unsnapped;
}

// True if the rules say which pixels a primitive covers, and with which values. How the view volume cuts a triangle
// whose outline or corners are drawn is unknown.
[[nodiscard]] constexpr bool draws(const RasterRules& r, Primitive primitive) noexcept {
    const Shape shape = shape_of(primitive);
    if (shape == Shape::triangle) return true;
    if (is_of_polygon(primitive) && r.clip != ClipVolume::guard_band) return false;
    if (shape == Shape::line ? r.lines == LineRule::none : r.points == PointRule::none) return false;
    const bool has_spans =
        shape == Shape::line ? r.lines == LineRule::pixel_steps : r.points == PointRule::two_triangles;
    if (has_spans)
        return r.coverage == CoverageRule::float_spans && r.plane_rule == PlaneRule::least_corner &&
               r.plane_origin == PlaneOrigin::unsnapped;
    return r.coverage == CoverageRule::snapped_edges && has_shape_planes(r);
}

// True if the rules say how a stipple counts the fragments of a line. Outlines of polygons count around each polygon,
// whose sides are lines of their own here.
[[nodiscard]] constexpr bool has_line_stipple(const RasterRules& r, Primitive primitive) noexcept {
    return r.lines == LineRule::diamond_exit && primitive != Primitive::polygon_lines;
}

}  // namespace strata::rasterizer
