// rasterizer/set_up/setup.h - one source triangle becomes set-up triangles, or is dropped and counted.
//
// Rule     In this order: a vertex that is not finite drops the triangle, and so does a window position, 1 / w or u / w
//          that is not (non_finite); clipping (clipped, outside); per piece: zero area after snapping (degenerate),
//          facing by the sign of the snapped area (culled), no pixel centre of the viewport in its bounding box
//          (outside, if all its pieces go that way), a tiny one's box of which no pixel is covered (uncovered).
// Source   coverage.md 6, 7 and 11; D3D 11.3 15.11 (facing after snapping).
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

// Marks of a vertex that get its triangles clipped or dropped, found once a vertex and not once a triangle. Bits 0 ..
// max_clip_planes - 1 name the clip planes that the vertex lies outside of; the higher bits, named below, say which of
// its values are not finite.
using VertexMarks = std::uint32_t;
inline constexpr VertexMarks marks_planes = (1u << max_clip_planes) - 1;
inline constexpr VertexMarks marks_input = 1u << max_clip_planes;  // as given
inline constexpr VertexMarks marks_window = marks_input << 1;      // window position, 1 / w, texture coordinate over w
inline constexpr VertexMarks marks_front = marks_input << 2;       // front colour over w
inline constexpr VertexMarks marks_back = marks_input << 3;

struct SourceTriangle {
    std::array<std::uint32_t, 3> vertex;
    std::uint32_t number = 0;     // in the soup's listing
    std::uint32_t primitive = 0;  // in submission order
    const TriangleRun* run = nullptr;
};

// What the indices of a run count from.
[[nodiscard]] inline std::uint32_t first_vertex(const TriangleRun& run) noexcept {
    return run.lent != nullptr ? run.first_vertex : 0;
}

// The triangles that set-up makes of a run of source triangles. Vertices made by clipping are numbered from the soup's
// last one on.
struct SetupChunk {
    UninitializedVector<TriangleRecord> triangles;
    std::vector<std::array<double, 3>> offset_z;
    std::vector<std::array<std::uint32_t, 3>> given;  // as Geometry's
    std::vector<ClipVertex> vertices;
    std::vector<WindowCorner> corners;
    std::vector<float> extras;
    SetupCounters counters;
};

// The set-up of one draw. set_up_vertices may run on many threads, each with a range of its own; after the last of
// them has ended, `add` may, each with a chunk of its own.
class TriangleSetup {
  public:
    TriangleSetup(const RasterState& state, const RasterRules& rules, std::span<const ClipVertex> vertices,
                  const VertexExtras& extras);

    // First every vertex once ...
    void set_up_vertices(std::size_t begin, std::size_t end) noexcept;
    // ... then find out whether any of them is marked ...
    void find_marked() noexcept;
    // ... then triangles: appends what is left of `triangle` to `out` and counts what is not.
    void add(const SourceTriangle& triangle, SetupChunk& out) const;
    // Adds up to TriangleGroup::size triangles in their order; boxes and areas are found for all of them at once.
    void add(std::span<const SourceTriangle> triangles, SetupChunk& out) const;

    // Adds up to `groups` times TriangleGroup::size triangles of a run, three of `indices` each, submitted from number
    // `primitive` on, a group at once; returns how many groups, up to the first one with a triangle that is not plain.
    [[nodiscard]] std::size_t add_plain(const std::uint32_t* indices, std::uint32_t primitive, std::size_t groups,
                                        const TriangleRun& run, SetupChunk& out) const;

    [[nodiscard]] UninitializedVector<WindowCorner>& corners() noexcept { return corners_; }

  private:
    // The outcome of set-up for a source triangle or for a piece of a clipped one (coverage.md 7.1).
    enum class Fate : std::uint8_t { kept, culled, outside, degenerate, uncovered, non_finite };

    // Three vertices in the window, and all that is marked at any of them.
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
    // A small triangle without marks, its edges in the group.
    [[nodiscard]] Fate add_small(const SourceTriangle& triangle, const TriangleGroup& group, std::size_t k,
                                 SetupChunk& out) const;
    [[nodiscard]] Fate add_clipped(const SourceTriangle& triangle, std::uint32_t planes, SetupChunk& out) const;
    static void count(Fate fate, const SourceTriangle& triangle, SetupCounters& counters) noexcept;
    [[nodiscard]] bool is_front(std::int64_t area, bool mirrored) const noexcept;
    [[nodiscard]] bool is_culled(bool front) const noexcept;
    [[nodiscard]] int single_turn(const SourceTriangle& triangle) const noexcept;
    [[nodiscard]] std::array<double, 3> with_offset(const std::array<const WindowCorner*, 3>& corner) const noexcept;
    [[nodiscard]] std::uint8_t negative_w(const std::array<const WindowCorner*, 3>& corner) const noexcept;
    [[nodiscard]] bool is_out_of_range(const std::array<const WindowCorner*, 3>& corner) const noexcept;

    RasterState state_;
    RasterRules rules_;
    Clipper clipper_;
    WindowTransform window_;
    std::optional<PlainVertexRules> plain_rules_;
    SetUpPlain set_up_plain_;
    bool goes_one_by_one_;  // rules that kernels of many triangles do not know
    SetUpPlainTriangles set_up_plain_triangles_;
    std::span<const ClipVertex> vertices_;
    const VertexExtras& extras_;
    UninitializedVector<WindowCorner> corners_;
    UninitializedVector<VertexMarks> marks_;
    bool any_marked_ = true;
};

}  // namespace strata::rasterizer
