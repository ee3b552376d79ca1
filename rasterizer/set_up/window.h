// rasterizer/set_up/window.h - from clip space to window space: division by w, viewport, snapping.
//
// Rule     xd = x / w or x * (1 / w) (rules.w_divide); window = scale * xd + offset, rounded after each operation or
//          once (rules.viewport, which may depend on whether clipping created the vertex); all in binary32, for
//          WDivide::nv20 by nv20_arithmetic.h. With y up the y scale changes its sign. YAxis::clip with y up: y is
//          measured upwards from the viewport's lower side and flipped when it is snapped. half_pixel_first: offsets
//          are half a pixel smaller, which is added back to snapped positions. z is mapped to n..f, or to n..f times
//          2^n - 1 with scale and offset pre-multiplied (buffer units; the unit of a float depth buffer is 1). x and y
//          are truncated or rounded to 1/2^n.
// Source   GL 2.1 2.11.1; rasterizer/reference/coverage.md 3 and 4; chip-geometry.md 1; chip-depth.md 1.4.
// Numbers  A product of two binary32 is exact in binary64; `fused` rounds its sum to odd there, so that the conversion
//          to binary32 is the only rounding.
// Tests    tests/rasterizer/set_up/window_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "rasterizer/base/fused.h"
#include "rasterizer/base/nv20_arithmetic.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/set_up/guard_band.h"
#include "rasterizer/set_up/plain_vertices.h"

