// rasterizer/set_up/plain_triangles.h - triangles set up sixteen at a time, where there is nothing unusual about them;
// and which pixels a tiny triangle covers.
//
// Rule     The records, their order and the fates are those of TriangleSetup::add, one triangle after the other. A
//          triangle is plain if its vertices have no marks and it is small (TriangleGroup), or its sides' slopes are
//          below 2^64 (float spans).
// Tests    tests/rasterizer/set_up/plain_triangles_test.cpp
#pragma once
#include <cstdint>
#include <span>

#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

// What the triangles of a run share.
struct PlainTriangleRules {
    GroupRules group;
    int x0 = 0, y0 = 0;  // the viewport's corner: boxes count from it
    std::uint32_t material = 0;
    std::uint32_t first_vertex = 0;  // what indices, corners and marks are counted from
    bool positive_is_front = true;   // a positive area faces front
    bool drops_front = false, drops_back = false;
};

struct PlainFates {
    std::uint32_t kept = 0, culled = 0, outside = 0, degenerate = 0, uncovered = 0;
};

// Sixteen triangles, three of `indices` each, submitted from number `primitive` on. False if one of them is not plain:
// then nothing is said. `marks` are those of the vertices, null if none has any. Else what is left of them stands at
// `out`, which has room for sixteen, and `fates` have grown by theirs.
using SetUpPlainTriangles = bool (*)(const PlainTriangleRules& rules, const std::uint32_t* indices,
                                     std::uint32_t primitive, std::span<const WindowCorner> corners,
                                     const std::uint32_t* marks, TriangleRecord* out, PlainFates& fates);

// The kernel of the chosen instruction set; null for scalar, and where records are not words of little endian.
[[nodiscard]] SetUpPlainTriangles set_up_plain_triangles() noexcept;
// The same for CoverageRule::float_spans.
[[nodiscard]] SetUpPlainTriangles set_up_plain_spans() noexcept;

// Makes a record tiny if its box, pixels of the surface, and its corners are. False if it is, and covers none of its
// pixels.
[[nodiscard]] bool find_tiny(const std::array<SubpixelPoint, 3>& p, const Rect& box, const RasterRules& rules,
                             TriangleRecord& record) noexcept;

}  // namespace strata::rasterizer
