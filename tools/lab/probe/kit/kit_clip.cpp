// tools/lab/probe/kit/kit_clip.cpp - scenes with triangles that leave the view volume: where they are clipped, and with
// which arithmetic.
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"

namespace strata::probe {

namespace {

const std::vector<std::string> clip_fields{"raster.clip",     "raster.z_clip",        "raster.w_clip",
                                           "raster.viewport", "raster.window_z_rule", "raster.plane_corners"};

Item plain_item(const std::string& name, const std::vector<std::string>& decides) {
    return {.name = name, .decides = decides, .width = 61, .height = 47};
}

// The location of a corner outside: left or right, up or down, near or far, behind the eye.
enum class Beyond : std::uint8_t { side, near_far, eye, all };

Item beyond_item(Beyond beyond, DepthFormat format, std::uint64_t seed, const std::string& name, int triangles = 24) {
    Item item = plain_item(name, clip_fields);
    item.depth = format;
    Draw draw;
    RandomGenerator random{seed};
    for (int i = 0; i < triangles; ++i) {
        std::array<FramePosition, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool leaves = k == 0 || (beyond == Beyond::all && random.below(2) == 0);
            p[k] = random_position(random, item, leaves && beyond != Beyond::near_far ? 90.0f : 0.0f);
            if (leaves && (beyond == Beyond::near_far || beyond == Beyond::all))
                p[k].z = random.between(1.0f, 3.0f) * (random.below(2) == 0 ? 1.0f : -1.0f);
            p[k].w = random.between(0.5f, 4.0f);
        }
        // The corner is given in clip space: w < 0, with x and y of its magnitude.
        const Color color = code_color(i);
        add_triangle(item, draw, p, {color, color, color});
        if (beyond == Beyond::eye) draw.corners[draw.corners.size() - 3].w = -random.between(0.1f, 2.0f);
    }
    item.draws = {draw};
    return item;
}

// The same in a larger frame with other sides, and with a depth range that is not a power of two: x, y and z depend on
// the last bit of a new corner's window position.
Item corners_item(Beyond beyond, std::uint64_t seed, const std::string& name) {
    Item item = beyond_item(beyond, DepthFormat::d32f, seed, name, 90);
    item.width = 149;
    item.height = 131;
    item.depth_near = 0.1f;
    item.depth_far = 0.9f;
    return item;
}

// Slopes of a few codes that cross the near or the far plane: whether a fragment is outside depends on the last bit.
Item skimming_item(DepthFormat format, std::uint64_t seed, const std::string& name) {
    Item item = plain_item(name, {"raster.z_clip", "raster.depth_limits", "raster.window_z_rule", "raster.weights",
                                  "raster.sum_bits", "raster.reciprocal_bits", "raster.reciprocal_deficit"});
    item.depth = format;
    Draw draw;
    RandomGenerator random{seed};
    const float code = format == DepthFormat::d16 ? 0x1p-15f : 0x1p-23f;
    for (int i = 0; i < 40; ++i) {
        std::array<FramePosition, 3> p;
        const float plane = random.below(2) == 0 ? -1.0f : 1.0f;
        for (FramePosition& position : p) {
            position = random_position(random, item, 0.0f);
            position.z = plane + code * random.between(-4, 4);
        }
        const Color color = code_color(i);
        add_triangle(item, draw, p, {color, color, color});
    }
    item.draws = {draw};
    return item;
}

// Row y contains a triangle that reaches that far out of the frame on both sides. A smaller guard band clips it, and
// the rounding of the new corners has an effect in the frame's middle, which is equally far from both.
Item guard_item(DepthFormat format, const std::string& name) {
    Item item = plain_item(name, {"raster.guard_band_px"});
    const std::vector<int> all = guard_reaches();
    item.width = 8;
    item.height = static_cast<int>(all.size());
    item.depth = format;
    Draw draw;
    RandomGenerator random{53};
    for (std::size_t row = 0; row < all.size(); ++row) {
        const float reach = static_cast<float>(all[row]) + 0.75f, top = static_cast<float>(row);
        std::array<FramePosition, 3> p{FramePosition{-reach, top}, {reach, top}, {reach, top + 2.0f}};
        for (FramePosition& position : p) position.z = random.between(-0.9f, 0.9f);
        const Color color = code_color(static_cast<int>(row));
        add_triangle(item, draw, p, {color, color, color});
    }
    item.draws = {draw};
    return item;
}

}  // namespace

std::vector<int> guard_reaches() {
    std::vector<int> all;
    for (int reach = 512; reach < 524288; reach += reach / 24) all.push_back(reach);
    return all;
}

void add_clip(std::vector<Item>& items) {
    items.push_back(beyond_item(Beyond::side, DepthFormat::d32f, 40, "clip.sides"));
    items.push_back(beyond_item(Beyond::side, DepthFormat::d24, 41, "clip.sides-d24"));
    items.push_back(beyond_item(Beyond::near_far, DepthFormat::d32f, 42, "clip.near-far"));
    items.push_back(beyond_item(Beyond::near_far, DepthFormat::d24, 43, "clip.near-far-d24"));
    items.push_back(beyond_item(Beyond::eye, DepthFormat::d32f, 44, "clip.eye"));
    items.push_back(beyond_item(Beyond::eye, DepthFormat::d24, 45, "clip.eye-d24"));
    items.push_back(beyond_item(Beyond::all, DepthFormat::d32f, 46, "clip.all"));
    items.push_back(beyond_item(Beyond::all, DepthFormat::d24, 47, "clip.all-d24"));
    items.push_back(corners_item(Beyond::side, 48, "clip.corners-of-sides"));
    items.push_back(corners_item(Beyond::near_far, 49, "clip.corners-of-near-far"));
    items.push_back(corners_item(Beyond::all, 50, "clip.corners-of-all"));
    items.push_back(skimming_item(DepthFormat::d24, 54, "clip.skimming-d24"));
    items.push_back(skimming_item(DepthFormat::d16, 55, "clip.skimming-d16"));
    items.push_back(guard_item(DepthFormat::d32f, "clip.guard-band"));
    items.push_back(guard_item(DepthFormat::d24, "clip.guard-band-d24"));
}

}  // namespace strata::probe
