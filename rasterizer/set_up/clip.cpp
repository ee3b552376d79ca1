// rasterizer/set_up/clip.cpp - clips triangles to the planes of clip.h, by the guard band's arithmetic (binary64) or by
// one of the two of the view volume (binary32).
#include "rasterizer/set_up/clip.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "rasterizer/base/numerics.h"
#include "rasterizer/set_up/guard_band.h"

namespace strata::rasterizer {
namespace {

// Interpolates from a (t = 0) to b (t = 1) in binary64, rounded once.
[[nodiscard]] float mix(float a, float b, double t) noexcept { return static_cast<float>(a + t * (double{b} - a)); }

// True if the guard band contains the viewport, or there is no guard band.
[[nodiscard]] bool guard_holds(const Rect& viewport, const RasterRules& rules) noexcept {
    const int guard = guard_band(rules);
    return rules.clip != ClipVolume::guard_band ||
           (viewport.x0 >= -guard && viewport.y0 >= -guard && viewport.x1 <= guard && viewport.y1 <= guard);
}

}  // namespace

Clipper::Clipper(const RasterState& state, const RasterRules& rules)
    : symmetric_{state.clip_depth == ClipDepth::minus_one_to_one},
      is_single_{rules.clip != ClipVolume::guard_band},
      is_depth_first_{rules.clip == ClipVolume::view_volume_depth_first},
      holds_view_volume_{state.clip_plane_count == 0 && guard_holds(state.viewport, rules)} {
    if (state.window_positions) return;  // there is no clip space; set-up clamps positions to the guard band
    add({0, 0, 0, 1, -double{least_w}, Kind::w});
    const bool clips_z = !state.depth_clamp && rules.z_clip == ZClip::per_primitive;
    if (is_depth_first_)
        add_view_volume_depth_first(clips_z);
    else if (is_single_)
        add_view_volume(clips_z);
    if (!is_single_ && clips_z) add_near_and_far();
    if (!is_single_) add_guard_band(state, rules);
    assert(state.clip_plane_count <= static_cast<int>(state.clip_planes.size()) && "at most six user clip planes");
    for (int i = 0; i < state.clip_plane_count; ++i) {
        const ClipPlane& p = state.clip_planes[static_cast<std::size_t>(i)];
        add({p.a, p.b, p.c, p.d, 0, Kind::other});
    }
}

void Clipper::add_near_and_far() noexcept {
    add(symmetric_ ? Plane{0, 0, 1, 1, 0, Kind::z_is_minus_w} : Plane{0, 0, 1, 0, 0, Kind::z_is_zero});
    add({0, 0, -1, 1, 0, Kind::z_is_w});
}

void Clipper::add_guard_band(const RasterState& state, const RasterRules& rules) noexcept {
    // |centre + half x / w| <= guard, times w: products are exact in binary64, so the sign of the distance is too.
    const double guard = guard_band(rules);
    const auto add_guard = [&](double half, double centre, bool is_x) {
        for (const double side : {-half, half})
            add({is_x ? side : 0, is_x ? 0 : side, 0, guard + (side > 0 ? centre : -centre), 0, Kind::other});
    };
    const Rect& v = state.viewport;
    const double y_sign = state.y_direction == YDirection::up ? -1.0 : 1.0;
    add_guard(0.5 * v.width(), v.x0 + 0.5 * v.width(), true);
    // With y up, window y = centre - half y / w: the same two planes with the centre's sign exchanged.
    add_guard(0.5 * v.height(), y_sign * (v.y0 + 0.5 * v.height()), false);
}

// The order of the planes decides which corners result (rasterizer/reference/coverage.md 2.8).
void Clipper::add_view_volume(bool clips_z) noexcept {
    add({-1, 0, 0, 1, 0, Kind::other});
    add({1, 0, 0, 1, 0, Kind::other});
    add({0, -1, 0, 1, 0, Kind::other});
    add({0, 1, 0, 1, 0, Kind::other});
    if (clips_z) add_near_and_far();
}

void Clipper::add_view_volume_depth_first(bool clips_z) noexcept {
    if (clips_z) add_near_and_far();
    add({1, 0, 0, 1, 0, Kind::other});
    add({-1, 0, 0, 1, 0, Kind::other});
    add({0, -1, 0, 1, 0, Kind::other});
    add({0, 1, 0, 1, 0, Kind::other});
}

// Summed from left to right in binary64, each step rounded (coverage.md 2.3): a vertex has the same distance for every
// triangle.
double Clipper::distance(const Plane& plane, const ClipVertex& v) noexcept {
    double d = plane.x * v.x;
    d = d + plane.y * v.y;
    d = d + plane.z * v.z;
    d = d + plane.w * v.w;
    return d + plane.constant;
}

// The same in binary32. With coefficients 1, -1 and 0 the sign is exact, as above.
float Clipper::distance_single(const Plane& plane, const ClipVertex& v) noexcept {
    float d = v.x * static_cast<float>(plane.x);
    d = d + v.y * static_cast<float>(plane.y);
    d = d + v.z * static_cast<float>(plane.z);
    return d + v.w * static_cast<float>(plane.w);
}

std::uint32_t Clipper::outside_planes(const ClipVertex& v) const noexcept {
    std::uint32_t mask = 0;
    for (int i = 1; is_single_ && i < count_; ++i)
        mask |= (distance_single(plane_[static_cast<std::size_t>(i)], v) < 0.0f ? 1u : 0u) << i;
    if (is_single_) return mask | (v.w < least_w ? 1u : 0u);
    for (int i = 0; i < count_; ++i) mask |= (distance(plane_[static_cast<std::size_t>(i)], v) < 0.0 ? 1u : 0u) << i;
    return mask;
}

// Always from the inside end to the outside end, so that both triangles of a shared side get the same bits (coverage.md
// 2.4).
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
    switch (plane.kind) {  // the value that is exact on the plane: window z of the corner is n or f
        case Kind::w: v.w = least_w; break;
        case Kind::z_is_minus_w: v.z = -v.w; break;
        case Kind::z_is_zero: v.z = 0.0f; break;
        case Kind::z_is_w: v.z = v.w; break;
        case Kind::other: break;
    }
    return v;
}

