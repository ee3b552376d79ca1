// tools/lab/probe/kit/shapes.h - triangles of a kit, given in pixels and converted to clip space.
//
// Numbers  Where a frame's sides are powers of two and a position is a multiple of 2^-16 pixel, the way to clip space
//          and back is exact.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <array>

#include "rasterizer/base/numerics.h"
#include "tools/lab/probe/kit/item.h"
#include "tools/lab/probe/kit/random_generator.h"

namespace strata::probe {
inline namespace strict {

using Color = std::array<float, 4>;
inline constexpr Color white{1, 1, 1, 1};

// A position in the frame, in pixels from the first row and column of memory, with clip z and w.
struct FramePosition {
    float x = 0, y = 0, z = 0, w = 1;
};

// The corner that is mapped to that position; clip y is negated if clip-space +y points up in memory.
[[nodiscard]] inline ClipVertex corner(const Item& item, const FramePosition& p, const Color& color) {
    ClipVertex v;
    v.x = (p.x * 2.0f / static_cast<float>(item.width) - 1.0f) * p.w;
    v.y = (p.y * 2.0f / static_cast<float>(item.height) - 1.0f) * p.w;
    v.z = p.z * p.w;
    v.w = p.w;
    v.front = v.back = color;
    return v;
}

inline void add_triangle(const Item& item, Draw& draw, const std::array<FramePosition, 3>& p,
                         const std::array<Color, 3>& c) {
    for (std::size_t i = 0; i < 3; ++i) draw.corners.push_back(corner(item, p[i], c[i]));
}

// Two triangles; corners in order around the quad.
inline void add_quad(const Item& item, Draw& draw, const std::array<FramePosition, 4>& p, const Color& color) {
    add_triangle(item, draw, {p[0], p[1], p[2]}, {color, color, color});
    add_triangle(item, draw, {p[0], p[2], p[3]}, {color, color, color});
}
inline void add_box(const Item& item, Draw& draw, float x0, float y0, float x1, float y1, const Color& color,
                    float z = 0.0f, float w = 1.0f) {
    add_quad(item, draw, {FramePosition{x0, y0, z, w}, {x1, y0, z, w}, {x1, y1, z, w}, {x0, y1, z, w}}, color);
}

// One of 252 opaque greys and colours that 8 bits represent exactly.
[[nodiscard]] inline Color code_color(int number) {
    return {static_cast<float>(number % 7) / 255.0f * 32.0f, static_cast<float>(number / 7 % 6) / 255.0f * 48.0f,
            static_cast<float>(number % 251 + 4) / 255.0f, 1.0f};
}
[[nodiscard]] inline Color random_color(RandomGenerator& random) {
    Color c;
    for (float& channel : c) channel = random.unit();
    return c;
}
[[nodiscard]] inline FramePosition random_position(RandomGenerator& random, const Item& item, float margin) {
    FramePosition p;
    p.x = random.between(-margin, static_cast<float>(item.width) + margin);
    p.y = random.between(-margin, static_cast<float>(item.height) + margin);
    p.z = random.between(-0.9f, 0.9f);
    return p;
}

}  // namespace strict
}  // namespace strata::probe