namespace strata::rasterizer {
inline namespace strict {

struct WindowVertex {
    float x, y, z, inverse_w;
};

// Whether the projected vertex is a given one or created by clipping (ViewportArithmetic::fused_given).
enum class VertexOrigin : std::uint8_t { given, made_by_clip };

// The number of vertex z units in depth 1.0: the depth buffer's own, or 1.
[[nodiscard]] constexpr double z_units(const RasterState& state, const RasterRules& rules) noexcept {
    return rules.window_z == WindowZ::buffer_units ? buffer_units(state.depth_format) : 1.0;
}

// w with its magnitude limited to 2^-64 .. 2^64, also for zero and infinity: 1 / w and its products stay finite. NaN is
// returned unchanged. NV2A's reciprocal has these limits (chip-float-depth.md 8).
[[nodiscard]] constexpr float settled_w(float w) noexcept {
    const bool is_negative = std::bit_cast<std::uint32_t>(w) >> 31 != 0;
    float size = is_negative ? -w : w;
    if (size < 0x1p-64f) size = 0x1p-64f;
    if (size > 0x1p64f) size = 0x1p64f;
    return is_negative ? -size : size;
}

// v in subpixels. Precondition: |v| * 2^n < 2^30.
[[nodiscard]] constexpr std::int32_t snap(float v, int subpixel_bits, Snap rule) noexcept {
    const double scaled = double{v} * (1 << subpixel_bits);  // exact
    if (rule == Snap::toward_zero) return static_cast<std::int32_t>(scaled);
    // The unit in the last place of a sum with this number is 1, so the addition rounds to an integer, ties to even.
    constexpr double round_at_one = 0x1.8p52;
    return static_cast<std::int32_t>((scaled + round_at_one) - round_at_one);
}

// The rules with coordinates of 4, 8 or 12 bits: a coarser grid of positions leaves the last ones unused. With 4 or
// more of them the centre of a pixel and the points of its samples are coordinates.
[[nodiscard]] constexpr RasterRules with_coordinates(RasterRules rules) noexcept {
    const int grid = rules.subpixel_bits - rules.unused_bits;
    rules.subpixel_bits = grid <= 4 ? 4 : grid <= 8 ? 8 : 12;
    rules.unused_bits = rules.subpixel_bits - grid;
    return rules;
}

// Scale and offset of each axis for one draw. Those of depth are computed in binary64 and rounded once to binary32
// (coverage.md 3.1).
class WindowTransform {
  public:
    constexpr WindowTransform(const RasterState& state, const RasterRules& rules) noexcept
        : rules_{rules}, guard_{static_cast<float>(guard_band(rules))}, is_done_{state.window_positions} {
        const Rect& v = state.viewport;
        x_ = {0.5f * static_cast<float>(v.width()), static_cast<float>(v.x0) + 0.5f * static_cast<float>(v.width())};
        y_ = {0.5f * static_cast<float>(v.height()), static_cast<float>(v.y0) + 0.5f * static_cast<float>(v.height())};
        rows_ = v.y1;
        is_turned_ = !is_done_ && rules.y_axis == YAxis::clip && state.y_direction == YDirection::up;
        if (is_turned_)
            y_.offset = 0.5f * static_cast<float>(v.height());
        else if (state.y_direction == YDirection::up)
            y_.scale = -y_.scale;
        if (!is_done_ && rules.viewport == ViewportArithmetic::half_pixel_first) {
            half_ = 1 << (rules.subpixel_bits - 1);
            x_.offset -= 0.5f;
            y_.offset -= 0.5f;
        }
        if (state.sample) {
            const int sixteenth = 1 << (rules.subpixel_bits - 4);
            sample_ = {(state.sample->x - 8) * sixteenth, (state.sample->y - 8) * sixteenth};
        }
        const double n = state.depth_near, f = state.depth_far, units = z_units(state, rules);
        const bool symmetric = state.clip_depth == ClipDepth::minus_one_to_one;
        z_ = {static_cast<float>((symmetric ? (f - n) * 0.5 : f - n) * units),
              static_cast<float>((symmetric ? (n + f) * 0.5 : n) * units)};
    }

    // Inside the planes of clip.h, w is at least least_w. Window positions are not clipped: set-up finds values that
    // are not finite.
    [[nodiscard]] constexpr WindowVertex project(const ClipVertex& v,
                                                 VertexOrigin origin = VertexOrigin::given) const noexcept {
        if (rules_.w_divide == WDivide::nv20) return project_nv20(v);
        const float inverse_w = 1.0f / v.w;
        if (is_done_) return {within_guard(v.x), within_guard(v.y), v.z, inverse_w};
        const auto divided = [&](float c) { return rules_.w_divide == WDivide::quotient ? c / v.w : c * inverse_w; };
        const bool fuses = rules_.viewport == ViewportArithmetic::fused ||
                           (rules_.viewport == ViewportArithmetic::fused_given && origin == VertexOrigin::given);
        return {within_guard(map(x_, divided(v.x), fuses)), within_guard(map(y_, divided(v.y), fuses)),
                map(z_, divided(v.z), fuses), inverse_w};
    }
    // The snapped position minus the sample's offset from the centre, so that evaluation at the centre gives the value
    // at the sample (coverage.md 12.1).
    [[nodiscard]] constexpr SubpixelPoint snapped(const WindowVertex& v) const noexcept {
        const std::int32_t x = on_grid(v.x) + half_, y = on_grid(v.y) + half_;
        return at_sample({x, is_turned_ ? (rows_ << rules_.subpixel_bits) - y : y});
    }
    [[nodiscard]] constexpr SubpixelPoint at_sample(SubpixelPoint p) const noexcept {
        return {p.x - sample_.x, p.y - sample_.y};
    }
    [[nodiscard]] constexpr bool is_moved() const noexcept { return sample_.x != 0 || sample_.y != 0; }
    // The window position in memory orientation, in pixels.
    [[nodiscard]] constexpr std::array<float, 2> position(const WindowVertex& v) const noexcept {
        if (half_ == 0 && !is_turned_) return {v.x, v.y};
        const float less = half_ != 0 ? 0.5f : 0.0f, y = v.y + less;
        return {v.x + less, is_turned_ ? static_cast<float>(rows_) - y : y};
    }

    // A vertex at any position, snapped, in subpixels from the centre of the first pixel, with rows in the direction of
    // rules.y_axis. Values that do not fit in 32 bits become the least 32-bit integer; a w of 0 is treated as 1.
    [[nodiscard]] constexpr SubpixelPoint from_first_centre(const ClipVertex& v) const noexcept {
        const float inverse_w = v.w == 0.0f ? 1.0f : 1.0f / v.w;
        const auto place = [&](const Axis& axis, float c) {
            const float divided = rules_.w_divide == WDivide::quotient && v.w != 0.0f ? c / v.w : c * inverse_w;
            const float at = is_done_ ? c : map(axis, divided, rules_.viewport == ViewportArithmetic::fused);
            const double scaled = double{at} * (1 << rules_.subpixel_bits);
            if (!(scaled < 0x1p31 && scaled >= -0x1p31)) return std::numeric_limits<std::int32_t>::min();
            const std::int32_t unit = 1 << rules_.unused_bits;
            return wrapped(snap(static_cast<float>(scaled / unit), 0, rules_.snap) * unit,
                           half_ - (1 << (rules_.subpixel_bits - 1)));
        };
        return {place(x_, v.x), place(y_, v.y)};
    }
    // Pixel row `y` of memory in that direction.
    [[nodiscard]] constexpr int counted_row(int y) const noexcept { return is_turned_ ? rows_ - 1 - y : y; }
    [[nodiscard]] constexpr bool is_turned() const noexcept { return is_turned_; }

    // The rules for the kernel that sets up sixteen vertices (plain_vertices.h); empty if this transform needs more
    // than those rules can express.
    [[nodiscard]] constexpr std::optional<PlainVertexRules> plain_rules(ClipDepth depth) const noexcept {
        if (is_done_ || rules_.w_divide == WDivide::nv20 || rules_.viewport != ViewportArithmetic::separate ||
            is_turned_ || rules_.unused_bits != 0)
            return {};
        const auto reach = [this](const Axis& axis) {
            const auto size = [](float v) { return v < 0.0f ? -v : v; };
            const float half = 0.5f * (guard_ - size(axis.offset)) / size(axis.scale);
            return rules_.clip == ClipVolume::guard_band && half > 1.0f ? half : 1.0f;
        };
        return PlainVertexRules{.scale = {x_.scale, y_.scale, z_.scale},
                                .offset = {x_.offset, y_.offset, z_.offset},
                                .reach = {reach(x_), reach(y_)},
                                .guard = guard_,
                                .subpixels = static_cast<float>(1 << rules_.subpixel_bits),
                                .divides = rules_.w_divide == WDivide::quotient,
                                .rounds = rules_.snap == Snap::nearest_even,
                                .symmetric = depth == ClipDepth::minus_one_to_one};
    }

  private:
    [[nodiscard]] constexpr std::int32_t on_grid(float v) const noexcept {
        return snap(v, rules_.subpixel_bits - rules_.unused_bits, rules_.snap) * (1 << rules_.unused_bits);
    }
    struct Axis {
        float scale, offset;
    };
    [[nodiscard]] static constexpr float map(const Axis& axis, float c, bool fuses) noexcept {
        if (fuses) return fused_multiply_add(axis.scale, c, axis.offset);
        const float scaled = axis.scale * c;
        return scaled + axis.offset;
    }
    // The projection with the vertex engine's own product, sum and reciprocal (numbers.md 4.5).
    [[nodiscard]] constexpr WindowVertex project_nv20(const ClipVertex& v) const noexcept {
        const float inverse_w = nv20::reciprocal(v.w);
        const auto mapped = [&](const Axis& axis, float c) {
            return nv20::sum(std::array{nv20::multiply(axis.scale, nv20::multiply(c, inverse_w)), axis.offset});
        };
        return {within_guard(mapped(x_, v.x)), within_guard(mapped(y_, v.y)), mapped(z_, v.z), inverse_w};
    }
    // The sum modulo 2^32.
    [[nodiscard]] static constexpr std::int32_t wrapped(std::int32_t a, std::int32_t b) noexcept {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    }
    // Clamps to the guard band: clipping leaves the vertex inside it except for rounding. NaN is returned unchanged and
    // counted by set-up.
    [[nodiscard]] constexpr float within_guard(float c) const noexcept {
        return c > guard_ ? guard_ : (c < -guard_ ? -guard_ : c);
    }

    RasterRules rules_;
    float guard_;
    bool is_done_, is_turned_ = false;
    int rows_ = 0;            // the row of the viewport's lower side
    std::int32_t half_ = 0;   // subpixels to add back to snapped positions
    SubpixelPoint sample_{};  // offset of the sample from the pixel's centre, in subpixels
    Axis x_{}, y_{}, z_{};
};

}  // namespace strict
}  // namespace strata::rasterizer
