// rasterizer/set_up/setup.h - turns one source triangle into triangle records, or drops and counts it.
//
// Rule     In this order: a vertex that is not finite drops the triangle, and so does a window position, 1 / w or u / w
//          that is not finite (non_finite); clipping (clipped, outside); then per piece: zero area after snapping
//          (degenerate), facing by the sign of the snapped area (culled), no pixel centre of the viewport in its
//          bounding box (outside, if this holds for all pieces), a tiny triangle that covers no pixel of its box
//          (uncovered).
// Source   rasterizer/reference/coverage.md 6, 7 and 11; D3D 11.3 15.11 (facing after snapping).
// Tests    tests/rasterizer/set_up/setup_test.cpp
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/clip.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/set_up/plain_triangles.h"
#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {

// Marks of a vertex that cause its triangles to be clipped or dropped, computed once per vertex rather than per
// triangle. Bits 0 .. max_clip_planes - 1 are the clip planes outside which the vertex is; the higher bits, named
// below, mark values that are not finite.
using VertexMarks = std::uint32_t;
inline constexpr VertexMarks marks_planes = (1u << max_clip_planes) - 1;
inline constexpr VertexMarks marks_input = 1u << max_clip_planes;  // an input value
inline constexpr VertexMarks marks_window = marks_input << 1;      // window position, 1 / w, texture coordinate over w
inline constexpr VertexMarks marks_front = marks_input << 2;       // front colour over w
inline constexpr VertexMarks marks_back = marks_input << 3;

struct SourceTriangle {
    std::array<std::uint32_t, 3> vertex;
    std::uint32_t number = 0;     // in the order of the soup's list
    std::uint32_t primitive = 0;  // in submission order
    const TriangleRun* run = nullptr;
};

// The vertex to which the indices of a TriangleRun are relative.
[[nodiscard]] inline std::uint32_t first_vertex(const TriangleRun& run) noexcept {
    return run.lent != nullptr ? run.first_vertex : 0;
}

// The triangle records of a range of source triangles. Vertices created by clipping are numbered from the soup's vertex
// count on.
struct SetupChunk {
    UninitializedVector<TriangleRecord> triangles;
    std::vector<std::array<double, 3>> offset_z;
    std::vector<std::array<std::uint32_t, 3>> given;  // as in Geometry
    std::vector<ClipVertex> vertices;
    std::vector<WindowCorner> corners;
    std::vector<float> extras;
    SetupCounters counters;
};

// The set-up of one draw. set_up_vertices may run on several threads with disjoint ranges; after all of them have
// ended, `add` may run on several threads, each with its own chunk.
class TriangleSetup {
  public:
    TriangleSetup(const RasterState& state, const RasterRules& rules, std::span<const ClipVertex> vertices,
                  const VertexExtras& extras);

    // Step 1: set up every vertex once.
    void set_up_vertices(std::size_t begin, std::size_t end) noexcept;
    // Step 2: find out whether any vertex is marked.
    void find_marked() noexcept;
    // Step 3: appends the records of a primitive to `out`, or counts why it was dropped.
    void add(const SourceTriangle& triangle, SetupChunk& out) const;
    // Step 3 for up to TriangleGroup::size triangles, in order; boxes and areas are computed for all of them at once.
    void add(std::span<const SourceTriangle> triangles, SetupChunk& out) const;

    // Adds up to `groups` times TriangleGroup::size triangles of a run, three of `indices` each, with submission
    // indices from `primitive` on, one group at a time. Stops at the first group with a triangle that is not plain;
    // returns the number of groups added.
    [[nodiscard]] std::size_t add_plain(const std::uint32_t* indices, std::uint32_t primitive, std::size_t groups,
                                        const TriangleRun& run, SetupChunk& out) const;

    [[nodiscard]] UninitializedVector<WindowCorner>& corners() noexcept { return corners_; }

  private:
    // The outcome of set-up for a source triangle or for a piece of a clipped one (coverage.md 7.1).
    enum class Fate : std::uint8_t { kept, culled, outside, degenerate, uncovered, non_finite };

    // Three window-space vertices, and the union of their marks.
    struct Piece {
        std::array<std::uint32_t, 3> vertex;
        std::array<const WindowCorner*, 3> corner;
        VertexMarks marks;
    };
    [[nodiscard]] const float* extras_of(std::size_t i) const noexcept {
        return extras_.stride == 0 ? nullptr : extras_.of(i);
    }
    [[nodiscard]] bool extras_finite(const float* extras, float inverse_w) const noexcept;
    void set_up_vertex(std::size_t i) noexcept;
    [[nodiscard]] VertexMarks project(const ClipVertex& v, const float* extras, VertexOrigin origin,
                                      WindowCorner& corner) const noexcept;
    [[nodiscard]] ClipPolygon polygon(const SourceTriangle& triangle) const noexcept;
    [[nodiscard]] Fate add_piece(const Piece& piece, const SourceTriangle& triangle, SetupChunk& out) const;
    // A small triangle without marks, with its edges in the group.
    [[nodiscard]] Fate add_small(const SourceTriangle& triangle, const TriangleGroup& group, std::size_t k,
                                 SetupChunk& out) const;
    [[nodiscard]] Fate add_clipped(const SourceTriangle& triangle, std::uint32_t planes, SetupChunk& out) const;
    // Lines and points (shape_setup.cpp).
    struct Ends;
    [[nodiscard]] Fate add_shape(const SourceTriangle& source, SetupChunk& out) const;
    [[nodiscard]] Fate add_line(const SourceTriangle& source, bool front, SetupChunk& out) const;
    [[nodiscard]] Fate add_ends(const SourceTriangle& source, const Ends& ends, bool front, SetupChunk& out) const;
    [[nodiscard]] Fate add_quad(const SourceTriangle& source, const Ends& ends, bool front, SetupChunk& out) const;
    [[nodiscard]] std::optional<bool> polygon_faces_front(const SourceTriangle& source) const;
    static void count(Fate fate, const SourceTriangle& triangle, SetupCounters& counters) noexcept;
    [[nodiscard]] bool is_front(std::int64_t area, bool mirrored) const noexcept;
    [[nodiscard]] bool is_culled(bool front) const noexcept {
        return state_.cull == CullFace::front_and_back ||
               (state_.cull != CullFace::none && (state_.cull == CullFace::front) == front);
    }
    [[nodiscard]] int single_turn(const SourceTriangle& triangle) const noexcept;
    [[nodiscard]] std::array<double, 3> with_offset(const std::array<const WindowCorner*, 3>& corner,
                                                    const TriangleRun& run) const noexcept;
    [[nodiscard]] std::uint8_t negative_w(const std::array<const WindowCorner*, 3>& corner) const noexcept;
    [[nodiscard]] bool is_out_of_range(const std::array<const WindowCorner*, 3>& corner) const noexcept;

    RasterState state_;
    RasterRules rules_;
    Clipper clipper_;
    WindowTransform window_;
    std::optional<PlainVertexRules> plain_rules_;
    SetUpPlain set_up_plain_;
    bool needs_scalar_setup_;  // rules that the kernels for several triangles do not implement
    SetUpPlainTriangles set_up_plain_triangles_;
    std::span<const ClipVertex> vertices_;
    const VertexExtras& extras_;
    UninitializedVector<WindowCorner> corners_;
    UninitializedVector<VertexMarks> marks_;
    bool any_marked_ = true;
};

}  // namespace strata::rasterizer
