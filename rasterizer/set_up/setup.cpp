// rasterizer/set_up/setup.cpp - the steps of setup.h for one vertex, one triangle, or a group of triangles.
#include "rasterizer/set_up/setup.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/set_up/polygon_offset.h"
#include "rasterizer/set_up/stepped_offset.h"

namespace strata::rasterizer {
namespace {

// An exponent of all ones is an infinity or a NaN.
template <std::size_t n>
[[nodiscard]] bool all_finite(const std::array<float, n>& values) noexcept {
    constexpr std::uint32_t exponent = 0x7f800000;
    std::uint32_t found = 0;
    for (const std::uint32_t bits : std::bit_cast<std::array<std::uint32_t, n>>(values))
        found |= (bits & exponent) == exponent ? 1u : 0u;
    return found == 0;
}

[[nodiscard]] bool is_finite(const ClipVertex& v) noexcept {
    static_assert(sizeof(ClipVertex) == 14 * sizeof(float));
    return all_finite(std::bit_cast<std::array<float, 14>>(v));
}

template <std::size_t n>
[[nodiscard]] bool products_finite(std::array<float, n> values, float factor) noexcept {
    for (float& value : values) value *= factor;
    return all_finite(values);
}

constexpr std::uint8_t all_corners = 7;

// The sign of a piece's area (0 if it covers nothing), the box of pixels that it may cover, and whether it is known to
// cover none of them.
struct PieceShape {
    std::int64_t area_sign;
    Rect box;
    bool is_uncovered = false;
};

[[nodiscard]] PieceShape shape_of(const std::array<const WindowCorner*, 3>& corner, const RasterRules& rules,
                                  const Rect& viewport) noexcept {
    const auto& [a, b, c] = corner;
    const std::array p{a->p, b->p, c->p};
    if (rules.coverage == CoverageRule::snapped_edges)
        return {Edge{p[0], p[1]}.at(p[2]), centre_box(p, rules.subpixel_bits)};
    const std::array position{a->unsnapped, b->unsnapped, c->unsnapped};
    const FloatSpans spans{position};
    if (!spans.is_drawn()) return {0, {}};
    const int sign = float_area(position) > 0.0f ? 1 : -1;  // triangles that are drawn have an area
    const Rect box = intersection(float_box(position), viewport);
    if (box.area() == 0 || std::max(box.width(), box.height()) > seen_size) return {sign, box};
    const Rect covered = covered_box(spans, box);
    return covered.area() > 0 ? PieceShape{sign, covered} : PieceShape{sign, box, true};
}

}  // namespace

TriangleSetup::TriangleSetup(const RasterState& state, const RasterRules& rules, std::span<const ClipVertex> vertices,
                             const VertexExtras& extras)
    : state_{state},
      rules_{rules},
      clipper_{state, rules},
      window_{state, rules},
      plain_rules_{window_.plain_rules(state.clip_depth)},
      set_up_plain_{clipper_.holds_view_volume() && plain_rules_ ? rasterizer::set_up_plain() : nullptr},
      needs_scalar_setup_{rules.area_sign == AreaSign::single || rules.plane_corners == PlaneCorners::given},
      set_up_plain_triangles_{state.polygon_offset.enabled || state.window_positions || needs_scalar_setup_ ||
                                      state.smooth_polygons
                                  ? nullptr
                              : rules.coverage == CoverageRule::snapped_edges ? rasterizer::set_up_plain_triangles()
                                                                              : rasterizer::set_up_plain_spans()},
      vertices_{vertices},
      extras_{extras},
      corners_(vertices.size()),
      marks_(vertices.size()) {}

bool TriangleSetup::extras_finite(const float* extras, float inverse_w) const noexcept {
    // NV2A defines the fog of an infinite coordinate and of NaN (pipeline/reference/fog-and-lighting.md 2.4).
    const auto may_be_infinite = [&](std::size_t e) {
        return extras_.has_fog && e == extras_.fog_place() &&
               rules_.interpolation.texture_coordinates == CoordinateRule::cut_weights;
    };
    for (std::size_t e = 0; e < extras_.stride; ++e)
        if (!products_finite(std::array{extras[e]}, inverse_w) && !may_be_infinite(e)) return false;
    return true;
}

// Projects a vertex that is inside all planes and returns its marks. A position that overflows drops its triangles; a
// colour that overflows drops only those that show its side.
VertexMarks TriangleSetup::project(const ClipVertex& v, const float* extras, VertexOrigin origin,
                                   WindowCorner& corner) const noexcept {
    const WindowVertex w = window_.project(v, origin);
    if (!all_finite(std::array{w.x, w.y, w.z, w.inverse_w}) || !products_finite(v.texcoord, w.inverse_w))
        return marks_window;
    if (!extras_finite(extras, w.inverse_w)) return marks_window;
    corner = {window_.snapped(w), window_.position(w), w.z, w.inverse_w};
    return (products_finite(v.front, w.inverse_w) ? 0u : marks_front) |
           (products_finite(v.back, w.inverse_w) ? 0u : marks_back);
}

void TriangleSetup::set_up_vertex(std::size_t i) noexcept {
    const ClipVertex& v = vertices_[i];
    corners_[i] = {};
    VertexMarks marks = is_finite(v) ? clipper_.outside(v) : marks_input;
    if (marks == 0) marks = project(v, extras_of(i), VertexOrigin::given, corners_[i]);
    marks_[i] = marks;
}

// Sixteen at a time by the kernel; vertices that are not plain, and the rest, one by one with the same bits.
void TriangleSetup::set_up_vertices(std::size_t begin, std::size_t end) noexcept {
    std::size_t i = begin;
    for (; set_up_plain_ != nullptr && i + plain_vertex_count <= end; i += plain_vertex_count) {
        const std::uint32_t plain = set_up_plain_(*plain_rules_, &vertices_[i], &corners_[i]);
        for (std::size_t k = 0; k < plain_vertex_count; ++k)
            if ((plain >> k & 1u) != 0 && extras_finite(extras_of(i + k), corners_[i + k].inverse_w)) {
                marks_[i + k] = 0;
                if (window_.is_moved()) corners_[i + k].p = window_.at_sample(corners_[i + k].p);
            } else {
                set_up_vertex(i + k);
            }
    }
    for (; i < end; ++i) set_up_vertex(i);
}

void TriangleSetup::find_marked() noexcept {
    VertexMarks all = 0;
    for (const VertexMarks marks : marks_) all |= marks;
    any_marked_ = all != 0;
}

// A positive area is clockwise in memory orientation, rows downwards. With y up the window shows the same image.
bool TriangleSetup::is_front(std::int64_t area, bool mirrored) const noexcept {
    const bool clockwise = (area > 0) == (state_.y_direction == YDirection::up);
    return (clockwise == (state_.front_face == FrontFace::clockwise)) != mirrored;
}

// The order of the tests decides which fate is counted.
TriangleSetup::Fate TriangleSetup::add_piece(const Piece& piece, const SourceTriangle& triangle,
                                             SetupChunk& out) const {
    const auto& [a, b, c] = piece.corner;
    if ((piece.marks & marks_window) != 0) return Fate::non_finite;
    PieceShape shape = shape_of({a, b, c}, rules_, state_.viewport);
    bool front = is_front(shape.area_sign, triangle.run->mirrored);
    if (rules_.area_sign == AreaSign::single && rules_.coverage == CoverageRule::snapped_edges &&
        !state_.window_positions) {
        // A piece whose winding differs from that of its triangle has left and right exchanged: it covers nothing.
        const int turn = single_turn(triangle);
        front = turn == 0 ? !triangle.run->mirrored : is_front(turn, triangle.run->mirrored);
        // A sum of 0 draws what is clockwise in the device's rows.
        const bool is_clockwise = turn == 0 ? !window_.is_turned() : turn > 0;
        if (is_clockwise != (shape.area_sign > 0)) shape.area_sign = 0;
    }
    if ((piece.marks & (front ? marks_front : marks_back)) != 0) return Fate::non_finite;
    if (shape.area_sign == 0) return Fate::degenerate;
    if (!triangle.run->double_sided && is_culled(front)) return Fate::culled;
    const std::uint8_t negative = negative_w(piece.corner);
    if (state_.smooth_polygons) shape.box = polygon_coverage({a->p, b->p, c->p}, rules_).box;
    if (state_.smooth_polygons && negative != 0) return Fate::outside;  // assumed
    // A triangle that extends through infinity may cover any pixel of the window; a triangle completely behind the eye
    // covers none.
    const Rect box = intersection(negative == 0 ? shape.box : state_.viewport, state_.viewport);
    if (box.area() == 0 || negative == all_corners || is_out_of_range(piece.corner)) return Fate::outside;
    if (shape.is_uncovered && negative == 0) return Fate::uncovered;
    out.triangles.push_back(
        {.vertex = piece.vertex,
         .primitive = triangle.primitive,
         .material = triangle.run->material,
         .box = in_viewport(box, state_.viewport),
         .front_facing = front,
         .special = state_.smooth_polygons ? TriangleRecord::special_of(Shape::polygon) : negative});
    if (!state_.window_positions && !state_.smooth_polygons && rules_.coverage == CoverageRule::snapped_edges &&
        !find_tiny({a->p, b->p, c->p}, box, rules_, out.triangles.back())) {
        out.triangles.pop_back();
        return Fate::uncovered;
    }
    out.triangles.back().without_offset = triangle.run->without_offset;
    if (state_.polygon_offset.enabled) out.offset_z.push_back(with_offset(piece.corner, *triangle.run));
    if (rules_.plane_corners == PlaneCorners::given) out.given.push_back(triangle.vertex);
    return Fate::kept;
}

// The sign of the area of the given corners, the last one first, computed in binary32 in memory rows; an odd number of
// negative w inverts it.
int TriangleSetup::single_turn(const SourceTriangle& triangle) const noexcept {
    std::array<float, 3> x{}, y{};
    bool is_negative = window_.is_turned();
    for (std::size_t i = 0; i < 3; ++i) {
        const ClipVertex& v = vertices_[triangle.vertex[(i + 2) % 3]];
        const SubpixelPoint p = window_.from_first_centre(v);
        x[i] = static_cast<float>(p.x);
        y[i] = static_cast<float>(p.y);
        is_negative ^= v.w < 0.0f;
    }
    const float first = (y[0] - y[2]) * x[1], second = (y[2] - y[1]) * x[0], third = (y[1] - y[0]) * x[2];
    const float area = (first + second) + third;
    const int turn = area < 0.0f ? 1 : area > 0.0f ? -1 : 0;
    return is_negative ? -turn : turn;
}

// Window z of the corners plus polygon offset: an exact sum, or with the roundings of stepped planes
// (rasterizer/reference/coverage.md 9.4).
std::array<double, 3> TriangleSetup::with_offset(const std::array<const WindowCorner*, 3>& corner,
                                                 const TriangleRun& run) const noexcept {
    const auto& [a, b, c] = corner;
    const std::array p{a->p, b->p, c->p};
    const std::array z{a->z, b->z, c->z};
    if (run.without_offset) return {z[0], z[1], z[2]};
    if (rules_.plane_rule == PlaneRule::exact) {
        const double offset = polygon_offset(p, z, state_, rules_);
        return {z[0] + offset, z[1] + offset, z[2] + offset};
    }
    // An offset of zero must not clamp z.
    if (state_.polygon_offset.factor == 0.0f && state_.polygon_offset.units == 0.0f) return {z[0], z[1], z[2]};
    const float offset = stepped_offset(corner, state_, rules_);
    std::array<double, 3> moved{};
    for (std::size_t i = 0; i < 3; ++i)
        moved[i] = offsets_planes(state_, rules_)
                       ? double{z[i]} + double{offset}
                       : std::clamp(z[i] + offset, 0.0f, static_cast<float>(z_units(state_, rules_)));
    return moved;
}

// Bit i is set if w of corner i is negative. Clipping leaves none in clip space (clip.h).
std::uint8_t TriangleSetup::negative_w(const std::array<const WindowCorner*, 3>& corner) const noexcept {
    std::uint8_t negative = 0;
    for (std::size_t i = 0; i < 3 && state_.window_positions && rules_.w_signs == WSigns::by_corner; ++i)
        if (corner[i]->inverse_w < 0.0f) negative |= static_cast<std::uint8_t>(1u << i);
    return negative;
}

// Tests only z, with a w buffer too (coverage.md 6.4).
bool TriangleSetup::is_out_of_range(const std::array<const WindowCorner*, 3>& corner) const noexcept {
    if (!state_.range_culls_triangles) return false;
    const double units = z_units(state_, rules_);
    const double near = range_limit(state_.depth_near) * units, far = range_limit(state_.depth_far) * units;
    const auto all = [&](auto is_outside) {
        return is_outside(corner[0]->z) && is_outside(corner[1]->z) && is_outside(corner[2]->z);
    };
    return all([&](float z) { return z < std::min(near, far); }) ||
           all([&](float z) { return z > std::max(near, far); });
}

TriangleSetup::Fate TriangleSetup::add_small(const SourceTriangle& triangle, const TriangleGroup& group, std::size_t k,
                                             SetupChunk& out) const {
    if (group.area[k] == 0) return Fate::degenerate;
    const bool front = is_front(group.turned[k] == 0 ? 1 : -1, triangle.run->mirrored);
    if (!triangle.run->double_sided && is_culled(front)) return Fate::culled;
    if (group.width[k] == 0 || group.height[k] == 0) return Fate::outside;
    const PixelBox box = in_viewport(group.box(k), state_.viewport);
    out.triangles.push_back({triangle.vertex, triangle.primitive, triangle.run->material, box, front});
    const auto& [a, b, c] = triangle.vertex;
    if (find_tiny({corners_[a].p, corners_[b].p, corners_[c].p}, group.box(k), rules_, out.triangles.back()))
        return Fate::kept;
    out.triangles.pop_back();
    return Fate::uncovered;
}

ClipPolygon TriangleSetup::polygon(const SourceTriangle& triangle) const noexcept {
    ClipPolygon polygon{{}, 3, extras_.stride, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        polygon.corner[i] = vertices_[triangle.vertex[i]];
        if (extras_.stride > 0) std::copy_n(extras_.of(triangle.vertex[i]), extras_.stride, polygon.extra[i].begin());
    }
    return polygon;
}

// A clipped triangle is counted once: as kept if any piece is, else by the fate of its first piece.
TriangleSetup::Fate TriangleSetup::add_clipped(const SourceTriangle& triangle, std::uint32_t planes,
                                               SetupChunk& out) const {
    ClipPolygon cut = polygon(triangle);
    clipper_.clip(cut, planes);
    if (cut.count < 3) return Fate::outside;
    const auto count = static_cast<std::size_t>(cut.count);
    const auto first = static_cast<std::uint32_t>(vertices_.size() + out.vertices.size());
    std::array<WindowCorner, std::tuple_size_v<decltype(cut.corner)>> corner;
    std::array<VertexMarks, corner.size()> marks;
    for (std::size_t i = 0; i < count; ++i) {
        const VertexOrigin origin = cut.is_new[i] ? VertexOrigin::made_by_clip : VertexOrigin::given;
        marks[i] = project(cut.corner[i], cut.extra[i].data(), origin, corner[i]);
    }
    Fate fate = Fate::outside;
    bool any_kept = false;
    for (std::size_t i = 2; i < count; ++i) {
        const auto last = first + static_cast<std::uint32_t>(i);
        Piece fan{
            {first, last - 1, last}, {&corner[0], &corner[i - 1], &corner[i]}, marks[0] | marks[i - 1] | marks[i]};
        // The view volume's fan has its common corner last (coverage.md 2.8).
        if (rules_.clip == ClipVolume::view_volume) {
            std::rotate(fan.vertex.begin(), fan.vertex.begin() + 1, fan.vertex.end());
            std::rotate(fan.corner.begin(), fan.corner.begin() + 1, fan.corner.end());
        }
        const Fate piece = add_piece(fan, triangle, out);
        any_kept |= piece == Fate::kept;
        if (i == 2 || piece == Fate::kept) fate = piece;
    }
    if (any_kept) {
        out.vertices.insert(out.vertices.end(), cut.corner.begin(), cut.corner.begin() + cut.count);
        out.corners.insert(out.corners.end(), corner.begin(), corner.begin() + cut.count);
        for (std::size_t i = 0; i < count; ++i)
            out.extras.insert(out.extras.end(), cut.extra[i].data(), cut.extra[i].data() + extras_.stride);
    }
    return fate;
}

// If all three vertices are outside the same plane, the triangle is outside. Otherwise it is clipped only against the
// planes that some vertex is outside of.
void TriangleSetup::add(const SourceTriangle& triangle, SetupChunk& out) const {
    if (triangle.run->primitive != Primitive::triangles) return count(add_shape(triangle, out), triangle, out.counters);
    const auto& [a, b, c] = triangle.vertex;
    const VertexMarks any = marks_[a] | marks_[b] | marks_[c], crossed = any & marks_planes;
    Fate fate = Fate::non_finite;
    if ((any & marks_input) == 0) {
        const bool dropped_by_w = rules_.w_clip == WClip::drop && (crossed & 1u) != 0;
        if ((marks_[a] & marks_[b] & marks_[c] & marks_planes) != 0 || dropped_by_w) {
            fate = Fate::outside;
        } else if (crossed == 0) {
            fate = add_piece({triangle.vertex, {&corners_[a], &corners_[b], &corners_[c]}, any}, triangle, out);
        } else {
            fate = add_clipped(triangle, crossed, out);
            if (fate != Fate::outside) ++out.counters.clipped;
        }
    }
    count(fate, triangle, out.counters);
}

// Boxes and areas are computed for a whole group at once. Marked triangles, those with an offset and those with window
// positions (whose w may be negative) take the general path.
void TriangleSetup::add(std::span<const SourceTriangle> triangles, SetupChunk& out) const {
    TriangleGroup group;
    load_corners(
        corners_, triangles.size(), [&](std::size_t k) -> const auto& { return triangles[k].vertex; }, group);
    small_kernels().set_up_boxes({state_.viewport, rules_.subpixel_bits, rules_.tie_rule}, group);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const auto& [a, b, c] = triangles[k].vertex;
        const bool is_plain = (marks_[a] | marks_[b] | marks_[c]) == 0 && !state_.polygon_offset.enabled &&
                              !state_.window_positions && !needs_scalar_setup_ && !state_.smooth_polygons &&
                              triangles[k].run->primitive == Primitive::triangles;
        if (is_plain && group.small[k] != 0 && rules_.coverage == CoverageRule::snapped_edges)
            count(add_small(triangles[k], group, k, out), triangles[k], out.counters);
        else
            add(triangles[k], out);
    }
}

