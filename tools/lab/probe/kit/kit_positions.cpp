// tools/lab/probe/kit/kit_positions.cpp - scenes for the transform from clip space to the window: the division by w,
// and the viewport's rounding.
//
// Rule     Two ways of computing a position differ in its last bit. A flat depth under a depth range that is not a
//          power of two depends on that bit. Without a float depth buffer an edge is used that is so close to a
//          threshold of snapping or coverage that the two ways end on different sides.
#include <bit>
#include <cmath>
#include <vector>

#include "rasterizer/set_up/window.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"

namespace strata::probe {

namespace {

using rasterizer::RasterRules;
using rasterizer::ViewportArithmetic;
using rasterizer::WDivide;
using rasterizer::WindowTransform;

const std::vector<std::string> position_fields{"raster.w_divide", "raster.viewport", "raster.y_axis"};

struct PositionArithmetic {
    WDivide divide;
    ViewportArithmetic viewport;
};
constexpr PositionArithmetic ways[]{{WDivide::quotient, ViewportArithmetic::separate},
                                    {WDivide::quotient, ViewportArithmetic::fused},
                                    {WDivide::reciprocal, ViewportArithmetic::separate},
                                    {WDivide::reciprocal, ViewportArithmetic::fused},
                                    {WDivide::nv20, ViewportArithmetic::separate}};

WindowTransform transform(const Item& item, const PositionArithmetic& way) {
    rasterizer::RasterState state;
    state.viewport = {0, 0, item.width, item.height};
    state.y_direction = YDirection::down;
    RasterRules rules;
    rules.w_divide = way.divide;
    rules.viewport = way.viewport;
    return {state, rules};
}

// Finds clip x and w that the two ways put on different sides of window x `target`; w is 0 if none was found.
ClipVertex split(RandomGenerator& random, const Item& item, const PositionArithmetic& a, const PositionArithmetic& b,
                 float target) {
    const WindowTransform first = transform(item, a), second = transform(item, b);
    for (int attempt = 0; attempt < 400; ++attempt) {
        ClipVertex v = corner(item, {target, 0, 0, random.between(0.5f, 4.0f)}, white);
        for (int ulps = random.below(7) - 3; ulps != 0; ulps += ulps < 0 ? 1 : -1)
            v.x = std::nextafter(v.x, ulps < 0 ? -8.0f : 8.0f);
        if ((first.project(v).x < target) != (second.project(v).x < target)) return v;
    }
    ClipVertex none;
    none.w = 0.0f;
    return none;
}

// A box of 3 x 3 pixels whose left or right edge is at `x` and w of `at`; its other edges are far from all centres.
void add_split_box(const Item& item, Draw& draw, const ClipVertex& at, float left, float top, bool is_left) {
    const float other = is_left ? left + 2.0f : left;
    const auto place = [&](float x, float y, bool delicate) {
        ClipVertex v = corner(item, {x, y, 0, at.w}, white);
        if (delicate) v.x = at.x;
        return v;
    };
    const ClipVertex a = place(0, top, true), b = place(other, top, false), c = place(other, top + 2.0f, false),
                     d = place(0, top + 2.0f, true);
    for (const ClipVertex& v : {a, b, c, a, c, d}) draw.corners.push_back(v);
}

// Two indices of `ways`.
struct ArithmeticPair {
    std::size_t a, b;
};

// A box of 3 x 3 pixels per pair, threshold and side.
Item edges_item(int width, int height, const std::vector<ArithmeticPair>& pairs, std::uint64_t seed,
                const std::string& name) {
    Item item{.name = name, .decides = position_fields, .width = width, .height = height};
    Draw draw;
    RandomGenerator random{seed};
    constexpr float thresholds[]{0, 0x1p-5f, -0x1p-5f, 0x1p-9f, -0x1p-9f, 0x1p-13f, -0x1p-13f};
    std::size_t number = 0;
    for (int y = 0; y + 3 <= item.height; y += 3)
        for (int x = 0; x + 3 <= item.width; x += 3, ++number) {
            const ArithmeticPair pair = pairs[number % pairs.size()];
            const float threshold = thresholds[number / pairs.size() % 7];
            const bool is_left = number / (7 * pairs.size()) % 2 == 0;
            const float left = static_cast<float>(x);
            const ClipVertex at =
                split(random, item, ways[pair.a], ways[pair.b], left + (is_left ? 0.5f : 1.5f) + threshold);
            if (at.w > 0) add_split_box(item, draw, at, left, static_cast<float>(y), is_left);
        }
    item.draws = {draw};
    return item;
}

// Every way paired with every other, in 5 rows of 4.
std::vector<ArithmeticPair> all_pairs() {
    std::vector<ArithmeticPair> pairs;
    for (std::size_t step = 1; step < 5; ++step)
        for (std::size_t a = 0; a < 5; ++a) pairs.push_back({a, (a + step) % 5});
    return pairs;
}
// Ways that differ only in the viewport.
std::vector<ArithmeticPair> viewport_pairs() { return {{0, 1}, {2, 3}, {1, 0}, {3, 2}}; }

Item flat_item(DepthFormat format, const std::string& name) {
    Item item{.name = name, .decides = position_fields};
    item.depth = format;
    item.depth_near = 0.1f;
    item.depth_far = 0.9f;
    Draw draw;
    RandomGenerator random{12};
    for (int y = 0; y < item.height; y += 4)
        for (int x = 0; x < item.width; x += 4) {
            const float z = random.between(-1, 1), w = random.between(0.25f, 8.0f);
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 4.0f, top + 4.0f, white, z, w);
        }
    item.draws = {draw};
    return item;
}

}  // namespace

void add_positions(std::vector<Item>& items) {
    items.push_back(edges_item(91, 61, all_pairs(), 11, "positions.edges"));
    items.push_back(edges_item(181, 121, viewport_pairs(), 13, "positions.edges-again"));
    items.push_back(flat_item(DepthFormat::d32f, "positions.depth"));
}

}  // namespace strata::probe
