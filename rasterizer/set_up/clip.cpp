#include "rasterizer/set_up/clip.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {
namespace {

// The share t of the way from a to b.
[[nodiscard]] float mix(float a, float b, double t) noexcept { return static_cast<float>(a + t * (double{b} - a)); }

}  // namespace

Clipper::Clipper(const RasterState& state, const RasterRules& rules)
    : symmetric_{state.clip_depth == ClipDepth::minus_one_to_one},
      guard_holds_viewport_{state.clip_plane_count == 0 && state.viewport.x0 >= -rules.guard_band_px &&
                            state.viewport.y0 >= -rules.guard_band_px && state.viewport.x1 <= rules.guard_band_px &&
                            state.viewport.y1 <= rules.guard_band_px} {
    if (state.window_positions) return;  // there is no clip space; set-up keeps positions within the guard band
    const auto add = [&](Plane plane) { plane_[static_cast<std::size_t>(count_++)] = plane; };
    add({0, 0, 0, 1, -double{least_w}, Kind::w});
    if (!state.depth_clamp && rules.z_clip == ZClip::per_primitive) {
        add(symmetric_ ? Plane{0, 0, 1, 1, 0, Kind::z_is_minus_w} : Plane{0, 0, 1, 0, 0, Kind::z_is_zero});
        add({0, 0, -1, 1, 0, Kind::z_is_w});
    }
    // |centre + half x / w| <= guard, times w: products are exact in binary64, so the sign of the distance is.
    const double guard = rules.guard_band_px;
    const auto add_guard = [&](double half, double centre, bool is_x) {
        for (const double side : {-half, half})
            add({is_x ? side : 0, is_x ? 0 : side, 0, guard + (side > 0 ? centre : -centre), 0, Kind::other});
    };
    const Rect& v = state.viewport;
    const double y_sign = state.y_direction == YDirection::up ? -1.0 : 1.0;
    add_guard(0.5 * v.width(), v.x0 + 0.5 * v.width(), true);
    // With y up, window y = centre - half y / w: the same two planes with the centre's sign exchanged.
    add_guard(0.5 * v.height(), y_sign * (v.y0 + 0.5 * v.height()), false);
    assert(state.clip_plane_count <= static_cast<int>(state.clip_planes.size()) && "at most six user clip planes");
    for (int i = 0; i < state.clip_plane_count; ++i) {
        const ClipPlane& p = state.clip_planes[static_cast<std::size_t>(i)];
        add({p.a, p.b, p.c, p.d, 0, Kind::other});
    }
}

// From the left in binary64, each step rounded (coverage.md 2.3): a vertex has one distance, whichever triangle asks.
double Clipper::distance(const Plane& plane, const ClipVertex& v) noexcept {
    double d = plane.x * v.x;
    d = d + plane.y * v.y;
    d = d + plane.z * v.z;
    d = d + plane.w * v.w;
    return d + plane.constant;
}

std::uint32_t Clipper::outside_planes(const ClipVertex& v) const noexcept {
    std::uint32_t mask = 0;
    for (int i = 0; i < count_; ++i) mask |= (distance(plane_[static_cast<std::size_t>(i)], v) < 0.0 ? 1u : 0u) << i;
    return mask;
}

// Always from the inside end to the outside end, so that both
// triangles of a shared side get the same bits (coverage.md 2.4).
ClipVertex Clipper::crossing(const Plane& plane, const ClipVertex& in, double d_in, const ClipVertex& out,
                             double d_out) noexcept {
    const double t = d_in / (d_in - d_out);
    ClipVertex v;
    v.x = mix(in.x, out.x, t);
    v.y = mix(in.y, out.y, t);
    v.z = mix(in.z, out.z, t);
    v.w = mix(in.w, out.w, t);
    for (std::size_t i = 0; i < v.front.size(); ++i) v.front[i] = mix(in.front[i], out.front[i], t);
    for (std::size_t i = 0; i < v.back.size(); ++i) v.back[i] = mix(in.back[i], out.back[i], t);
    for (std::size_t i = 0; i < v.texcoord.size(); ++i) v.texcoord[i] = mix(in.texcoord[i], out.texcoord[i], t);
    switch (plane.kind) {  // what the plane says holds exactly: window z of the corner is n or f
        case Kind::w: v.w = least_w; break;
        case Kind::z_is_minus_w: v.z = -v.w; break;
        case Kind::z_is_zero: v.z = 0.0f; break;
        case Kind::z_is_w: v.z = v.w; break;
        case Kind::other: break;
    }
    return v;
}

// One step of Sutherland and Hodgman. A corner on the plane is
// kept and makes no second corner there (coverage.md 2.5).
void Clipper::cut(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) const noexcept {
    to.count = 0;
    to.extra_count = from.extra_count;
    const auto keep = [&](std::size_t i) {
        const auto n = static_cast<std::size_t>(to.count++);
        to.corner[n] = from.corner[i];
        std::copy_n(from.extra[i].begin(), from.extra_count, to.extra[n].begin());
    };
    const auto cross = [&](std::size_t in, double d_in, std::size_t out, double d_out) {
        const auto n = static_cast<std::size_t>(to.count++);
        to.corner[n] = crossing(plane, from.corner[in], d_in, from.corner[out], d_out);
        for (std::size_t e = 0; e < from.extra_count; ++e)
            to.extra[n][e] = mix(from.extra[in][e], from.extra[out][e], d_in / (d_in - d_out));
    };
    for (int i = 0; i < from.count; ++i) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(i + 1 == from.count ? 0 : i + 1);
        const double da = distance(plane, from.corner[a]), db = distance(plane, from.corner[b]);
        if (da >= 0.0) keep(a);
        if (da >= 0.0 && db < 0.0 && da > 0.0) cross(a, da, b, db);
        if (da < 0.0 && db > 0.0) cross(b, db, a, da);
    }
}

void Clipper::clip(ClipPolygon& polygon, std::uint32_t planes) const noexcept {
    ClipPolygon other;
    for (int i = 0; i < count_; ++i) {
        if ((planes >> i & 1u) == 0) continue;
        cut(plane_[static_cast<std::size_t>(i)], polygon, other);
        polygon = other;
        if (polygon.count < 3) break;
    }
}

}  // namespace strata::rasterizer