std::size_t TriangleSetup::add_plain(const std::uint32_t* indices, std::uint32_t primitive, std::size_t groups,
                                     const TriangleRun& run, SetupChunk& out) const {
    if (set_up_plain_triangles_ == nullptr) return 0;
    constexpr std::size_t size = TriangleGroup::size;
    const Rect& viewport = state_.viewport;
    const PlainTriangleRules rules{.group = {viewport, rules_.subpixel_bits, rules_.tie_rule},
                                   .x0 = viewport.x0,
                                   .y0 = viewport.y0,
                                   .material = run.material,
                                   .first_vertex = first_vertex(run),
                                   .positive_is_front = is_front(1, run.mirrored),
                                   .drops_front = !run.double_sided && is_culled(true),
                                   .drops_back = !run.double_sided && is_culled(false)};
    const VertexMarks* const marks = any_marked_ ? marks_.data() + rules.first_vertex : nullptr;
    const auto corners = std::span{corners_}.subspan(rules.first_vertex);
    const std::size_t before = out.triangles.size();
    PlainFates fates;
    out.triangles.resize(before + groups * size);
    std::size_t done = 0;
    while (done < groups && set_up_plain_triangles_(rules, indices + 3 * size * done,
                                                    primitive + static_cast<std::uint32_t>(size * done), corners, marks,
                                                    &out.triangles[before + fates.kept], fates))
        ++done;
    out.triangles.resize(before + fates.kept);
    out.counters.triangles_in += size * done;
    out.counters.culled += fates.culled;
    out.counters.outside += fates.outside;
    out.counters.degenerate += fates.degenerate;
    out.counters.uncovered += fates.uncovered;
    return done;
}

void TriangleSetup::count(Fate fate, const SourceTriangle& triangle, SetupCounters& counters) noexcept {
    ++counters.triangles_in;
    switch (fate) {
        case Fate::kept: break;
        case Fate::culled: ++counters.culled; break;
        case Fate::outside: ++counters.outside; break;
        case Fate::degenerate: ++counters.degenerate; break;
        case Fate::uncovered: ++counters.uncovered; break;
        case Fate::non_finite:
            if (counters.non_finite++ == 0) counters.first_non_finite = triangle.number;
            break;
    }
}

}  // namespace strata::rasterizer
