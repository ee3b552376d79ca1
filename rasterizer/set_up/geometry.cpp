// rasterizer/set_up/geometry.cpp - set_up of geometry.h: sets up vertices and triangles in parallel chunks and
// concatenates the results in submission order.
#include "rasterizer/set_up/geometry.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/parallel.h"
#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/coverage/line_stipple.h"
#include "rasterizer/set_up/check_input.h"
#include "rasterizer/set_up/setup.h"

namespace strata::rasterizer {
namespace {

// Divides vertices or triangles into chunks. The chunks depend only on the count, so no result depends on the number of
// threads (rasterizer/reference/numbers.md 2.2). A large mesh has at most 64, because each has its own memory.
class Chunks {
  public:
    explicit Chunks(std::size_t count)
        : count_{count}, size_{std::max<std::size_t>(1024, (count / 64 + 16) & ~std::size_t{15})} {}
    [[nodiscard]] std::size_t number() const noexcept { return (count_ + size_ - 1) / size_; }
    // Calls body(chunk number, begin, end) for every chunk.
    template <class Body>
    void for_each(int threads, const Body& body) const {
        parallel_for(number(), threads, [&](std::size_t c) { body(c, c * size_, std::min(count_, (c + 1) * size_)); });
    }

  private:
    std::size_t count_, size_;
};

// Looks up the triangles of a soup by their position in its list.
class Listing {
  public:
    explicit Listing(const TriangleSoup& soup) : soup_{soup} {
        for (const TriangleRun& run : soup.runs) start_.push_back(start_.back() + run.index_count / 3);
    }
    [[nodiscard]] std::size_t count() const noexcept {
        return soup_.order.empty() ? start_.back() : soup_.order.size();
    }
    [[nodiscard]] std::size_t source_count() const noexcept { return start_.back(); }

    // `run` is the index of the TriangleRun in which the previous triangle was found; the next triangle is mostly in
    // the same one.
    [[nodiscard]] SourceTriangle at(std::uint32_t primitive, std::size_t& run) const {
        const std::uint32_t number = soup_.order.empty() ? primitive : soup_.order[primitive];
        if (number < start_[run] || number >= start_[run + 1])
            run = static_cast<std::size_t>(std::ranges::upper_bound(start_, number) - start_.begin()) - 1;
        const std::uint32_t* const index = indices(number, run);
        const std::uint32_t first = first_vertex(soup_.runs[run]);
        return {{first + index[0], first + index[1], first + index[2]}, number, primitive, &soup_.runs[run]};
    }

    // The number of triangles of run `run` that are contiguous from `primitive` on in submission order, with contiguous
    // indices.
    [[nodiscard]] std::size_t side_by_side(std::size_t primitive, std::size_t run) const {
        return soup_.order.empty() && primitive >= start_[run] && primitive < start_[run + 1] &&
                       soup_.runs[run].primitive == Primitive::triangles
                   ? start_[run + 1] - primitive
                   : 0;
    }
    // The indices of triangle `number` of the list.
    [[nodiscard]] const std::uint32_t* indices(std::size_t number, std::size_t run) const {
        const TriangleRun& its = soup_.runs[run];
        return (its.lent != nullptr ? its.lent : &soup_.indices[its.first_index]) + 3 * (number - start_[run]);
    }

