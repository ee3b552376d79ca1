// tests/rasterizer/chip_scene.h - random triangles for the chip's interpolators: some have corners that the SIMD
// kernels support, others must fall back to the scalar definitions.
#pragma once
#include "tests/rasterizer/scene.h"

namespace strata::rasterizer {

// The rules that NV20 uses for values of fragments.
[[nodiscard]] inline RasterRules chip_rules() {
    RasterRules rules{.subpixel_bits = 4, .z_clip = ZClip::per_fragment};
    rules.window_z = WindowZ::buffer_units;
    rules.depth_path = DepthPath::window_z;
    rules.depth_rounding = DepthRounding::floor;
    rules.offset_unit = OffsetUnit::buffer;
    rules.offset_rule = OffsetRule::fragments;
    rules.color = ColorInterpolation::weights_8bit;
    rules.interpolation = {.vertex_color_bits = 14,
                           .perspective_color = PerspectiveColor::cut_products,
                           .texture_coordinates = CoordinateRule::cut_weights,
                           .perspective_coordinates = PerspectiveCoordinates::cut_products};
    return rules;
}

// Depths of corners: spread over the format's range and beyond both its ends, equal, 0, one unit apart, too far apart
// for products in binary64, and around the least depth (window_z.h).
[[nodiscard]] inline std::array<double, 3> chip_depths(Random& random, DepthFormat format, int kind) {
    const double units = buffer_units(format);
    const auto within = [&] { return static_cast<float>(double{random_float(random, 0.05f, 0.95f)} * units); };
    const float a = within(), b = within(), c = within();
    switch (kind) {
        case 0: return {double{a} * 1.2, -0.2 * double{b}, c};
        case 1: return {a, a, a};
        case 2: return {0.0, -0.0, b};
        case 3: return {a, std::nextafter(a, b), std::nextafter(a, -b)};
        case 4: return {double{a} * 0x1p-60, b, double{c} * 0x1p-30};
        case 5: return {0x1p-140, double{b} * 0x1p-120, 0.0};
        case 6: return {double{a} / units * 0x1p-124, double{b} / units * 0x1p-125, double{c} / units * 0x1p-124};
        case 7: return {double{a} * 0x1p-60, b, b};
        default: return {a, b, c};
    }
}

// Triangles of about `size` pixels; every third has equal w, every seventh equal attributes.
[[nodiscard]] inline Geometry chip_triangles(std::uint64_t seed, int count, int size, const Device& device) {
    Geometry geometry = random_triangles(seed, count, size, device);
    Random random{seed + 1};
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::array<double, 3> z = chip_depths(random, device.depth.format, static_cast<int>(i % 11));
        for (std::size_t k = 0; k < 3; ++k) {
            geometry.corners[geometry.triangles[i].vertex[k]].z = static_cast<float>(z[k]);
            geometry.offset_z[i][k] = static_cast<double>(static_cast<float>(z[k]));
        }
    }
    return geometry;
}

}  // namespace strata::rasterizer