namespace {

// Appends corner i of `from` to `to`. Returns its index there.
std::size_t append(const ClipPolygon& from, std::size_t i, ClipPolygon& to) noexcept {
    const auto n = static_cast<std::size_t>(to.count++);
    to.corner[n] = from.corner[i];
    to.is_new[n] = from.is_new[i];
    std::copy_n(from.extra[i].begin(), from.extra_count, to.extra[n].begin());
    return n;
}

// from + t (other - from), each operation rounded to binary32.
[[nodiscard]] float step(float from, float other, float t) noexcept {
    const float difference = other - from, product = t * difference;
    return from + product;
}

// Applies `value` to each pair of components of two vertices.
template <class Value>
[[nodiscard]] ClipVertex each(const ClipVertex& first, const ClipVertex& second, const Value& value) noexcept {
    static_assert(sizeof(ClipVertex) == 14 * sizeof(float));
    using Floats = std::array<float, 14>;
    auto values = std::bit_cast<Floats>(first);
    const auto others = std::bit_cast<Floats>(second);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(values[i], others[i]);
    return std::bit_cast<ClipVertex>(values);
}

// (d_out in - d_in out) times the reciprocal, each operation rounded to binary32.
struct FromInside {
    float d_in, d_out, reciprocal;

    [[nodiscard]] float operator()(float in, float out) const noexcept {
        const float inner = d_out * in, outer = d_in * out;
        return (inner - outer) * reciprocal;
    }
};

}  // namespace

// One step of Sutherland and Hodgman. A corner on the plane is kept and does not create a second corner there
// (coverage.md 2.5).
void Clipper::clip_against(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept {
    to.count = 0;
    to.extra_count = from.extra_count;
    const auto cross = [&](std::size_t in, double d_in, std::size_t out, double d_out) {
        const std::size_t n = append(from, in, to);
        to.corner[n] = crossing(plane, from.corner[in], d_in, from.corner[out], d_out);
        to.is_new[n] = true;
        for (std::size_t e = 0; e < from.extra_count; ++e)
            to.extra[n][e] = mix(from.extra[in][e], from.extra[out][e], d_in / (d_in - d_out));
    };
    for (int i = 0; i < from.count; ++i) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(i + 1 == from.count ? 0 : i + 1);
        const double da = distance(plane, from.corner[a]), db = distance(plane, from.corner[b]);
        if (da >= 0.0) append(from, a, to);
        if (da >= 0.0 && db < 0.0 && da > 0.0) cross(a, da, b, db);
        if (da < 0.0 && db > 0.0) cross(b, db, a, da);
    }
}