  private:
    const TriangleSoup& soup_;
    std::vector<std::uint32_t> start_{0};  // first triangle of each run; one entry more than there are runs
};

void add(SetupCounters& sum, const SetupCounters& part) {
    if (sum.non_finite == 0) sum.first_non_finite = part.first_non_finite;
    sum.triangles_in += part.triangles_in;
    sum.culled += part.culled;
    sum.clipped += part.clipped;
    sum.outside += part.outside;
    sum.degenerate += part.degenerate;
    sum.uncovered += part.uncovered;
    sum.non_finite += part.non_finite;
}

// Where a chunk's triangles and new vertices start in the geometry.
struct ChunkStart {
    std::size_t triangle = 0, vertex = 0;
};

// Concatenates the chunks and renumbers the vertices that each created; each chunk is freed as soon as it is copied.
void concatenate(std::vector<SetupChunk>& chunks, int threads, Geometry& geometry) {
    const std::size_t given = geometry.vertices.size();
    std::vector<ChunkStart> start(chunks.size());
    ChunkStart end{0, given};
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        start[c] = end;
        end = {end.triangle + chunks[c].triangles.size(), end.vertex + chunks[c].vertices.size()};
        add(geometry.counters, chunks[c].counters);
    }
    geometry.vertices.resize(end.vertex);
    geometry.corners.resize(end.vertex);
    geometry.extras.values.resize(end.vertex * geometry.extras.stride);
    geometry.triangles.resize(end.triangle);
    geometry.all_triangles.resize(end.triangle);
    if (geometry.state.polygon_offset.enabled) geometry.offset_z.resize(end.triangle);
    if (geometry.rules.plane_corners == PlaneCorners::given) geometry.given.resize(end.triangle);
    parallel_for(chunks.size(), threads, [&](std::size_t c) {
        const SetupChunk chunk = std::move(chunks[c]);
        const auto at = [](auto& all, std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
        // A chunk numbers its new vertices from `given` on; they move after those of the chunks before it.
        const auto moved = static_cast<std::uint32_t>(start[c].vertex - given);
        const auto triangles = at(geometry.triangles, start[c].triangle);
        std::ranges::copy(chunk.triangles, triangles);
        for (auto t = triangles; !chunk.vertices.empty() && t != triangles + std::ssize(chunk.triangles); ++t)
            for (std::uint32_t& v : t->vertex) v += v < given ? 0 : moved;
        if (!chunk.offset_z.empty()) std::ranges::copy(chunk.offset_z, at(geometry.offset_z, start[c].triangle));
        if (!chunk.given.empty()) std::ranges::copy(chunk.given, at(geometry.given, start[c].triangle));
        std::ranges::copy(chunk.vertices, at(geometry.vertices, start[c].vertex));
        std::ranges::copy(chunk.corners, at(geometry.corners, start[c].vertex));
        std::ranges::copy(chunk.extras, at(geometry.extras.values, start[c].vertex * geometry.extras.stride));
        const auto first = at(geometry.all_triangles, start[c].triangle);
        std::iota(first, first + std::ssize(chunk.triangles), static_cast<std::uint32_t>(start[c].triangle));
    });
}

// The number of the first fragment of every line: in a strip, that after the last one of the line before.
void number_fragments(const TriangleSoup& soup, const Listing& listing, Geometry& geometry) {
    const auto& records = geometry.triangles;
    std::vector<std::uint32_t> source(records.size()), start(listing.source_count());
    std::size_t run = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        source[i] = listing.at(records[i].primitive, run).number;
        if (records[i].shape() != Shape::line) continue;
        const auto [first, a, b] = geometry.points(records[i]);
        const Rect& viewport = geometry.state.viewport;
        start[source[i]] = stipple_run(a, b, viewport, geometry.rules.subpixel_bits).count;
    }
    std::uint32_t number = 0;
    for (std::size_t r = 0; r < soup.runs.size(); ++r) {
        std::uint32_t next = 0;
        for (std::uint32_t k = 0; k < soup.runs[r].index_count / 3; ++k, ++number) {
            const std::uint32_t* const index = listing.indices(number, r);
            const bool goes_on = k > 0 && soup.runs[r].primitive == Primitive::line_strips && index[1] == index[-1];
            const std::uint32_t own = goes_on ? next : 0;
            next = own + std::exchange(start[number], own);
        }
    }
    geometry.stipple_start.resize(records.size());
    for (std::size_t i = 0; i < records.size(); ++i) geometry.stipple_start[i] = start[source[i]];
}

}  // namespace

