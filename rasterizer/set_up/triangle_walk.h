// rasterizer/set_up/triangle_walk.h - visits the triangles of a region, a group at a time, and finds the spans of a
// large one: the beginning of every walk over a region. Tests: tests/rasterizer/walk/tile_rasterizer_test.cpp,
// rows_test.cpp
#pragma once
#include <algorithm>
#include <span>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

inline constexpr int max_span_rows = 128;  // rows whose spans are found at a time

// The rules of `geometry` for its triangles in `region`: clipped by viewport and scissor.
[[nodiscard]] inline GroupRules group_rules(const Geometry& geometry, const Rect& region) noexcept {
    GroupRules rules{intersection(region, geometry.state.viewport), geometry.rules.subpixel_bits,
                     geometry.rules.tie_rule};
    if (geometry.state.scissor) rules.clip = intersection(rules.clip, *geometry.state.scissor);
    return rules;
}

// The half-planes of a line or smooth polygon; those of a point exclude nothing.
[[nodiscard]] inline ShapeCoverage shape_coverage(const Geometry& geometry, const TriangleRecord& record) noexcept {
    if (record.shape() == Shape::polygon) return polygon_coverage(geometry.points(record), geometry.rules);
    if (record.shape() != Shape::line) return {};
    const auto& [first, a, b] = record.vertex;
    return line_coverage(geometry.corners[a], geometry.corners[b], geometry.state, geometry.rules);
}
// True if the fragments of a record are those with a covered sample, and their alpha is the samples' share.
[[nodiscard]] inline bool is_smooth(const Geometry& geometry, Shape shape) noexcept {
    return shape == Shape::polygon || (shape == Shape::line && geometry.state.line_style == LineStyle::smooth);
}

// Sets up `triangles` (indices into geometry.triangles; at least one, at most a group's size) in `group`.
inline void set_up_group(const Geometry& geometry, const GroupRules& rules, const SmallKernels& kernels,
                         std::span<const std::uint32_t> triangles, TriangleGroup& group) {
    const auto vertices = [&](std::size_t k) -> const auto& { return geometry.triangles[triangles[k]].vertex; };
    load_corners(geometry.corners, triangles.size(), vertices, group);
    kernels.set_up(rules, group);
}

// Calls visit(part) for `triangles`, group after group. Prefetches the triangles and corners of the next groups, and
// the colours of the corners if `have_colors`.
template <class Visit>
void for_each_group(const Geometry& geometry, std::span<const std::uint32_t> triangles, const Visit& visit,
                    bool have_colors = false) {
    constexpr std::size_t size = TriangleGroup::size;
    const auto part = [&](std::size_t at) {
        const auto rest = triangles.subspan(std::min(at, triangles.size()));
        return rest.first(std::min(size, rest.size()));
    };
    for (std::size_t at = 0; at < triangles.size(); at += size) {
        // Records are prefetched two groups ahead, corners one group ahead, when their records have arrived.
        for (const std::uint32_t t : part(at + 2 * size)) __builtin_prefetch(&geometry.triangles[t]);
        for (const std::uint32_t t : part(at + size))
            for (const std::uint32_t v : geometry.triangles[t].vertex) {
                __builtin_prefetch(&geometry.corners[v]);
                if (have_colors) __builtin_prefetch(&geometry.vertices[v].front);
            }
        visit(part(at));
    }
}

// True if every pixel of `box` is covered: tests each edge at the pixel centre where its value is least.
[[nodiscard]] inline bool covers(const TriangleEdges& edges, const Rect& box, int subpixel_bits) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = edges.edge(i);
        const int x = edge.step_x() > 0 ? box.x0 : box.x1 - 1;
        const int y = edge.step_y() > 0 ? box.y0 : box.y1 - 1;
        if (edge.at(pixel_centre(x, y, subpixel_bits)) < edges.tie(i)) return false;
    }
    return true;
}

// Finds the covered span of each of `rows`; at most max_span_rows rows.
inline void find_spans(const TriangleEdges& edges, const Rect& rows, int subpixel_bits, RowSpan* spans) noexcept {
    RowSpan* const end = spans + rows.height();
    if (covers(edges, rows, subpixel_bits)) return std::fill(spans, end, RowSpan{rows.x0, rows.x1});
    RowWalker walker{edges, rows, subpixel_bits};
    for (RowSpan* row = spans; row != end; ++row, walker.next_row()) {
        const PixelSpan span = walker.span();
        *row = {span.x0, span.x1};
    }
}

}  // namespace strata::rasterizer