// Here a corner on the plane does create a second corner at the same point, and the new corner is computed from the end
// that is nearer to the plane (coverage.md 2.8).
void Clipper::clip_single(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept {
    to.count = 0;
    to.extra_count = from.extra_count;
    const auto cross = [&](std::size_t start, std::size_t other, float t) {
        const std::size_t n = append(from, start, to);
        to.corner[n] = each(from.corner[start], from.corner[other], [t](float a, float b) { return step(a, b, t); });
        to.is_new[n] = true;
        for (std::size_t e = 0; e < from.extra_count; ++e)
            to.extra[n][e] = step(from.extra[start][e], from.extra[other][e], t);
    };
    for (int i = 0; i < from.count; ++i) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(i + 1 == from.count ? 0 : i + 1);
        const float da = distance_single(plane, from.corner[a]), db = distance_single(plane, from.corner[b]);
        const bool leaves = da >= 0.0f && db < 0.0f, enters = da < 0.0f && db >= 0.0f;
        if (da >= 0.0f) append(from, a, to);
        if (!leaves && !enters) continue;
        const float difference = db - da;
        const bool starts_at_b = leaves ? -db < da : !(-da < db);
        if (starts_at_b)
            cross(b, a, db / difference);
        else
            cross(a, b, -da / difference);
    }
}

// A corner on the plane creates a second corner at the same point on the way out, and none on the way in (coverage.md
// 2.8).
void Clipper::clip_depth_first(const Plane& plane, const ClipPolygon& from, ClipPolygon& to) noexcept {
    to.count = 0;
    to.extra_count = from.extra_count;
    const auto cross = [&](std::size_t in, float d_in, std::size_t out, float d_out) {
        const std::size_t n = append(from, in, to);
        const FromInside value{d_in, d_out, 1.0f / (d_out - d_in)};
        to.corner[n] = each(from.corner[in], from.corner[out], value);
        to.is_new[n] = true;
        for (std::size_t e = 0; e < from.extra_count; ++e)
            to.extra[n][e] = value(from.extra[in][e], from.extra[out][e]);
    };
    for (int i = 0; i < from.count; ++i) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(i + 1 == from.count ? 0 : i + 1);
        const float da = distance_single(plane, from.corner[a]), db = distance_single(plane, from.corner[b]);
        if (da >= 0.0f) append(from, a, to);
        if (da >= 0.0f && db < 0.0f) cross(a, da, b, db);
        if (da < 0.0f && db > 0.0f) cross(b, db, a, da);
    }
}

// Elsewhere a line is a polygon of two corners: clipping walks it there and back, and the first two corners of the
// result are the ends of what is left.
bool Clipper::clip_line(ClipPolygon& line, std::uint32_t planes) const noexcept {
    line.count = 2;
    if (is_single_ && !is_depth_first_) return clip_line_single(line, planes);
    clip(line, planes);
    return line.count >= 3;
}

bool Clipper::clip_line_single(ClipPolygon& line, std::uint32_t planes) const noexcept {
    std::array<float, 2> t{};  // from each end
    for (int i = 1; i < count_; ++i) {
        if ((planes >> i & 1u) == 0) continue;
        const Plane& plane = plane_[static_cast<std::size_t>(i)];
        const float da = distance_single(plane, line.corner[0]), db = distance_single(plane, line.corner[1]);
        if (db < 0.0f) t[1] = std::max(t[1], db / (db - da));
        if (da < 0.0f) t[0] = std::max(t[0], da / (da - db));
        if (t[0] + t[1] >= 1.0f) return false;
    }
    const ClipPolygon given = line;
    for (std::size_t end = 0; end < 2; ++end) {
        if (t[end] == 0.0f) continue;
        const std::size_t other = 1 - end;
        const float by = t[end];
        line.corner[end] =
            each(given.corner[end], given.corner[other], [by](float a, float b) { return step(a, b, by); });
        line.is_new[end] = true;
        for (std::size_t e = 0; e < given.extra_count; ++e)
            line.extra[end][e] = step(given.extra[end][e], given.extra[other][e], by);
    }
    return true;
}

void Clipper::clip(ClipPolygon& polygon, std::uint32_t planes) const noexcept {
    ClipPolygon other;
    // The view volume has no w plane: inside its x planes w is never negative.
    for (int i = is_single_ ? 1 : 0; i < count_; ++i) {
        if ((planes >> i & 1u) == 0) continue;
        const Plane& plane = plane_[static_cast<std::size_t>(i)];
        if (is_depth_first_)
            clip_depth_first(plane, polygon, other);
        else if (is_single_)
            clip_single(plane, polygon, other);
        else
            clip_against(plane, polygon, other);
        polygon = other;
        if (polygon.count < 3) break;
    }
}

}  // namespace strata::rasterizer
