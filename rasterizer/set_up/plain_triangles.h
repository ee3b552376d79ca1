// rasterizer/set_up/plain_triangles.h - sets up sixteen triangles at a time if none of them needs special treatment,
// and finds the pixels that a tiny triangle covers.
//
// Rule     The records, their order and the fates are those of TriangleSetup::add, one triangle after the other. A
//          triangle is plain if its vertices have no marks and it is small (TriangleGroup), or, for float spans, the
//          slopes of its sides are below 2^64.
// Tests    tests/rasterizer/set_up/plain_triangles_test.cpp
#pragma once
#include <cstdint>
#include <span>

#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

// Common to the triangles of a run.
struct PlainTriangleRules {
    GroupRules group;
    int x0 = 0, y0 = 0;  // the viewport's corner: boxes are relative to it
    std::uint32_t material = 0;
    std::uint32_t first_vertex = 0;  // the vertex to which indices, corners and marks are relative
    bool positive_is_front = true;   // a positive area faces front
    bool drops_front = false, drops_back = false;
};

struct PlainFates {
    std::uint32_t kept = 0, culled = 0, outside = 0, degenerate = 0, uncovered = 0;
};

// Sets up sixteen triangles, three of `indices` each, with submission indices from `primitive` on. `marks` are those of
// the vertices, null if none has any. Returns false if one of the triangles is not plain: `out` is then unspecified and
// `fates` unchanged. Otherwise writes the records of the kept triangles to `out`, which must have room for sixteen, and
// adds their fates to `fates`.
using SetUpPlainTriangles = bool (*)(const PlainTriangleRules& rules, const std::uint32_t* indices,
                                     std::uint32_t primitive, std::span<const WindowCorner> corners,
                                     const std::uint32_t* marks, TriangleRecord* out, PlainFates& fates);

// The kernel of the selected instruction set; null for scalar and on computers that are not little-endian.
[[nodiscard]] SetUpPlainTriangles set_up_plain_triangles() noexcept;
// The same for CoverageRule::float_spans.
[[nodiscard]] SetUpPlainTriangles set_up_plain_spans() noexcept;

// Marks a record as tiny if its box (pixels of the surface) and its corners allow it. Returns false if it is tiny and
// covers none of its pixels.
[[nodiscard]] bool find_tiny(const std::array<SubpixelPoint, 3>& p, const Rect& box, const RasterRules& rules,
                             TriangleRecord& record) noexcept;

}  // namespace strata::rasterizer
