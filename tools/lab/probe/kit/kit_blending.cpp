// tools/lab/probe/kit/kit_blending.cpp - the probe's test scenes for blending and the alpha test. A device draws the
// scenes of a kit, and its pictures decide the profile fields that an item names in `decides`.
//
// Rule     Items keep their names, random seeds and order: answers that devices have given refer to them, and the kit's
//          digest is kept by a test.
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"

namespace strata::probe {

namespace {

using pipeline::BlendEquation;
using pipeline::BlendFactor;
using pipeline::BlendTerm;
using pipeline::Format;

// 256 source codes by row and 256 destination codes by column: all pairs of bytes. Both alphas are the code, too.
Item pairs_item(const BlendTerm& term, const std::string& name) {
    Item item{.name = name, .decides = {"blend_rounding"}, .width = 256, .height = 256};
    Draw under, over{.blend = term};
    for (int k = 0; k < 256; ++k) {
        const float code = static_cast<float>(k) / 255.0f, at = static_cast<float>(k);
        add_box(item, under, 0, at, 256, at + 1, {code, code, code, code});
        add_box(item, over, at, 0, at + 1, 256, {code, code, code, code});
    }
    item.draws = {under, over};
    return item;
}

// The same with other codes for red, green and blue than for alpha.
Item mixed_pairs_item(const std::string& name) {
    Item item{.name = name, .decides = {"blend_rounding", "unorm_rounding"}, .width = 256, .height = 256};
    Draw under, over{.blend = BlendTerm{BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha}};
    for (int k = 0; k < 256; ++k) {
        const auto code = [&](int factor, int offset) {
            return static_cast<float>((k * factor + offset) % 256) / 255.0f;
        };
        const float at = static_cast<float>(k);
        add_box(item, under, 0, at, 256, at + 1, {code(1, 0), code(1, 0), code(1, 0), code(1, 0)});
        add_box(item, over, at, 0, at + 1, 256, {code(37, 11), code(83, 5), code(151, 77), code(1, 0)});
    }
    item.draws = {under, over};
    return item;
}

// Triangles with a different colour at each corner: sources between two codes.
Item blended_slopes_item(bool in_perspective, std::uint64_t seed, const std::string& name) {
    Item item{.name = name, .decides = {"blend_rounding", "unorm_rounding"}, .width = 149, .height = 131};
    Draw draw{.blend = BlendTerm{BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha}};
    RandomGenerator random{seed};
    for (int i = 0; i < 80; ++i) {
        std::array<FramePosition, 3> p;
        for (FramePosition& position : p) {
            position = random_position(random, item, 0.0f);
            if (in_perspective) position.w = random.between(0.5f, 4.0f);
        }
        add_triangle(item, draw, p, {random_color(random), random_color(random), random_color(random)});
    }
    item.draws = {draw};
    return item;
}

// Each of the values blended onto each of them.
Item crossed_item(Format format, const BlendTerm& term, const std::vector<float>& values, const std::string& field,
                  const std::string& name) {
    const auto side = static_cast<int>(values.size()) * 4;
    Item item{.name = name, .decides = {field}, .width = side, .height = side, .color = format};
    Draw under, over{.blend = term};
    const auto size = static_cast<float>(side);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Color color{values[k], values[k], values[k], values[k]};
        const float at = static_cast<float>(k) * 4.0f;
        add_box(item, under, 0, at, size, at + 4, color);
        add_box(item, over, at, 0, at + 4, size, color);
    }
    item.draws = {under, over};
    return item;
}

// Overlapping boxes in one draw, each of a few thirds of the format's smallest step: rounding every blend loses other
// parts of the sum than rounding once. Some boxes cross borders of tiles of 64 pixels.
Item overlaps_item(Format format, float step, const std::string& name) {
    Item item{.name = name, .decides = {"blend_storage"}, .width = 144, .height = 80, .color = format};
    RandomGenerator random{71};
    Draw sums{.blend = BlendTerm{BlendEquation::add, BlendFactor::one, BlendFactor::one}};
    for (int k = 0; k < 60; ++k) {
        const auto x = static_cast<float>(random.below(120)), y = static_cast<float>(random.below(60));
        const float value = step * static_cast<float>(random.below(9)) / 3.0f;
        add_box(item, sums, x, y, x + 24, y + 20, {value, 0.5f * value, value, 2.0f * value});
    }
    item.draws = {sums};
    return item;
}

// A NaN that blending produces, because a triangle with a NaN in a vertex is dropped: 3e38 twice is an infinity, and
// that times 0 is NaN. It is combined with numbers on either side.
Item nan_item(BlendEquation equation, const std::string& name) {
    Item item{.name = name, .decides = {"min_max_nan"}, .width = 32, .height = 32, .color = Format::rgba32f};
    const auto layer = [&](BlendTerm term, const Color& color, float x0, float x1) {
        Draw draw{.blend = term};
        add_box(item, draw, x0, 0, x1, 32, color);
        item.draws.push_back(draw);
    };
    const Color large{3e38f, 3e38f, 3e38f, 3e38f}, nothing{0, 0, 0, 0}, one{1, 1, 1, 1}, less{-2, -2, -2, -2};
    const BlendTerm sum{BlendEquation::add, BlendFactor::one, BlendFactor::one};
    const BlendTerm product{BlendEquation::add, BlendFactor::dst_color, BlendFactor::zero};
    layer(sum, large, 0, 24);
    layer(sum, large, 0, 24);
    layer(product, nothing, 0, 16);
    layer({equation, BlendFactor::one, BlendFactor::one}, one, 0, 8);
    layer({equation, BlendFactor::one, BlendFactor::one}, less, 8, 32);
    return item;
}

std::vector<float> small_values() {
    return {0.0f,      0x1p-126f, 0x1p-127f, -0x1p-127f, 0x1p-149f, 0x1.8p-126f, -0x1.4p-126f,
            0x1p-100f, 0x1p-30f,  0x1p-60f,  0.5f,       0x1p-64f,  0x1p-70f,    1.0f};
}

// Alphas slightly off the reference of the test, by less than 8 bits can represent.
Item alpha_item(Format format, const std::string& name) {
    Item item{.name = name, .decides = {"alpha_test"}, .color = format};
    RandomGenerator random{70};
    for (int y = 0; y < item.height; y += 4) {
        const float reference = random.between(0.1f, 0.9f);
        Draw draw{.alpha_above = reference};
        for (int x = 0; x < item.width; x += 4) {
            const float alpha = reference + 0x1p-10f * static_cast<float>(random.below(9) - 4);
            const auto left = static_cast<float>(x), top = static_cast<float>(y);
            add_box(item, draw, left, top, left + 4, top + 4, {0.5f, 0.25f, 0.75f, alpha});
        }
        item.draws.push_back(draw);
    }
    return item;
}

}  // namespace

