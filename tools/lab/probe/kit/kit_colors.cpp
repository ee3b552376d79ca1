// tools/lab/probe/kit/kit_colors.cpp - scenes for interpolated colours and their conversion to a target's codes.
#include <cmath>

#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"
#include "tools/lab/probe/kit/split_weights.h"

namespace strata::probe {

namespace {

using pipeline::Format;

const std::vector<std::string> color_fields{
    "raster.color",       "raster.perspective",     "raster.vertex_color_bits",  "raster.perspective_color",
    "raster.weights",     "raster.reciprocal_bits", "raster.reciprocal_deficit", "raster.plane_rule",
    "raster.plane_origin"};

struct SlopesFrame {
    int width = 61, height = 47, triangles = 30;
};
// A few of ten thousand pixels distinguish two reciprocals.
constexpr SlopesFrame large{251, 199, 250};

// Different colours at the corners; w is 1 or varies.
Item slopes_item(Format format, bool in_perspective, std::uint64_t seed, const std::string& name,
                 const SlopesFrame& frame = {}) {
    Item item{.name = name, .decides = color_fields, .width = frame.width, .height = frame.height, .color = format};
    Draw draw;
    RandomGenerator random{seed};
    for (int i = 0; i < frame.triangles; ++i) {
        std::array<FramePosition, 3> p;
        std::array<Color, 3> c;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = random_position(random, item, 0.0f);
            if (in_perspective) p[k].w = random.between(0.5f, 4.0f);
            c[k] = random_color(random);
        }
        add_triangle(item, draw, p, c);
    }
    item.draws = {draw};
    return item;
}

// One colour per triangle, and w that vary: planes stepped in binary32 do not keep the colour.
Item equal_corners_item(std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = {"raster.equal_colors"}, .width = 61, .height = 47, .color = Format::rgba32f};
    Draw draw;
    RandomGenerator random{seed};
    for (int i = 0; i < 40; ++i) {
        std::array<FramePosition, 3> p;
        for (FramePosition& position : p) {
            position = random_position(random, item, 0.0f);
            position.w = random.between(0.5f, 4.0f);
        }
        const Color color = random_color(random);
        add_triangle(item, draw, p, {color, color, color});
    }
    item.draws = {draw};
    return item;
}

// Corners on pixel centres: a weight that is a whole number of 256ths is on the edge of its 8 bits for any area, and
// the last bits of a reciprocal decide it. Also with w that are powers of two.
Item even_weights_item(bool in_perspective, std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = color_fields, .width = 128, .height = 128};
    Draw draw;
    RandomGenerator random{seed};
    for (int i = 0; i < 160; ++i) {
        std::array<FramePosition, 3> p;
        std::array<Color, 3> c;
        const int x = random.below(96), y = random.below(96);
        for (std::size_t k = 0; k < 3; ++k) {
            p[k].x = static_cast<float>(x + random.below(32)) + 0.5f;
            p[k].y = static_cast<float>(y + random.below(32)) + 0.5f;
            if (in_perspective) p[k].w = static_cast<float>(1 << random.below(3));
            c[k] = random_color(random);
        }
        add_triangle(item, draw, p, c);
    }
    item.draws = {draw};
    return item;
}

// One cell of 8 x 8 pixels per triangle whose weights at a pixel differ between two reciprocals.
Item split_weights_item(std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = color_fields, .width = 128, .height = 128};
    Draw draw;
    RandomGenerator random{seed};
    for (int top = 0; top < item.height; top += 8)
        for (int left = 0; left < item.width; left += 8) {
            const std::optional<SplitTriangle> found = split_triangle(random);
            if (!found) continue;
            std::array<FramePosition, 3> p;
            std::array<Color, 3> c;
            // An offset that every snapping rule rounds away, for either direction of rows in every second cell.
            constexpr float hair = 0x1p-14f;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k].x = static_cast<float>(left) + static_cast<float>(found->x[k]) / 16.0f + hair;
                p[k].y = static_cast<float>(top) + static_cast<float>(found->y[k]) / 16.0f +
                         (left / 8 % 2 == 0 ? hair : -hair);
                p[k].w = found->w[k];
                // Very different colours: a weight's step of 1/256 is one code.
                c[k] = {k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, 1.0f};
            }
            add_triangle(item, draw, p, c);
        }
    item.draws = {draw};
    return item;
}

// Triangles of at most about a pixel, whose facing depends on their snapped corners.
Item slivers_item(std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = color_fields, .width = 96, .height = 96, .color = Format::rgba32f};
    item.decides.emplace_back("raster.subpixel_bits");
    item.decides.emplace_back("raster.snap");
    Draw draw;
    RandomGenerator random{seed};
    for (int y = 0; y < item.height; ++y)
        for (int x = 0; x < item.width; ++x) {
            std::array<FramePosition, 3> p;
            std::array<Color, 3> c;
            const bool lies = random.below(2) == 0;
            for (std::size_t k = 0; k < 3; ++k) {
                // Around the centre, in a strip that is thin in one direction.
                const float thin = 1.0f / static_cast<float>(4 << random.below(7));
                const float along = random.between(-1.0f, 1.0f), across = random.between(-thin, thin);
                p[k].x = static_cast<float>(x) + 0.5f + (lies ? along : across);
                p[k].y = static_cast<float>(y) + 0.5f + (lies ? across : along);
                p[k].w = random.between(0.5f, 4.0f);
                c[k] = random_color(random);
            }
            add_triangle(item, draw, p, c);
        }
    item.draws = {draw};
    return item;
}

