// tools/lab/probe/kit/kit_coverage.cpp - scenes for coverage: subpixel bits, their rounding, and the tie rule.
#include <algorithm>

#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"

namespace strata::probe {

namespace {

const std::vector<std::string> coverage_fields{"raster.subpixel_bits", "raster.snap", "raster.coverage",
                                               "raster.tie_rule"};

// The distance of an edge from a pixel's centre: slightly on either side of every position where rounding to 4, 8 or 12
// bits, truncated or to nearest, decides the coverage; and 0. The offset is 2^-16 pixel.
float near_miss(RandomGenerator& random) {
    constexpr int bits[]{4, 8, 12};
    const int n = bits[random.below(3)];
    const float step = 1.0f / static_cast<float>(1 << n);
    const float threshold = step * 0.5f * static_cast<float>(random.below(5) - 2);
    return threshold + 0x1p-16f * static_cast<float>(random.below(3) - 1);
}

// Cells of 2 x 2 pixels, whose boxes end near the centres.
Item snap_item(std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = coverage_fields};
    Draw draw;
    RandomGenerator random{seed};
    for (int y = 0; y < item.height; y += 2)
        for (int x = 0; x < item.width; x += 2) {
            const float left = static_cast<float>(x) + 0.5f, top = static_cast<float>(y) + 0.5f;
            const float x0 = left + near_miss(random), y0 = top + near_miss(random);
            const float x1 = left + 1.0f + near_miss(random), y1 = top + 1.0f + near_miss(random);
            add_box(item, draw, x0, y0, x1, y1, white);
        }
    item.draws = {draw};
    return item;
}

// Triangles whose corners are multiples of half a pixel: edges of many slopes pass through centres.
Item ties_item() {
    Item item{.name = "coverage.ties", .decides = {"raster.tie_rule", "raster.coverage"}};
    Draw draw;
    RandomGenerator random{3};
    for (int y = 0; y < item.height; y += 8)
        for (int x = 0; x < item.width; x += 8) {
            std::array<FramePosition, 3> p;
            for (FramePosition& position : p) {
                position.x = static_cast<float>(x) + 0.5f * static_cast<float>(random.below(16));
                position.y = static_cast<float>(y) + 0.5f * static_cast<float>(random.below(16));
            }
            add_triangle(item, draw, p, {white, white, white});
        }
    item.draws = {draw};
    return item;
}

// Overlapping triangles of all sizes, each with its own colour; some extend beyond the frame into the guard band.
Item random_item(int count, float size, std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = coverage_fields};
    Draw draw;
    RandomGenerator random{seed};
    for (int i = 0; i < count; ++i) {
        const float x = random.between(0, 64), y = random.between(0, 64);
        std::array<FramePosition, 3> p;
        for (FramePosition& position : p) {
            position.x = std::clamp(x + random.between(-size, size), 0.0f, 64.0f);
            position.y = std::clamp(y + random.between(-size, size), 0.0f, 64.0f);
        }
        const Color color = code_color(i);
        add_triangle(item, draw, p, {color, color, color});
    }
    item.draws = {draw};
    return item;
}

}  // namespace

void add_coverage(std::vector<Item>& items) {
    items.push_back(snap_item(1, "coverage.snap"));
    items.push_back(snap_item(2, "coverage.snap-again"));
    items.push_back(ties_item());
    items.push_back(random_item(60, 40.0f, 4, "coverage.large"));
    items.push_back(random_item(600, 5.0f, 5, "coverage.small"));
}

}  // namespace strata::probe
