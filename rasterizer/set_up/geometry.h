// rasterizer/set_up/geometry.h - the input of set-up (clip-space vertices) and its output, which is computed once per
// frame (triangles, binned by tile).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rasterizer/base/uninitialized.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/coverage/window_corner.h"
#include "rasterizer/rules/primitive.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

inline constexpr int color_channels = 4, texcoord_channels = 2;
inline constexpr int attribute_count = color_channels + texcoord_channels;  // r g b a s t

// A vertex after the vertex stage: clip space, or window x, y, z and w with RasterState::window_positions.
struct ClipVertex {
    float x = 0, y = 0, z = 0, w = 1;
    std::array<float, 4> front{1, 1, 1, 1};  // colour of front-facing triangles
    std::array<float, 4> back{1, 1, 1, 1};   // colour of back-facing triangles (two-sided lighting)
    std::array<float, 2> texcoord{0, 0};
};

// Additional vertex values, interpolated with perspective like the colours: `stride` values per vertex, none if it is
// 0. They are in the order of the fields below.
inline constexpr std::size_t max_extras = 2 + 1 + 2 * color_channels + 4 * texture_units;
struct VertexExtras {
    std::size_t stride = 0;
    bool has_rq = false;  // the first two are r and q, whose quotient is the depth of perspective_rq and depth_replace,
                          // r in units of vertex z (rules.window_z)
    bool has_fog = false;        // one is the fog coordinate
    bool has_secondary = false;  // eight are the secondary colours of front and back faces
    bool has_units = false;      // the last sixteen are s, t, r, q of each texture unit
    std::vector<float> values;
    [[nodiscard]] const float* of(std::size_t vertex) const noexcept { return &values[vertex * stride]; }
    [[nodiscard]] std::size_t fog_place() const noexcept { return has_rq ? 2 : 0; }
    [[nodiscard]] const float* secondary_of(std::size_t vertex, bool is_front) const noexcept {
        return of(vertex) + fog_place() + (has_fog ? 1 : 0) + (is_front ? 0 : color_channels);
    }
    [[nodiscard]] const float* units_of(std::size_t vertex) const noexcept {
        return &values[vertex * stride + stride - 4 * texture_units];
    }
};

// A run of primitives of one kind with one material: three indices each (primitive.h), in submission order.
struct TriangleRun {
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
    std::uint32_t object = 0;  // identifies the object of these triangles; chosen by the caller
    bool double_sided = true;
    bool mirrored = false;  // the model matrix has a negative determinant: facing is exchanged
    // The indices, if they are not in the soup: borrowed from a caller that has checked them, relative to
    // `first_vertex`.
    const std::uint32_t* lent = nullptr;
    std::uint32_t first_vertex = 0;
    Primitive primitive = Primitive::triangles;
    bool without_offset = false;  // polygon offset does not move it
};

// The input of one draw. Runs refer to triples of `indices` or to borrowed ones; primitives are numbered through the
// runs in their order.
struct TriangleSoup {
    UninitializedVector<ClipVertex> vertices;
    UninitializedVector<std::uint32_t> indices;
    std::vector<TriangleRun> runs;
    std::vector<std::uint32_t> order;  // empty: as listed; else the submission order of all triangles (painter's
                                       // algorithm)
    VertexExtras extras;
};

// A primitive after clipping, snapping and the facing test; one source triangle may become several (a fan from its
// first corner). Corners are in submission order: geforce3's depth and colour depend on it. A line has its first end
// twice, then the second; a point has its vertex three times.
struct TriangleRecord {
    std::array<std::uint32_t, 3> vertex{};  // into Geometry::vertices and Geometry::corners
    std::uint32_t primitive = 0;            // submission index of the source triangle
    std::uint32_t material = 0;
    PixelBox box;  // the pixels of the viewport whose centres are in its bounding box, or those of a line's or point's
                   // box (line_coverage.h); not empty
    bool front_facing : 1 = true;
    // If set, the box has at most tiny_size pixels in each direction, the corners are at most TriangleGroup::max_extent
    // apart, and `covered` has a bit for each covered pixel of the box: row by row, tiny_size bits per row. At least
    // one bit is set.
    bool is_tiny : 1 = false;
    bool without_offset : 1 = false;  // as its run
    // 0 for a triangle whose edges alone decide. Bits 0 to 2: w of that corner is negative (WSigns::by_corner); the
    // bits above: the Shape.
    std::uint8_t special = 0;
    std::uint16_t covered = 0;

    [[nodiscard]] std::uint8_t negative_w() const noexcept { return special & 7; }
    [[nodiscard]] Shape shape() const noexcept { return static_cast<Shape>(special >> 3); }
    // True if an enabled polygon offset moves it.
    [[nodiscard]] bool takes_offset() const noexcept { return is_polygon(shape()) && !without_offset; }
    [[nodiscard]] static std::uint8_t special_of(Shape shape) noexcept {
        return static_cast<std::uint8_t>(static_cast<unsigned>(shape) << 3);
    }
};
inline constexpr int tiny_size = 4;

