// tools/lab/probe/kit/kit_depth.cpp - scenes for a fragment's depth: its plane, its conversion to a code, and polygon
// offset.
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"
#include "tools/lab/probe/kit/split_depths.h"

namespace strata::probe {

namespace {

const std::vector<std::string> depth_fields{"raster.depth_path",      "raster.plane_rule",
                                            "raster.plane_origin",    "raster.window_z",
                                            "raster.depth_rounding",  "raster.window_z_rule",
                                            "raster.plane_anchor",    "raster.weights",
                                            "raster.reciprocal_bits", "raster.reciprocal_deficit",
                                            "raster.sum_bits",        "raster.interpolant_bits",
                                            "raster.divide",          "depth24"};

void add_slopes(const Item& item, Draw& draw, RandomGenerator& random, int count) {
    for (int i = 0; i < count; ++i) {
        std::array<FramePosition, 3> p;
        for (FramePosition& position : p) {
            position = random_position(random, item, 0.0f);
            position.w = random.between(0.5f, 4.0f);
        }
        const Color color = code_color(i);
        add_triangle(item, draw, p, {color, color, color});
    }
}

// The frame's sides are odd, so a rule that is anchored at the frame's middle differs from one at its corner.
Item slopes_item(DepthFormat format, int count, std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = depth_fields, .width = 61, .height = 47};
    item.depth = format;
    Draw draw;
    RandomGenerator random{seed};
    add_slopes(item, draw, random, count);
    item.draws = {draw};
    return item;
}

// A depth range whose ends are no whole numbers.
Item range_item(DepthFormat format, std::uint64_t seed, const std::string& name) {
    Item item = slopes_item(format, 60, seed, name);
    item.depth_near = 0.3f;
    item.depth_far = 0.85f;
    return item;
}

// One cell of 8 x 8 pixels per triangle that distinguishes two neighbouring reciprocals.
Item split_reciprocals_item(std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = depth_fields, .width = 128, .height = 128};
    item.depth = DepthFormat::d24;
    Draw draw;
    RandomGenerator random{seed};
    const std::vector<TwoReciprocals> pairs = neighbouring_reciprocals();
    for (int i = 0; i < 256; ++i) {
        const std::optional<SplitDepths> found =
            split_depths(random, pairs[static_cast<std::size_t>(i) % pairs.size()]);
        if (!found) continue;
        const auto left = static_cast<float>(i % 16 * 8), top = static_cast<float>(i / 16 * 8);
        // An offset that every snapping rule rounds away, for either direction of rows in every second cell.
        constexpr float hair = 0x1p-14f;
        std::array<FramePosition, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = {left + static_cast<float>(found->x[k]) / 16.0f + hair,
                    top + static_cast<float>(found->y[k]) / 16.0f + (i % 2 == 0 ? hair : -hair), found->z[k], 1.0f};
        const Color color = code_color(i);
        add_triangle(item, draw, p, {color, color, color});
    }
    item.draws = {draw};
    return item;
}

// Flat depths slightly off the middle between two codes, and slightly off a code.
Item codes_item(DepthFormat format, const std::string& name) {
    Item item{.name = name, .decides = {"raster.depth_rounding", "raster.depth_path", "raster.window_z", "depth24"}};
    item.depth = format;
    Draw draw;
    RandomGenerator random{22};
    const int bits = format == DepthFormat::d16 ? 16 : 24;
    const double greatest = (1 << bits) - 1;
    for (int y = 0; y < item.height; y += 2)
        for (int x = 0; x < item.width; x += 2) {
            const auto code = static_cast<double>(random.next() >> (32 - bits));
            const double part = 0.25 * random.below(4), hair = 0x1p-12 * (random.below(3) - 1);
            const double depth = (code + part + hair) / greatest;
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 2, top + 2, white, static_cast<float>(depth * 2.0 - 1.0));
        }
    item.draws = {draw};
    return item;
}

