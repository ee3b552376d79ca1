// Suite Vertex_shader_rounding_tests: where positions are truncated, and which triangle owns a pixel centre.
// rasterizer/reference/chip-geometry.md 1. TopLeftRaster[_Fixed]; Geometry_B, AdjacentGeometry_B,
// ProjAdjacentGeometry_B, GeometrySubscreen_B with B a shift in pixels.
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/squares.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::DeviceProfile;
using pipeline::DrawState;
using pipeline::Surface;

constexpr Argb green = 0xff009900, magenta = 0xffff00ff;
constexpr pipeline::SurfaceLayout screen{.depth = pipeline::DepthFormat::d16};

// Green over magenta. The magenta that remains along the upper and the left side shows where `shift` was truncated, and
// which triangle owns the pixel centres on the edge (rasterizer/reference/chip-geometry.md 1.1).
SuitePicture geometry(const DeviceProfile& profile, float shift) {
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xfe404040));
    surface.draw({}, box({200, 120, 440, 360}, magenta));
    surface.draw({}, box({200 + shift, 120 + shift, 440, 360}, green));
    return {.image = surface.color()};
}

// Along the shared edges there must be no gap and no pixel drawn twice.
SuitePicture adjacent_geometry(const DeviceProfile& profile, float shift) {
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xfe404040));
    surface.draw({}, box({120, 140, 520, 340}, 0xffe0e0e0));
    surface.draw({}, eight_squares(shift, green));
    return {.image = surface.color()};
}

// As adjacent_geometry, un-projected by the host and projected again, half of it by the fixed-function pipeline.
SuitePicture projected_adjacent_geometry(const DeviceProfile& profile, float shift) {
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xfe404040));
    draw_mixed_squares(surface, {shift, viewport_offset, green, 0xff00bb00});
    return {.image = surface.color()};
}

// Draws a green quad, moved by `shift`, into a separate magenta target and displays it at x, y. The four numbers are x,
// y, width, height.
void show_subscreen(Surface& surface, const DeviceProfile& profile, float shift,
                    const std::array<int, 4>& place_and_size) {
    const auto [x, y, width, height] = place_and_size;
    // The clip is set to one less than the size, and its last row and column are drawn: its limits are inclusive.
    Surface target{profile, {.depth = pipeline::DepthFormat::d16, .width = width, .height = height}};
    target.clear_color(unpack(magenta));
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    target.draw({.window_clip = rasterizer::Rect{0, 0, width, height}},
                box({shift, shift, w + shift, h + shift}, green));
    place(surface, as_texture(target.color()), static_cast<float>(x), static_cast<float>(y), {});
}

SuitePicture geometry_subscreen(const DeviceProfile& profile, float shift) {
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xfe414041));
    for (const auto& part : {std::array{248, 168, 128, 128}, std::array{392, 168, 128, 32},
                             std::array{248, 312, 32, 128}, std::array{392, 312, 16, 64}})
        show_subscreen(surface, profile, shift, part);
    return {.image = surface.color()};
}

// The columns of TopLeftRaster run along x; its rows are the same with x and y exchanged.
class Lines {
  public:
    Lines(bool along_x, const std::array<float, 4>& marks) : along_x_{along_x}, marks_{marks} {}

