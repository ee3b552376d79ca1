// tools/probe/item.h - one small scene of a kit, and what a device drew of it. Plain values.
//
// Rule     Corners are in clip space and reach the rasterizer as they are: no client computes a position. A colour is
//          interpolated by perspective and stored as it is; blending is the only arithmetic behind it. Rows are
//          numbered as memory has them; `y` says where clip-space +y points to.
// Tests    tests/tools/probe/kit_test.cpp
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

// The origin of a device that draws with clip-space +y there.
[[nodiscard]] constexpr pipeline::Origin origin_of(YDirection y) noexcept {
    return y == YDirection::up ? pipeline::Origin::upper_left : pipeline::Origin::lower_left;
}
[[nodiscard]] constexpr YDirection direction_of(pipeline::Origin origin) noexcept {
    return origin == pipeline::Origin::upper_left ? YDirection::up : YDirection::down;
}

// Triangles that are drawn with one state, three corners each. The depth test is ALWAYS with a write.
struct Draw {
    std::vector<ClipVertex> corners{};
    // Off: the colour replaces what is there. One term for colour and alpha.
    std::optional<pipeline::BlendTerm> blend{};
    rasterizer::PolygonOffset offset{};
    // The fragment lives if its alpha is greater: a test that OpenGL 3.3 core and WebGL 2 do not have.
    std::optional<float> alpha_above{};
};

struct Item {
    // As files are called, without the orientation: "coverage.ties".
    std::string name{};
    // Keys of pipeline/device/profile_fields.h.
    std::vector<std::string> decides{};
    int width = 64, height = 64;
    pipeline::Format color = pipeline::Format::rgba8;
    // Cleared to 1. None: no depth buffer.
    std::optional<DepthFormat> depth{};
    float depth_near = 0.0f, depth_far = 1.0f;
    // The colour buffer is cleared to 0.
    std::vector<Draw> draws{};
};

// What a device left in its targets. Codes as Image has them.
struct Answer {
    pipeline::Image color{};
    std::optional<pipeline::Image> depth{};
    friend bool operator==(const Answer&, const Answer&) = default;
};

// An answer, or why there is none.
struct Reply {
    std::optional<Answer> answer{};
    std::string refusal{};
};

}  // namespace strata::probe