Item offset_item(DepthFormat format, const std::string& name) {
    Item item{.name = name, .decides = {"raster.offset_unit", "raster.offset_rule"}, .width = 61, .height = 47};
    item.depth = format;
    RandomGenerator random{31};
    constexpr rasterizer::PolygonOffset offsets[]{{true, 0, 1},      {true, 0, -3},   {true, 1.5f, 0},
                                                  {true, -2.25f, 2}, {true, 0, 1000}, {true, 1, 1}};
    for (const rasterizer::PolygonOffset& offset : offsets) {
        Draw draw{.offset = offset};
        add_slopes(item, draw, random, 3);
        item.draws.push_back(draw);
    }
    return item;
}

// At several distances from the eye, because a unit that follows the exponent of z changes with it.
Item offset_flat_item(DepthFormat format, const std::string& name) {
    Item item{.name = name, .decides = {"raster.offset_unit", "raster.offset_rule"}};
    item.depth = format;
    RandomGenerator random{32};
    for (int y = 0; y < item.height; y += 8) {
        Draw draw{.offset = {true, 0, static_cast<float>(y + 1)}};
        for (int x = 0; x < item.width; x += 8) {
            // Window depths of 2^-1 to 2^-8.
            const float depth = random.between(0.5f, 0.9f) / static_cast<float>(1 << (x / 8));
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 8, top + 8, white, depth * 2.0f - 1.0f);
        }
        item.draws.push_back(draw);
    }
    return item;
}

// Offsets that move depths of up to 3 codes inside the depth range beyond either of its ends.
Item offset_beyond_item(DepthFormat format, float near, float far, const std::string& name) {
    Item item{.name = name, .decides = {"raster.depth_limits", "raster.z_clip"}};
    item.depth = format;
    item.depth_near = near;
    item.depth_far = far;
    RandomGenerator random{33};
    const float code = format == DepthFormat::d16 ? 0x1p-15f : 0x1p-23f;
    for (int y = 0; y < item.height; y += 8) {
        const float end = y % 16 == 0 ? -1.0f : 1.0f;
        Draw draw{.offset = {true, 0, end * static_cast<float>(4 << (y / 8))}};
        for (int x = 0; x < item.width; x += 8) {
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 8, top + 8, white, end - end * code * random.between(0, 3));
        }
        item.draws.push_back(draw);
    }
    return item;
}

}  // namespace

void add_depth(std::vector<Item>& items) {
    items.push_back(slopes_item(DepthFormat::d24, 24, 20, "depth.d24"));
    items.push_back(slopes_item(DepthFormat::d32f, 24, 21, "depth.d32f"));
    items.push_back(slopes_item(DepthFormat::d16, 24, 23, "depth.d16"));
    items.push_back(slopes_item(DepthFormat::d24, 60, 24, "depth.d24-again"));
    items.push_back(slopes_item(DepthFormat::d32f, 60, 25, "depth.d32f-again"));
    items.push_back(range_item(DepthFormat::d24, 27, "depth.range-d24"));
    items.push_back(range_item(DepthFormat::d16, 28, "depth.range-d16"));
    items.push_back(range_item(DepthFormat::d32f, 29, "depth.range-d32f"));
    items.push_back(split_reciprocals_item(26, "depth.split-reciprocals"));
    items.push_back(codes_item(DepthFormat::d24, "depth.codes-d24"));
    items.push_back(codes_item(DepthFormat::d16, "depth.codes-d16"));
    items.push_back(offset_item(DepthFormat::d24, "offset.d24"));
    items.push_back(offset_item(DepthFormat::d16, "offset.d16"));
    items.push_back(offset_item(DepthFormat::d32f, "offset.d32f"));
    items.push_back(offset_flat_item(DepthFormat::d24, "offset.flat-d24"));
    items.push_back(offset_flat_item(DepthFormat::d32f, "offset.flat-d32f"));
    items.push_back(offset_beyond_item(DepthFormat::d24, 0, 1, "offset.beyond-d24"));
    items.push_back(offset_beyond_item(DepthFormat::d16, 0, 1, "offset.beyond-d16"));
    items.push_back(offset_beyond_item(DepthFormat::d32f, 0, 1, "offset.beyond-d32f"));
    items.push_back(offset_beyond_item(DepthFormat::d24, 0.25f, 0.75f, "offset.beyond-range-d24"));
    items.push_back(offset_beyond_item(DepthFormat::d32f, 0.25f, 0.75f, "offset.beyond-range-d32f"));
}

}  // namespace strata::probe