void add_blending(std::vector<Item>& items) {
    items.push_back(pairs_item({BlendEquation::add, BlendFactor::dst_color, BlendFactor::zero}, "blend.products"));
    items.push_back(
        pairs_item({BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha}, "blend.over"));
    items.push_back(mixed_pairs_item("blend.over-mixed"));
    items.push_back(blended_slopes_item(false, 72, "blend.over-slopes"));
    items.push_back(blended_slopes_item(true, 73, "blend.over-slopes-perspective"));
    items.push_back(overlaps_item(Format::rgba8, 1.0f / 255.0f, "blend.overlaps"));
    items.push_back(overlaps_item(Format::rgba16f, 0x1.8p-3f, "blend.overlaps-half"));
    items.push_back(nan_item(BlendEquation::max, "blend.max"));
    items.push_back(nan_item(BlendEquation::min, "blend.min"));
    items.push_back(crossed_item(Format::rgba32f, {BlendEquation::add, BlendFactor::one, BlendFactor::one},
                                 small_values(), "denormals", "blend.small-sums"));
    items.push_back(crossed_item(Format::rgba32f, {BlendEquation::add, BlendFactor::dst_color, BlendFactor::zero},
                                 small_values(), "denormals", "blend.small-products"));
    items.push_back(alpha_item(Format::rgba8, "alpha.unorm8"));
    items.push_back(alpha_item(Format::rgba32f, "alpha.float"));
}

}  // namespace strata::probe