SetupTriangle Geometry::triangle(std::size_t i) const noexcept {
    const TriangleRecord& record = triangles[i];
    SetupTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
        const WindowCorner& corner = corners[record.vertex[k]];
        const ClipVertex& v = vertices[record.vertex[k]];
        const std::array<float, 4>& color = record.front_facing ? v.front : v.back;
        t.p[k] = corner.p;
        t.unsnapped[k] = corner.unsnapped;
        if (state.sample) {
            t.unsnapped[k][0] -= state.sample->right();
            t.unsnapped[k][1] -= state.sample->down();
        }
        t.inverse_w[k] = corner.inverse_w;
        t.given_z[k] = corner.z;
        t.w[k] = v.w;
        t.attribute[k] = {color[0], color[1], color[2], color[3], v.texcoord[0], v.texcoord[1]};
    }
    t.z = depths(i);
    t.primitive = record.primitive;
    t.material = record.material;
    t.front_facing = record.front_facing;
    return t;
}

TriangleEdges Geometry::other_edges(const TriangleRecord& t) const noexcept {
    if (t.shape() == Shape::point) return TriangleEdges::everywhere();
    const auto [first, a, b] = points(t);
    return line_edges(a, b, state, rules);
}

namespace {

// The tie rule in the row order of memory.
RasterRules in_memory_rows(RasterRules rules, const RasterState& state) {
    using enum TieRule;
    if (rules.y_axis == YAxis::memory || state.y_direction != YDirection::up) return rules;
    constexpr std::array turned{bottom_left, top_left, bottom_right, top_right};
    rules.tie_rule = turned[static_cast<std::size_t>(rules.tie_rule)];
    return rules;
}

}  // namespace

Geometry set_up(TriangleSoup soup, const RasterState& state, const RasterRules& given_rules, int threads,
                const VertexSource& source) {
    const FloatEnvironment ours;
    const RasterRules rules = with_coordinates(in_memory_rows(given_rules, state));
    check(state);
    check(soup);
    check(soup, state, rules);
    const bool settles = state.window_positions && rules.w_signs == WSigns::by_corner;
    TriangleSetup setup{state, rules, soup.vertices, soup.extras};
    Chunks{soup.vertices.size()}.for_each(threads, [&](std::size_t, std::size_t begin, std::size_t end) {
        constexpr std::size_t few = 1024;  // few enough to stay in the caches from one step to the next
        for (std::size_t at = begin; at < end; at += few) {
            const auto own = std::span{soup.vertices}.subspan(at, std::min(few, end - at));
            if (source) source(at, own);
            for (std::size_t i = 0; settles && i < own.size(); ++i) own[i].w = settled_w(own[i].w);
            setup.set_up_vertices(at, at + own.size());
        }
    });
    setup.find_marked();
    const Listing listing{soup};
    const Chunks triangles{listing.count()};
    std::vector<SetupChunk> chunks(triangles.number());
    triangles.for_each(threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
        SetupChunk chunk;
        chunk.triangles.reserve(end - begin);
        std::size_t run = 0;
        std::array<SourceTriangle, TriangleGroup::size> group;
        for (std::size_t at = begin; at < end;) {
            const std::size_t groups = std::min(listing.side_by_side(at, run), end - at) / group.size();
            if (groups > 0)
                at += group.size() * setup.add_plain(listing.indices(at, run), static_cast<std::uint32_t>(at), groups,
                                                     soup.runs[run], chunk);
            const std::size_t count = std::min(group.size(), end - at);
            if (count == 0) break;
            for (std::size_t k = 0; k < count; ++k) group[k] = listing.at(static_cast<std::uint32_t>(at + k), run);
            setup.add(std::span{group}.first(count), chunk);
            at += count;
        }
        chunks[c] = std::move(chunk);
    });
    Geometry geometry;
    geometry.state = state;
    geometry.rules = rules;
    geometry.has_other_shapes = state.smooth_polygons || std::ranges::any_of(soup.runs, [](const TriangleRun& run) {
                                    return run.primitive != Primitive::triangles;
                                });
    geometry.vertices = std::move(soup.vertices);
    geometry.corners = std::move(setup.corners());
    geometry.extras = std::move(soup.extras);
    concatenate(chunks, threads, geometry);
    if (state.line_stipple) number_fragments(soup, listing, geometry);
    return geometry;
}

}  // namespace strata::rasterizer
