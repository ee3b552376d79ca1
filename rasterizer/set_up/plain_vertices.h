// rasterizer/set_up/plain_vertices.h - sets up sixteen vertices at a time if they need neither clipping nor special
// cases.
//
// Rule     A vertex is plain if all its values are finite, it is in the view volume, its window position, 1 / w and
//          attributes over w are finite too, and the same holds for its neighbours in the vector. It may also be
//          outside the view volume if it is certainly inside the guard band. The corners of plain vertices have the
//          bits of window.h; the corners of the others are unspecified.
// Tests    tests/rasterizer/set_up/setup_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

inline constexpr std::size_t plain_vertex_count = 16;

// The arithmetic of window.h in binary32, each operation rounded: scale * (c / w or c * (1 / w)) + offset.
struct PlainVertexRules {
    std::array<float, 3> scale{}, offset{};  // x, y, z
    std::array<float, 2> reach{1, 1};  // |x| and |y| may be up to this times w: at most half of what the guard band
                                       // allows
    float guard = 0, subpixels = 1;    // guard band in pixels; subpixels per pixel
    bool divides = true;               // true: divides by w; false: multiplies by 1 / w
    bool rounds = true;                // true: snaps to nearest even; false: toward zero
    bool symmetric = true;             // true: the view volume's z begins at -w; false: at 0
};

// Bit i of the result: vertex i of the sixteen is plain, and its corner is written.
using SetUpPlain = std::uint32_t (*)(const PlainVertexRules& rules, const ClipVertex* vertices, WindowCorner* corners);

// The kernel of the selected instruction set; null for scalar, which has none, and on computers that are not
// little-endian. Look it up once per draw.
[[nodiscard]] SetUpPlain set_up_plain() noexcept;

}  // namespace strata::rasterizer
