// rasterizer/rules/rules.h - how a device turns vertices into fragments, as a value. `DeviceProfile` (pipeline) contains one.
// Every field is a knob that a foreign rasterizer may set differently; the devices' own numbers stand in
// pipeline/device/profile.cpp.
#pragma once
#include <cstdint>

#include "rasterizer/rules/depth_code.h"
#include "rasterizer/rules/depth_hypothesis.h"
#include "rasterizer/rules/interpolation_hypothesis.h"

namespace strata::rasterizer {

enum class Snap : std::uint8_t { toward_zero, nearest_even };  // window x, y to 1/2^n pixel

// Which sides of a triangle own a centre that lies exactly on them, in y-down memory order (edge.h).
enum class TieRule : std::uint8_t { top_left, bottom_left, top_right, bottom_right };

enum class ZClip : std::uint8_t {
    per_primitive,
    per_fragment
};                                               // polygons are cut, or fragments outside n..f are dropped
enum class WClip : std::uint8_t { clip, drop };  // a vertex with w <= 0: cut the polygon at w > 0, or drop it whole
// x / w, or x * (1 / w), or that with NV20's vertex arithmetic (nv20_arithmetic.h).
enum class WDivide : std::uint8_t { quotient, reciprocal, nv20 };
enum class ViewportArithmetic : std::uint8_t { separate, fused };  // scale, then offset: two roundings or one
enum class PlaneOrigin : std::uint8_t {
    snapped,
    unsnapped
};  // attribute planes start at snapped or unsnapped positions
enum class WindowZ : std::uint8_t {
    unit_interval,
    buffer_units
};  // vertex window z in [0,1], or scaled by 2^n - 1 at the vertex
enum class ColorInterpolation : std::uint8_t { exact_plane, weights_8bit };
// Unit r of polygon offset: one code of the fixed-point format (D32F: 2^(e - 23) of the primitive), or 2^(e - 23)
// always.
enum class OffsetUnit : std::uint8_t { format, float_exponent };

// How a fragment's depth is computed (depth.md 4): depth_paths.h, window_z.h, plane.h.
enum class DepthPath : std::uint8_t { window_z, perspective_rq, depth_replace, float32, float32_plane, exact };

struct RasterRules {
    int subpixel_bits = 8;  // 4, 8 or 12
    Snap snap = Snap::nearest_even;
    TieRule tie_rule = TieRule::top_left;
    int guard_band_px = 32768;  // positions outside +-guard_band_px are clipped in x and y; at most 32768
    ZClip z_clip = ZClip::per_primitive;
    WClip w_clip = WClip::clip;
    WDivide w_divide = WDivide::quotient;
    ViewportArithmetic viewport = ViewportArithmetic::separate;
    PlaneOrigin plane_origin = PlaneOrigin::snapped;
    WindowZ window_z = WindowZ::unit_interval;
    DepthPath depth_path = DepthPath::float32;  // the device's own
    DepthRounding depth_rounding = DepthRounding::nearest;
    OffsetUnit offset_unit = OffsetUnit::format;
    ColorInterpolation color = ColorInterpolation::exact_plane;
    DepthHypothesis hypothesis{};             // what is assumed of the depth paths
    InterpolationHypothesis interpolation{};  // and of colours and texture coordinates
    friend bool operator==(const RasterRules&, const RasterRules&) = default;
};

}  // namespace strata::rasterizer
