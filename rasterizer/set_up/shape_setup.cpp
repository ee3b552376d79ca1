// rasterizer/set_up/shape_setup.cpp - lines and points of setup.h: facing, clipping, and the record with its box of
// pixels.
//
// Rule     A line or point faces front and is never culled; one that draws a part of a polygon has the polygon's facing
//          and is culled with it. Polygon offset does not move it. A line is cut as a triangle's side is; a point
//          outside a plane is dropped. A w that is negative in window positions drops it (assumed).
// Source   rasterizer/reference/lines-and-points.md 1.
// Tests    tests/rasterizer/set_up/shape_setup_test.cpp
#include <algorithm>

#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/coverage/pixel_steps.h"
#include "rasterizer/set_up/setup.h"

namespace strata::rasterizer {

// The two ends of a line, or a point twice.
struct TriangleSetup::Ends {
    std::array<std::uint32_t, 2> vertex;
    std::array<const WindowCorner*, 2> corner;
    VertexMarks marks;
};

// Empty if the polygon is culled. A polygon without area counts as counterclockwise (chip-geometry.md 5.2).
std::optional<bool> TriangleSetup::polygon_faces_front(const SourceTriangle& source) const {
    const auto& [a, b, c] = source.vertex;
    const VertexMarks crossed = (marks_[a] | marks_[b] | marks_[c]) & marks_planes;
    std::array<SubpixelPoint, 3> p{corners_[a].p, corners_[b].p, corners_[c].p};
    if (crossed != 0) {
        ClipPolygon cut = polygon(source);
        clipper_.clip(cut, crossed);
        if (cut.count < 3) return std::nullopt;
        for (std::size_t i = 0; i < 3; ++i) {
            WindowCorner corner;
            static_cast<void>(project(cut.corner[i], cut.extra[i].data(), VertexOrigin::made_by_clip, corner));
            p[i] = corner.p;
        }
    }
    const std::int64_t area = Edge{p[0], p[1]}.at(p[2]),
                       counterclockwise = state_.y_direction == YDirection::up ? -1 : 1;
    const bool front = is_front(area == 0 ? counterclockwise : area, source.run->mirrored);
    return !source.run->double_sided && is_culled(front) ? std::nullopt : std::optional{front};
}

TriangleSetup::Fate TriangleSetup::add_shape(const SourceTriangle& source, SetupChunk& out) const {
    const Primitive primitive = source.run->primitive;
    const bool has_polygon = is_of_polygon(primitive);
    const auto& [first, a, b] = source.vertex;
    const VertexMarks all = marks_[a] | marks_[b] | (has_polygon ? marks_[first] : 0);
    if ((all & (marks_input | marks_window)) != 0) return Fate::non_finite;
    bool front = true;
    if (has_polygon) {
        if ((marks_[first] & marks_[a] & marks_[b] & marks_planes) != 0) return Fate::outside;
        const std::optional<bool> facing = polygon_faces_front(source);
        if (!facing) return Fate::culled;
        front = *facing;
    }
    if (shape_of(primitive) == Shape::line) return add_line(source, front, out);
    if ((marks_[b] & marks_planes) != 0) return Fate::outside;
    return add_ends(source, {{b, b}, {&corners_[b], &corners_[b]}, marks_[b]}, front, out);
}

TriangleSetup::Fate TriangleSetup::add_line(const SourceTriangle& source, bool front, SetupChunk& out) const {
    const std::uint32_t a = source.vertex[1], b = source.vertex[2];
    const VertexMarks crossed = (marks_[a] | marks_[b]) & marks_planes;
    if (crossed == 0)
        return add_ends(source, {{a, b}, {&corners_[a], &corners_[b]}, marks_[a] | marks_[b]}, front, out);
    if ((marks_[a] & marks_[b] & marks_planes) != 0) return Fate::outside;
    SourceTriangle side = source;
    side.vertex = {a, b, b};
    ClipPolygon cut = polygon(side);
    if (!clipper_.clip_line(cut, crossed)) return Fate::outside;
    std::array<WindowCorner, 2> corner;
    VertexMarks marks = 0;
    for (std::size_t i = 0; i < 2; ++i)
        marks |= project(cut.corner[i], cut.extra[i].data(),
                         cut.is_new[i] ? VertexOrigin::made_by_clip : VertexOrigin::given, corner[i]);
    const auto next = static_cast<std::uint32_t>(vertices_.size() + out.vertices.size());
    for (std::size_t i = 0; i < 2; ++i) {
        out.vertices.push_back(cut.corner[i]);
        out.corners.push_back(corner[i]);
        out.extras.insert(out.extras.end(), cut.extra[i].data(), cut.extra[i].data() + extras_.stride);
    }
    const Fate fate = add_ends(source, {{next, next + 1}, {&corner[0], &corner[1]}, marks}, front, out);
    out.counters.clipped += fate != Fate::outside;
    if (fate == Fate::kept) return fate;
    out.vertices.resize(out.vertices.size() - 2);
    out.corners.resize(out.corners.size() - 2);
    out.extras.resize(out.extras.size() - 2 * extras_.stride);
    return fate;
}

TriangleSetup::Fate TriangleSetup::add_ends(const SourceTriangle& source, const Ends& ends, bool front,
                                            SetupChunk& out) const {
    const auto& [a, b] = ends.corner;
    if ((ends.marks & marks_window) != 0 || (ends.marks & (front ? marks_front : marks_back)) != 0)
        return Fate::non_finite;
    const Shape shape = shape_of(source.run->primitive);
    if (is_drawn_by_triangles(shape, state_, rules_)) return add_quad(source, ends, front, out);
    const Rect all = shape == Shape::line ? line_coverage(*a, *b, state_, rules_).box : point_box(*b, state_, rules_);
    if (all.area() == 0) return Fate::degenerate;
    const Rect box = intersection(all, state_.viewport);
    const std::array corners{a, a, b};
    if (box.area() == 0 || negative_w(corners) != 0 || is_out_of_range(corners)) return Fate::outside;
    out.triangles.push_back({.vertex = {ends.vertex[0], ends.vertex[0], ends.vertex[1]},
                             .primitive = source.primitive,
                             .material = source.run->material,
                             .box = in_viewport(box, state_.viewport),
                             .front_facing = front,
                             .special = TriangleRecord::special_of(shape)});
    if (state_.polygon_offset.enabled) out.offset_z.push_back({a->z, a->z, b->z});
    return Fate::kept;
}

// Two triangles of four new vertices, which are neither culled nor moved by polygon offset. Counted once: as kept if
// any of them is.
TriangleSetup::Fate TriangleSetup::add_quad(const SourceTriangle& source, const Ends& ends, bool front,
                                            SetupChunk& out) const {
    const bool is_point = shape_of(source.run->primitive) == Shape::point;
    const auto& [a, b] = ends.corner;
    const QuadCorners position = is_point ? point_corners(b->unsnapped, state_.point_size_px)
                                          : wide_line_corners(a->unsnapped, b->unsnapped, state_.line_width_px);
    std::array<WindowCorner, 4> corner;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        corner[i] = *ends.corner[i / 2];
        corner[i].unsnapped = position[i];
        corner[i].p = window_.snapped({position[i][0], position[i][1], corner[i].z, corner[i].inverse_w});
    }
    const auto first = static_cast<std::uint32_t>(vertices_.size() + out.vertices.size());
    TriangleRun run = *source.run;
    run.double_sided = run.without_offset = true;
    SourceTriangle side = source;
    side.run = &run;
    Fate fate = Fate::degenerate;
    bool any_kept = false;
    for (const auto& [i, k] : {std::array{2u, 3u}, std::array{3u, 1u}}) {
        const Fate piece =
            add_piece({{first, first + i, first + k}, {&corner[0], &corner[i], &corner[k]}, 0}, side, out);
        if (piece == Fate::kept) out.triangles.back().front_facing = front;
        any_kept |= piece == Fate::kept;
        if (i == 2 || piece == Fate::kept) fate = piece;
    }
    if (!any_kept) return fate;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        const std::size_t end = ends.vertex[i / 2], given = vertices_.size();
        ClipVertex vertex = end < given ? vertices_[end] : out.vertices[end - given];
        if (is_point && state_.point_sprites) vertex.texcoord = {i / 2 == 0 ? 0.0f : 1.0f, i % 2 == 0 ? 0.0f : 1.0f};
        const float* const extras = end < given ? extras_of(end) : out.extras.data() + (end - given) * extras_.stride;
        const std::vector<float> own(extras, extras + extras_.stride);
        out.vertices.push_back(vertex);
        out.corners.push_back(corner[i]);
        out.extras.insert(out.extras.end(), own.begin(), own.end());
    }
    return fate;
}

}  // namespace strata::rasterizer
