// tools/lab/probe/kit/item.h - a small scene of a kit, and a device's picture of it. Plain values.
//
// Rule     Corners are in clip space and reach the rasterizer unchanged: no client computes a position. A colour is
//          interpolated with perspective and stored; the only arithmetic after that is blending. Rows are numbered as
//          in memory; `y` is the direction of clip-space +y.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/formats/image.h"
#include "rasterizer/rules/raster_state.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::probe {

using rasterizer::ClipVertex;
using rasterizer::DepthFormat;
using rasterizer::YDirection;

// The origin of a device that draws with this y direction.
[[nodiscard]] constexpr pipeline::Origin origin_of(YDirection y) noexcept {
    return y == YDirection::up ? pipeline::Origin::upper_left : pipeline::Origin::lower_left;
}
[[nodiscard]] constexpr YDirection direction_of(pipeline::Origin origin) noexcept {
    return origin == pipeline::Origin::upper_left ? YDirection::up : YDirection::down;
}

// Triangles drawn with one state, three corners each. The depth test is ALWAYS, with depth writes.
struct Draw {
    std::vector<ClipVertex> corners{};
    // Empty: the colour replaces the stored one. Colour and alpha have the same term.
    std::optional<pipeline::BlendTerm> blend{};
    rasterizer::PolygonOffset offset{};
    // The fragment is kept if its alpha is greater: an alpha test, which OpenGL 3.3 core and WebGL 2 do not have.
    std::optional<float> alpha_above{};
};

struct Item {
    // As used in file names, without the orientation: "coverage.ties".
    std::string name{};
    // Keys of pipeline/device/profile_fields.h.
    std::vector<std::string> decides{};
    int width = 64, height = 64;
    pipeline::Format color = pipeline::Format::rgba8;
    // Cleared to 1. Empty: no depth buffer.
    std::optional<DepthFormat> depth{};
    float depth_near = 0.0f, depth_far = 1.0f;
    std::array<float, 4> clear{};  // of the colour buffer
    std::vector<Draw> draws{};
};

// The content of a device's targets. Codes as in Image.
struct Answer {
    pipeline::Image color{};
    std::optional<pipeline::Image> depth{};
    friend bool operator==(const Answer&, const Answer&) = default;
};

// An answer, or the reason why there is none.
struct Reply {
    std::optional<Answer> answer{};
    std::string refusal{};
};

}  // namespace strata::probe
