// rasterizer/set_up/plain_vertices.h - vertices set up sixteen at a time, where there is nothing unusual about them.
//
// Rule     A vertex is plain if all of it is finite, it lies in the view volume, and its window position, 1 / w and
//          attributes over w are finite, too; and those of its neighbours are. Beside the view volume it may lie where
//          it is surely inside the guard band. The corners of plain vertices have the bits of window.h; of the others
//          nothing is said.
// Tests    tests/rasterizer/set_up/setup_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

inline constexpr std::size_t plain_vertex_count = 16;

// Arithmetic of window.h by binary32, each operation rounded: scale * (c / w or c * (1 / w)) + offset.
struct PlainVertexRules {
    std::array<float, 3> scale{}, offset{};  // x, y, z
    std::array<float, 2> reach{1, 1};  // x and y may be this many times w: at most half of what the guard band allows
    float guard = 0, subpixels = 1;    // pixels; a pixel's subpixels
    bool divides = true;               // by w; false: multiplies by 1 / w
    bool rounds = true;                // snaps to the nearest, even; false: toward zero
    bool symmetric = true;             // the view volume's z begins at -w; false: at 0
};

// Bit i of the answer: vertex i of the sixteen is plain, and its corner is written.
using SetUpPlain = std::uint32_t (*)(const PlainVertexRules& rules, const ClipVertex* vertices, WindowCorner* corners);

// The kernel of the chosen instruction set; null for scalar, which has none, and where corners are not words of little
// endian. A draw asks once.
[[nodiscard]] SetUpPlain set_up_plain() noexcept;

}  // namespace strata::rasterizer
