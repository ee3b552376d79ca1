#include "rasterizer/setup.h"

#include <algorithm>

#include "rasterizer/coverage.h"
#include "rasterizer/polygon_offset.h"

namespace strata::rasterizer {
namespace {

// v - v is 0 for finite v and NaN for all others; no libm needed.
[[nodiscard]] bool is_finite(float v) noexcept { return v - v == 0.0f; }

[[nodiscard]] bool is_finite(const ClipVertex& v) noexcept {
    float differences = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) + (v.w - v.w);
    for (const float c : v.front) differences += c - c;
    for (const float c : v.back) differences += c - c;
    for (const float c : v.texcoord) differences += c - c;
    return differences == 0.0f;
}

// Whether every number that the planes of a piece start from is finite.
[[nodiscard]] bool is_finite(const SetupTriangle& t) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        if (!is_finite(t.unsnapped[i][0]) || !is_finite(t.unsnapped[i][1]) || !is_finite(t.inverse_w[i])) return false;
        for (const float u : t.attribute[i])
            if (!is_finite(u * t.inverse_w[i])) return false;
    }
    return is_finite(static_cast<float>(t.z[0])) && is_finite(static_cast<float>(t.z[1])) &&
           is_finite(static_cast<float>(t.z[2]));
}

[[nodiscard]] std::array<float, attribute_count> attributes(const ClipVertex& v, bool front) noexcept {
    const std::array<float, 4>& color = front ? v.front : v.back;
    return {color[0], color[1], color[2], color[3], v.texcoord[0], v.texcoord[1]};
}

}  // namespace

TriangleSetup::TriangleSetup(const RasterState& state, const RasterRules& rules)
    : state_{state}, rules_{rules}, clipper_{state, rules}, window_{state, rules} {}

// Positive area is clockwise as memory shows it, rows downwards; with y up the window shows the same picture.
bool TriangleSetup::is_front(std::int64_t area, bool mirrored) const noexcept {
    const bool clockwise = (area > 0) == (state_.y_direction == YDirection::up);
    return (clockwise == (state_.front_face == FrontFace::clockwise)) != mirrored;
}

bool TriangleSetup::is_culled(bool front) const noexcept {
    switch (state_.cull) {
        case CullFace::none: return false;
        case CullFace::front: return front;
        case CullFace::back: return !front;
        case CullFace::front_and_back: return true;
    }
    return false;  // unreachable: the enum is closed
}

TriangleSetup::Fate TriangleSetup::add_piece(const std::array<const ClipVertex*, 3>& corner,
                                             const SourceTriangle& triangle, std::vector<SetupTriangle>& out) const {
    SetupTriangle piece;
    std::array<float, 3> z;
    for (std::size_t i = 0; i < 3; ++i) {
        const WindowVertex v = window_.project(*corner[i]);
        if (!is_finite(v.x) || !is_finite(v.y)) return Fate::non_finite;
        piece.p[i] = window_.snapped(v);
        piece.unsnapped[i] = {v.x, v.y};
        piece.z[i] = z[i] = v.z;
        piece.inverse_w[i] = v.inverse_w;
    }
    const std::int64_t area = Edge{piece.p[0], piece.p[1]}.at(piece.p[2]);
    piece.front_facing = is_front(area, triangle.run->mirrored);
    for (std::size_t i = 0; i < 3; ++i) piece.attribute[i] = attributes(*corner[i], piece.front_facing);
    if (!is_finite(piece)) return Fate::non_finite;
    if (area == 0) return Fate::degenerate;
    if (!triangle.run->double_sided && is_culled(piece.front_facing)) return Fate::culled;
    const Rect box = intersection(centre_box(piece.p, rules_.subpixel_bits), state_.viewport);
    if (box.area() == 0) return Fate::outside;
    if (state_.polygon_offset.enabled) {
        const double offset = polygon_offset(piece.p, z, state_, rules_);
        for (double& vertex_z : piece.z) vertex_z += offset;
    }
    piece.primitive = triangle.primitive;
    piece.material = triangle.run->material;
    out.push_back(piece);
    return Fate::kept;
}

// A clipped triangle is counted once: as kept if any piece is, else by the fate of its first piece.
TriangleSetup::Fate TriangleSetup::add_clipped(const SourceTriangle& triangle, std::uint32_t planes,
                                               std::vector<SetupTriangle>& out) const {
    ClipPolygon polygon{{*triangle.corner[0], *triangle.corner[1], *triangle.corner[2]}, 3};
    clipper_.clip(polygon, planes);
    if (polygon.count < 3) return Fate::outside;
    Fate fate = Fate::outside;
    for (std::size_t i = 2; i < static_cast<std::size_t>(polygon.count); ++i) {
        const Fate piece = add_piece({&polygon.corner[0], &polygon.corner[i - 1], &polygon.corner[i]}, triangle, out);
        if (i == 2 || piece == Fate::kept) fate = piece;
    }
    return fate;
}

void TriangleSetup::add(const SourceTriangle& triangle, std::vector<SetupTriangle>& out,
                        SetupCounters& counters) const {
    ++counters.triangles_in;
    const auto& [a, b, c] = triangle.corner;
    Fate fate = Fate::non_finite;
    if (is_finite(*a) && is_finite(*b) && is_finite(*c)) {
        const std::uint32_t outside_a = clipper_.outside(*a), outside_b = clipper_.outside(*b);
        const std::uint32_t outside_c = clipper_.outside(*c);
        const std::uint32_t crossed = outside_a | outside_b | outside_c;
        const bool dropped_by_w = rules_.w_clip == WClip::drop && (crossed & 1u) != 0;
        if ((outside_a & outside_b & outside_c) != 0 || dropped_by_w) {
            fate = Fate::outside;
        } else if (crossed == 0) {
            fate = add_piece(triangle.corner, triangle, out);
        } else {
            fate = add_clipped(triangle, crossed, out);
            if (fate != Fate::outside) ++counters.clipped;
        }
    }
    switch (fate) {
        case Fate::kept: break;
        case Fate::culled: ++counters.culled; break;
        case Fate::outside: ++counters.outside; break;
        case Fate::degenerate: ++counters.degenerate; break;
        case Fate::non_finite:
            if (counters.non_finite++ == 0) counters.first_non_finite = triangle.number;
            break;
    }
}

}  // namespace strata::rasterizer