// Flat colours slightly off the middle between two 8-bit codes, and all tenths.
Item codes_item() {
    Item item{.name = "color.codes", .decides = {"unorm_rounding", "raster.color", "raster.vertex_color_bits"}};
    Draw draw;
    RandomGenerator random{62};
    for (int y = 0; y < item.height; y += 2)
        for (int x = 0; x < item.width; x += 2) {
            Color c;
            for (float& channel : c) {
                const double half = (random.below(255) + 0.5) / 255.0;
                channel = static_cast<float>(half);
                const int ulps = random.below(5) - 2;
                for (int i = 0; i < std::abs(ulps); ++i) channel = std::nextafter(channel, ulps < 0 ? 0.0f : 1.0f);
                if (random.below(4) == 0) channel = static_cast<float>(random.below(11)) / 10.0f;
            }
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 2, top + 2, c);
        }
    item.draws = {draw};
    return item;
}

// A clear value is no vertex colour, so that its conversion is seen where vertex colours have 8 bits. Each channel is
// slightly below the middle of an odd code and the next one, and times 255 it is that middle in binary32. (Above an
// even code SwiftShader's clear rounds the product half up: DRIVERS.md.)
Item clear_item(int first, const std::string& name) {
    Item item{.name = name, .decides = {"unorm_rounding"}, .width = 8, .height = 8};
    int found = 0;
    for (int code = first; found < 4; code += 2) {
        const float middle = static_cast<float>(code) + 0.5f;
        for (float value = middle / 255.0f; value * 255.0f == middle; value = std::nextafter(value, 0.0f))
            if (double{value} * 255 < double{middle}) {
                item.clear[static_cast<std::size_t>(found++)] = value;
                break;
            }
    }
    Draw draw;
    add_box(item, draw, 0, 0, 4, 8, {0, 1, 0, 1});
    item.draws = {draw};
    return item;
}

// The same for halves: between two of them, slightly above their middle, and beyond the largest finite one, where an
// infinity and a code of one more binade differ.
Item clear_halves_item() {
    Item item{.name = "color.clear-halves", .decides = {"half_rounding"}, .width = 8, .height = 8};
    item.color = Format::rgba16f;
    item.clear = {0x1.004p0f, 0x1.00201p0f, 70000.0f, -0x1.006p-3f};
    Draw draw;
    add_box(item, draw, 0, 0, 4, 8, {0, 1, 0, 1});
    item.draws = {draw};
    return item;
}

// Flat values of many exponents, at and near the middle between two halves.
Item halves_item() {
    Item item{.name = "color.halves", .decides = {"half_rounding"}, .color = Format::rgba16f};
    Draw draw;
    RandomGenerator random{63};
    for (int y = 0; y < item.height; y += 2)
        for (int x = 0; x < item.width; x += 2) {
            Color c;
            for (float& channel : c) {
                const double mantissa = 1.0 + random.below(2048) / 2048.0 + 0x1p-20 * (random.below(3) - 1);
                const double scaled = std::ldexp(mantissa, random.below(34) - 18);
                channel = static_cast<float>(random.below(2) == 0 ? scaled : -scaled);
            }
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 2, top + 2, c);
        }
    item.draws = {draw};
    return item;
}

}  // namespace

void add_colors(std::vector<Item>& items) {
    items.push_back(slopes_item(Format::rgba32f, true, 60, "color.perspective-float"));
    items.push_back(slopes_item(Format::rgba8, false, 64, "color.flat-w"));
    items.push_back(slopes_item(Format::rgba8, true, 61, "color.perspective"));
    items.push_back(slopes_item(Format::rgba8, false, 65, "color.flat-w-large", large));
    items.push_back(slopes_item(Format::rgba8, true, 66, "color.perspective-large", large));
    items.push_back(equal_corners_item(74, "color.equal-corners"));
    items.push_back(even_weights_item(false, 67, "color.even-weights"));
    items.push_back(even_weights_item(true, 68, "color.even-weights-perspective"));
    items.push_back(split_weights_item(70, "color.split-weights"));
    items.push_back(slivers_item(69, "color.slivers"));
    items.push_back(codes_item());
    items.push_back(clear_item(21, "color.clear"));
    items.push_back(clear_item(161, "color.clear-again"));
    items.push_back(clear_halves_item());
    items.push_back(halves_item());
}

}  // namespace strata::probe