// A TriangleRecord with the values of its corners gathered from the arrays of Geometry.
struct SetupTriangle {
    std::array<SubpixelPoint, 3> p;
    std::array<std::array<float, 2>, 3> unsnapped;  // moved like p
    std::array<double, 3> z;                        // including polygon offset
    std::array<double, 3> given_z;                  // without polygon offset
    std::array<float, 3> w;                         // as given, in clip units
    std::array<float, 3> inverse_w;
    std::array<std::array<float, attribute_count>, 3> attribute;  // as given, before the product with 1 / w
    std::uint32_t primitive = 0;
    std::uint32_t material = 0;
    bool front_facing = true;
};

// Exact counts of the dropped triangles (or lines or points) by reason; `first_non_finite` is a source triangle. A
// source triangle is
// counted in triangles_in and in at most one of culled, outside, degenerate, uncovered and non_finite; `clipped` counts
// those that were clipped and not found outside (rasterizer/reference/coverage.md 7.1).
struct SetupCounters {
    std::uint64_t triangles_in = 0, culled = 0, clipped = 0, outside = 0, degenerate = 0, uncovered = 0, non_finite = 0;
    std::uint32_t first_non_finite = 0;
    friend bool operator==(const SetupCounters&, const SetupCounters&) = default;
};

// The input of all later passes, computed once. Bins are empty if no tile size was requested.
struct Geometry {
    RasterState state;
    RasterRules rules;
    UninitializedVector<ClipVertex> vertices;       // the soup's, then those that clipping created
    UninitializedVector<WindowCorner> corners;      // the same vertices in window space
    VertexExtras extras;                            // for the same vertices
    UninitializedVector<TriangleRecord> triangles;  // in submission order
    std::vector<std::array<double, 3>> offset_z;    // per triangle; empty without polygon offset
    // Per triangle, the vertices of the source triangle, of which it may be a piece; empty except for
    // PlaneCorners::given.
    std::vector<std::array<std::uint32_t, 3>> given;
    std::vector<std::uint32_t> stipple_start;  // per triangle, the number of a line's first fragment; empty if unused
    SetupCounters counters;
    bool has_other_shapes = false;  // than triangles
    int tile_size = 0, tiles_x = 0, tiles_y = 0;
    std::vector<std::uint32_t> bin_start;              // tiles_x * tiles_y + 1 offsets into bin_triangles
    UninitializedVector<std::uint32_t> bin_triangles;  // indices into triangles, ascending within a bin
    UninitializedVector<std::uint32_t> all_triangles;  // 0, 1, 2 ...: the list for a region that is the whole frame

    // The vertices that define the planes of triangle i.
    [[nodiscard]] const std::array<std::uint32_t, 3>& plane_vertices(std::size_t i) const noexcept {
        return given.empty() ? triangles[i].vertex : given[i];
    }
    // The triangles that may touch a tile, ascending; tiles are numbered row by row.
    [[nodiscard]] std::span<const std::uint32_t> bin(std::size_t tile) const {
        return std::span{bin_triangles}.subspan(bin_start[tile], bin_start[tile + 1] - bin_start[tile]);
    }
    [[nodiscard]] std::array<SubpixelPoint, 3> points(const TriangleRecord& t) const noexcept {
        return {corners[t.vertex[0]].p, corners[t.vertex[1]].p, corners[t.vertex[2]].p};
    }
    // The edges from which its values are interpolated; a triangle's cover its pixels, too.
    [[nodiscard]] TriangleEdges edges(const TriangleRecord& t) const noexcept {
        if (is_polygon(t.shape())) return {points(t), rules.tie_rule};
        return other_edges(t);
    }
    // Positions before snapping, in pixels.
    [[nodiscard]] std::array<std::array<float, 2>, 3> positions(const TriangleRecord& t) const noexcept {
        return {corners[t.vertex[0]].unsnapped, corners[t.vertex[1]].unsnapped, corners[t.vertex[2]].unsnapped};
    }
    // Vertex z of the corners including polygon offset, in units of rules.window_z.
    [[nodiscard]] std::array<double, 3> depths(std::size_t i) const noexcept {
        if (!offset_z.empty()) return offset_z[i];
        const auto& [a, b, c] = triangles[i].vertex;
        return {corners[a].z, corners[b].z, corners[c].z};
    }
    [[nodiscard]] SetupTriangle triangle(std::size_t i) const noexcept;

  private:
    [[nodiscard]] TriangleEdges other_edges(const TriangleRecord& t) const noexcept;
};

// Writes the vertices of a soup, starting at vertex `begin`.
using VertexSource = std::function<void(std::size_t begin, std::span<ClipVertex> vertices)>;

// Clips, projects, snaps, culls and sets up every triangle of `soup`, in parallel; the result does not depend on
// `threads`. The geometry takes over the vertices: moving the soup in saves a copy. With a source the vertices have no
// values yet; the source writes them in portions just before they are set up. Throws InputError (check_input.h).
[[nodiscard]] Geometry set_up(TriangleSoup soup, const RasterState& state, const RasterRules& rules, int threads,
                              const VertexSource& source = {});

// Sorts the triangles into square tiles of `tile_size` pixels (8, 16, 32, 64 or 128) over the viewport, row-major; in
// parallel, the result does not depend on `threads`.
void bin_triangles(Geometry& geometry, int tile_size, int threads = 1);

// The rectangle of tile `tile` of the viewport.
[[nodiscard]] Rect tile_rect(const Geometry& geometry, std::size_t tile);

}  // namespace strata::rasterizer