    // The shapes of rasterizer/reference/chip-geometry.md 1.5 starting at `start`, four pixels apart. Their edges are
    // on pixel centres, one sixteenth away, and one binary32 below either: each column shows the effect of rounding and
    // of the tie rule on one of these.
    void draw_all(float start, float sliver_start, const std::array<std::array<float, 2>, 3>& slivers) {
        float p = start;
        for (int i = 0; i < 20; ++i, p += 4) skewed_quad(p, p + 0.5f + sixteenths(i));
        for (int i = 0; i < 16; ++i, p += 4) thin_triangle(p, i);
        bar(p + 0.9f, p + 1.1f, marks_[0], marks_[3]);
        bar(p + 4, p + 4.5f, marks_[0], marks_[3]);
        bar(p + 8.4f, p + 8.6f, marks_[0], marks_[3]);
        p += 12;
        const std::array starts{p + 0.5f, next_below(p + 0.5625f), p + 0.5625f};
        for (std::size_t k = 0; k < 3; ++k) bar(starts[k], p + 2.4f, marks_[k], marks_[k + 1]);
        p += 4;
        const std::array ends{p + 1, next_below(p + 1.5625f), p + 1.5625f};
        for (std::size_t k = 0; k < 3; ++k) bar(p + 0.5f, ends[k], marks_[k], marks_[k + 1]);
        const float s = sliver_start;
        const std::array lefts{next_below(s + 0.5f), s + 0.4375f, s + 0.5f};
        for (std::size_t k = 0; k < 3; ++k) bar(lefts[k], s + 0.5625f, slivers[k][0], slivers[k][1]);
        const std::array borders{-0.0625f, -0.0624f, 0.0f};
        for (std::size_t k = 0; k < 3; ++k) bar(borders[k], 1, slivers[k][0], slivers[k][1]);
    }
    // An upright bar: from `from` to `to` along the line, from `begin` to `end` across it.
    void bar(float from, float to, float begin, float end) {
        quad({{{from, begin}, {to, begin}, {to, end}, {from, end}}});
    }
    [[nodiscard]] TriangleSoup take() { return std::move(soup_); }

  private:
    static constexpr Argb color = 0xff337788;
    using Point = std::array<float, 2>;  // along, across

    static float sixteenths(int i) { return static_cast<float>(i) / 16.0f; }
    [[nodiscard]] ClipVertex vertex(const Point& p) const {
        return along_x_ ? at(p[0], p[1], color) : at(p[1], p[0], color);
    }
    void quad(const std::array<Point, 4>& p) {
        add_quad(soup_, {vertex(p[0]), vertex(p[1]), vertex(p[2]), vertex(p[3])});
    }
    void skewed_quad(float p, float slope_end) {
        quad({{{next_below(p + 0.5f), marks_[0]},
               {p + 1.9f, marks_[0]},
               {p + 1.9f, marks_[2]},
               {slope_end, marks_[2]}}});
    }
    void thin_triangle(float p, int i) {
        const float edge = next_below(p + 0.5f - sixteenths(i));
        const Point tip{p + 0.5625f + sixteenths(i), marks_[3]};
        add_triangle(soup_, vertex({edge, marks_[0]}), vertex(tip), vertex({edge, marks_[3]}));
    }

    bool along_x_;
    std::array<float, 4> marks_;
    TriangleSoup soup_;
};

SuitePicture top_left_raster(const DeviceProfile& profile) {
    constexpr Argb color = 0xff337788;
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xff202224));
    Lines columns{true, {45, 135, 315, 450}}, rows{false, {320, 420, 520, 620}};
    columns.draw_all(4, 184, {{{50, 100}, {150, 200}, {250, 300}}});
    rows.draw_all(45, 225, {{{320, 380}, {440, 500}, {560, 620}}});
    surface.draw({}, columns.take());
    surface.draw({}, rows.take());
    surface.draw({}, box({10, 455.5f, 630, 456.6f}, color));
    surface.draw({}, box({10, 460.4f, 630, 461.5f}, color));
    return {.image = surface.color()};
}

}  // namespace

Drawing draw_vertex_shader_rounding(std::string_view name, const DeviceProfile& profile) {
    if (name == "TopLeftRaster" || name == "TopLeftRaster_Fixed") return {top_left_raster(profile), {}};
    using Draw = SuitePicture (*)(const DeviceProfile&, float);
    constexpr std::pair<std::string_view, Draw> shifted[] = {{"Geometry_", geometry},
                                                             {"AdjacentGeometry_", adjacent_geometry},
                                                             {"ProjAdjacentGeometry_", projected_adjacent_geometry},
                                                             {"GeometrySubscreen_", geometry_subscreen}};
    for (const auto& [prefix, draw] : shifted) {
        std::string_view rest = name;
        if (!take(rest, prefix)) continue;
        const auto shift = to_number(rest);  // also excludes NaN
        if (shift && *shift >= 0.0f && *shift <= 1.0f) return {draw(profile, *shift), {}};
    }
    for (const std::string_view prefix : {"GeometrySuperscreen_", "RenderTarget", "Compositing"})
        if (name.starts_with(prefix)) return {std::nullopt, "targets of this kind are not described"};
    return unknown_name;
}

}  // namespace strata::hardware_check
