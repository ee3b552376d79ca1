// rasterizer/set_up/clip.h - homogeneous clipping of a triangle to the volume that can be projected and to the planes
// of the state.
//
// Rule     Planes in this order: w >= 2^-64; near and far (not with depth clamp or per-fragment z clip); the guard band
//          in x and y; the user's planes. A side that crosses a plane gets one new corner, computed from its inside end
//          I to its outside end O in whichever direction it is walked: t = dI / (dI - dO), corner = I + t (O - I) in
//          binary64, each component rounded once to binary32. So two triangles that share a side share its new corners
//          bit for bit, and equal values stay equal. ClipVolume::view_volume: the planes x = w, -x = w, y = w, -y = w,
//          near, far and the user's, in binary32; the new corner starts from the end that is nearer to the plane.
//          view_volume_depth_first: near, far, -x = w, x = w, y = w, -y = w and the user's; corner = (dO I - dI O) (1 /
//          (dO - dI)), each operation rounded. A line in view_volume: of all planes that an end A is outside of, the
//          greatest t = dA / (dA - dB) moves it to A + t (B - A); nothing is left if both t together are at least 1.
// Source   Sutherland and Hodgman 1974; GL 2.1 2.12; rasterizer/reference/coverage.md 2. The bound on w is assumed: it
//          keeps 1 / w and u / w finite.
// Tests    tests/rasterizer/set_up/clip_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

// One plane for w, two for near and far, four for the guard band, six of the user.
inline constexpr int max_clip_planes = 1 + 2 + 4 + 6;
// Assumed. This least w keeps 1 / w and u / w finite (coverage.md 2.2).
inline constexpr float least_w = 0x1p-64f;

// A convex polygon, corners in order along its boundary. Each plane adds at most one corner to the three of the
// triangle.
struct ClipPolygon {
    std::array<ClipVertex, 3 + max_clip_planes> corner;
    int count = 0;
    std::size_t extra_count = 0;
    std::array<std::array<float, max_extras>, 3 + max_clip_planes> extra{};  // the first extra_count of each corner
    // True for corners that a plane created; the others are the triangle's own.
    std::array<bool, 3 + max_clip_planes> is_new{};
};

// The clip planes of one draw. Most vertices are in the view volume and are not tested against any plane equation.
class Clipper {
  public:
    Clipper(const RasterState& state, const RasterRules& rules);

    // Bit i is set if the vertex is outside plane i. Bit 0 is the w plane.
    [[nodiscard]] std::uint32_t outside(const ClipVertex& v) const noexcept {
        return within_viewport(v) ? 0u : outside_planes(v);
    }
    // True if a vertex in the view volume is inside all planes.
    [[nodiscard]] bool holds_view_volume() const noexcept { return holds_view_volume_; }
    // Clips `polygon` against the planes of the set `planes`; the corners stay in order, starting at corner 0.
    void clip(ClipPolygon& polygon, std::uint32_t planes) const noexcept;
    // Clips the line from corner 0 to corner 1; false if nothing is left. Some end is outside of each plane.
    [[nodiscard]] bool clip_line(ClipPolygon& line, std::uint32_t planes) const noexcept;

  private:
    // the equation that holds exactly on the plane
    enum class Kind : std::uint8_t { w, z_is_minus_w, z_is_zero, z_is_w, other };
    // Inside means x X + y Y + z Z + w W + constant >= 0.
    struct Plane {
        double x, y, z, w, constant;
        Kind kind;
    };
    // True if the vertex is in the view volume and therefore inside all planes: the guard band contains the view volume
    // and there are no user planes. These comparisons have the signs of the exact distances.
    [[nodiscard]] bool within_viewport(const ClipVertex& v) const noexcept {
        const float w = v.w, least_z = symmetric_ ? -w : 0.0f;
        return holds_view_volume_ && w >= least_w && v.x >= -w && v.x <= w && v.y >= -w && v.y <= w && v.z >= least_z &&
               v.z <= w;
    }
    [[nodiscard]] std::uint32_t outside_planes(const ClipVertex& v) const noexcept;
    [[nodiscard]] static double distance(const Plane& plane, const ClipVertex& v) noexcept;
    [[nodiscard]] static float distance_single(const Plane& plane, const ClipVertex& v) noexcept;
    [[nodiscard]] static ClipVertex crossing(const Plane& plane, const ClipVertex& in, double d_in,
                                             const ClipVertex& out, double d_out) noexcept;
    void add_near_and_far() noexcept;
    void add_guard_band(const RasterState& state, const RasterRules& rules) noexcept;
    void add_view_volume(bool clips_z) noexcept;
    void add_view_volume_depth_first(bool clips_z) noexcept;
    void add(const Plane& plane) noexcept { plane_[static_cast<std::size_t>(count_++)] = plane; }
    static void clip_against(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept;
    // The same for ClipVolume::view_volume, and for view_volume_depth_first.
    static void clip_single(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept;
    static void clip_depth_first(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept;
    [[nodiscard]] bool clip_line_single(ClipPolygon& line, std::uint32_t planes) const noexcept;

    std::array<Plane, max_clip_planes> plane_{};
    int count_ = 0;
    bool symmetric_, is_single_, is_depth_first_, holds_view_volume_;
};

}  // namespace strata::rasterizer
