// rasterizer/rules/raster_state.h - the state of rasterization. Conventions (clip depth, y direction, depth order) are
// part of the state.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

// Pixels [x0, x1) x [y0, y1) of the surface, y down in memory order.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] constexpr int width() const noexcept { return x1 > x0 ? x1 - x0 : 0; }
    [[nodiscard]] constexpr int height() const noexcept { return y1 > y0 ? y1 - y0 : 0; }
    [[nodiscard]] constexpr std::size_t area() const noexcept {
        return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
    }
    friend constexpr bool operator==(const Rect&, const Rect&) = default;
};

[[nodiscard]] constexpr Rect intersection(const Rect& a, const Rect& b) noexcept {
    return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1, a.y1 < b.y1 ? a.y1 : b.y1};
}

// The view volume in z: -w <= z <= w (OpenGL) or 0 <= z <= w (Direct3D).
enum class ClipDepth : std::uint8_t { minus_one_to_one, zero_to_one };
// The depth test that keeps the nearer of two fragments. `greater` is reversed depth: nearer depths are greater, and
// passes compare keys (depth_key.h).
enum class DepthOrder : std::uint8_t { less, greater };
// The direction of clip-space +y on the surface. `up`: OpenGL's default framebuffer, row 0 of memory is the top of the
// window.
enum class YDirection : std::uint8_t { up, down };
enum class CullFace : std::uint8_t { none, front, back, front_and_back };
// The winding of front faces as seen in the window with y up (GL 2.1 2.14.1).
enum class FrontFace : std::uint8_t { counter_clockwise, clockwise };

// glPolygonOffset: o = m * factor + r * units (GL 2.1 3.5.5; rasterizer/reference/coverage.md 9).
struct PolygonOffset {
    bool enabled = false;
    float factor = 0.0f, units = 0.0f;
    friend bool operator==(const PolygonOffset&, const PolygonOffset&) = default;
};

// a x + b y + c z + d w >= 0 in clip space is kept (glClipPlane after the transform to clip space).
struct ClipPlane {
    float a = 0, b = 0, c = 0, d = 1;
    friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

// A point within a pixel in units of 1/16 pixel, from its left side and, in memory rows, from its upper side: 0 to 15;
// 8 is the middle.
struct SamplePoint {
    int x = 8, y = 8;
    // Offset from the pixel's centre, in pixels.
    [[nodiscard]] constexpr float right() const noexcept { return static_cast<float>(x - 8) * 0.0625f; }
    [[nodiscard]] constexpr float down() const noexcept { return static_cast<float>(y - 8) * 0.0625f; }
    friend bool operator==(const SamplePoint&, const SamplePoint&) = default;
};

// Where the values of a fragment that programs read are evaluated, named as GLSL's qualifiers: at the sample, as its
// coverage and stored depth always are, at the pixel's centre, or at its centroid
// (rasterizer/reference/coverage.md 12.3).
enum class Interpolation : std::uint8_t { sample, centre, centroid };

// Which samples a fragment covers beside its geometry, of ARB_multisample (pipeline/reference/fragment-stages.md 13.6).
struct SampleCoverage {
    bool by_alpha = false;         // SAMPLE_ALPHA_TO_COVERAGE
    std::optional<float> value{};  // SAMPLE_COVERAGE: the share of samples
    bool is_inverted = false;      // its complement
    std::uint8_t mask = 0xff;      // bit s: sample s
    friend bool operator==(const SampleCoverage&, const SampleCoverage&) = default;
};

// NV2A's lines, chosen by its register SMOOTHING_CONTROL and by LINE_SMOOTH. band: a rectangle of the line's width.
// thin: one pixel per step of the longer direction, only for a width of one pixel. smooth: the band at eight samples of
// a pixel, whose share multiplies alpha (lines-and-points.md 2 to 3).
enum class LineStyle : std::uint8_t { band, thin, smooth };

// glPolygonStipple: bit 31 - x % 32 of row y % 32, counted from the window's upper left pixel, keeps pixel (x, y) of a
// triangle (lines-and-points.md 6).
using PolygonStipple = std::array<std::uint32_t, 32>;

// glLineStipple: fragment s of a line, counted from its start, is kept if bit s / factor mod 16 of the pattern is set;
// lines of a strip count on (lines-and-points.md 8).
struct LineStipple {
    int factor = 1;  // 1 to 256
    std::uint16_t pattern = 0xffff;
    friend bool operator==(const LineStipple&, const LineStipple&) = default;
};

struct RasterState {
    // The viewport rectangle, which is also the extent of the surface: fragments outside it do not exist.
    Rect viewport;
    // glDepthRange, clamped to [0,1] where it is used; near > far is a reversed range.
    float depth_near = 0.0f, depth_far = 1.0f;
    ClipDepth clip_depth = ClipDepth::minus_one_to_one;
    DepthOrder depth_order = DepthOrder::less;
    YDirection y_direction = YDirection::up;
    std::optional<Rect> scissor;
    // The point of every pixel at which coverage, depth, colours and coordinates are evaluated, for one sample of
    // several. Empty: one sample per pixel, at its centre (coverage.md 12).
    std::optional<SamplePoint> sample;
    // Not `sample` only with a sample. The centroid also takes the points of all samples of a pixel.
    Interpolation interpolation = Interpolation::sample;
    std::array<SamplePoint, 8> samples{};
    // Not the default only with a sample, whose number it takes.
    SampleCoverage sample_coverage{};
    int sample_count = 0, sample_number = 0;  // of a pixel; of this frame
    // ARB_depth_clamp: no clipping at near and far; depth is clamped just before the test.
    bool depth_clamp = false;
    // NV2A's NEARFAR: drops a triangle if all three z are in front of the depth range or all behind it, also with depth
    // clamp.
    bool range_culls_triangles = false;
    // Units of a w buffer per unit of clip w; 0: chosen so that w of the far plane is depth 1 (depth.md 4.8).
    float w_scale = 0.0f;
    // 1 / log2(1 + w of the far plane), for DepthPath::logarithmic; 0: of the projection's far plane (depth.md 4.9).
    float log_scale = 0.0f;
    // For single-sided triangles: double-sided ones are never culled.
    CullFace cull = CullFace::back;
    FrontFace front_face = FrontFace::counter_clockwise;
    PolygonOffset polygon_offset;  // of triangles
    float line_width_px = 1.0f, point_size_px = 1.0f;
    bool point_sprites = false;  // GL_POINT_SPRITE: a point's texture coordinates are those of its square
    LineStyle line_style = LineStyle::band;
    bool smooth_polygons = false;  // NV2A's POLY_SMOOTH: as LineStyle::smooth, for triangles
    std::optional<PolygonStipple> polygon_stipple{};
    std::optional<LineStipple> line_stipple{};
    std::array<ClipPlane, 6> clip_planes{};
    // The number of clip_planes in use, 0 to 6.
    int clip_plane_count = 0;
    // Vertices have window x, y (pixels), z (rules.window_z units) and their w, as a vertex program of NV2A writes
    // them: no clip volume, no division, no viewport.
    bool window_positions = false;
    // Determines vertex z in buffer units and the unit of polygon offset.
    DepthFormat depth_format = DepthFormat::d32f;
    friend bool operator==(const RasterState&, const RasterState&) = default;
};

}  // namespace strata::rasterizer
