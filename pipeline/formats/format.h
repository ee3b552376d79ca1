// pipeline/formats/format.h - the formats of render targets.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::DepthFormat;
using rasterizer::DepthRounding;

// Colour formats have 1, 2 or 4 channels. Depth and stencil have separate targets (d24s8 is a d24 and an s8). The
// narrow formats of GeForce3's surfaces are stored as the 8-bit codes that the blender reads back (narrow.h), the
// packed ones as codes of equal value with the same width in all channels (packed.h).
enum class Format : std::uint8_t {
    rgba8,
    rgba16f,
    rgba32f,
    r16f,
    r32f,
    rg32f,
    d16,
    d24,
    d24s8,
    d32f,
    s8,
    d16f,
    x8r8g8b8,
    x1a7r8g8b8,
    r5g6b5,
    x1r5g5b5,
    d24f,
    srgb8_alpha8,
    rgb10_a2,
    r11g11b10f
};

// The meaning of a channel's code: k / 255, the bits of a half, the bits of a float, a depth code, eight bits of
// stencil, or k / 1023.
enum class ChannelType : std::uint8_t { unorm8, half, single, depth, stencil, unorm10 };

struct FormatInfo {
    std::string_view name;
    ChannelType type;
    // Colour channels; 1 for depth and for stencil.
    int channels;
    // As stored by the device, for the counters of bytes read and written.
    int bytes_per_pixel;
};

// A narrow or packed format is listed with four channels of its codes' type and the bytes per pixel of the device.
[[nodiscard]] constexpr FormatInfo info(Format format) noexcept {
    switch (format) {
        case Format::rgba8: return {"rgba8", ChannelType::unorm8, 4, 4};
        case Format::rgba16f: return {"rgba16f", ChannelType::half, 4, 8};
        case Format::rgba32f: return {"rgba32f", ChannelType::single, 4, 16};
        case Format::r16f: return {"r16f", ChannelType::half, 1, 2};
        case Format::r32f: return {"r32f", ChannelType::single, 1, 4};
        case Format::rg32f: return {"rg32f", ChannelType::single, 2, 8};
        case Format::d16: return {"d16", ChannelType::depth, 1, 2};
        case Format::d24: return {"d24", ChannelType::depth, 1, 4};
        case Format::d24s8: return {"d24s8", ChannelType::depth, 1, 4};
        case Format::d32f: return {"d32f", ChannelType::depth, 1, 4};
        case Format::s8: return {"s8", ChannelType::stencil, 1, 1};
        case Format::d16f: return {"d16f", ChannelType::depth, 1, 2};
        case Format::d24f: return {"d24f", ChannelType::depth, 1, 4};
        case Format::x8r8g8b8: return {"x8r8g8b8", ChannelType::unorm8, 4, 4};
        case Format::x1a7r8g8b8: return {"x1a7r8g8b8", ChannelType::unorm8, 4, 4};
        case Format::r5g6b5: return {"r5g6b5", ChannelType::unorm8, 4, 2};
        case Format::srgb8_alpha8: return {"srgb8_alpha8", ChannelType::unorm8, 4, 4};
        case Format::rgb10_a2: return {"rgb10_a2", ChannelType::unorm10, 4, 4};
        case Format::r11g11b10f: return {"r11g11b10f", ChannelType::half, 4, 4};
        case Format::x1r5g5b5: break;
    }
    return {"x1r5g5b5", ChannelType::unorm8, 4, 2};
}

[[nodiscard]] constexpr bool is_color(Format f) noexcept {
    const ChannelType t = info(f).type;
    return t != ChannelType::depth && t != ChannelType::stencil;
}
// True for surfaces that store less than 8 bits of some channel, or no alpha.
[[nodiscard]] constexpr bool is_narrow(Format f) noexcept {
    return f == Format::x8r8g8b8 || f == Format::x1a7r8g8b8 || f == Format::r5g6b5 || f == Format::x1r5g5b5;
}
// True for formats that pack a pixel into 32 bits of channels that differ in kind or width (packed.h).
[[nodiscard]] constexpr bool is_packed(Format f) noexcept {
    return f == Format::srgb8_alpha8 || f == Format::rgb10_a2 || f == Format::r11g11b10f;
}
[[nodiscard]] constexpr bool is_depth(Format f) noexcept { return info(f).type == ChannelType::depth; }
[[nodiscard]] constexpr bool has_stencil(Format f) noexcept { return f == Format::d24s8 || f == Format::s8; }

// The code format of a depth target. Precondition: `f` is a depth format. d24 and d24s8 have the same codes.
[[nodiscard]] constexpr DepthFormat depth_format(Format f) noexcept {
    switch (f) {
        case Format::d16: return DepthFormat::d16;
        case Format::d16f: return DepthFormat::d16f;
        case Format::d24f: return DepthFormat::d24f;
        case Format::d32f: return DepthFormat::d32f;
        default: return DepthFormat::d24;
    }
}
// The depth target without stencil that stores codes of that format.
[[nodiscard]] constexpr Format target_format(DepthFormat f) noexcept {
    switch (f) {
        case DepthFormat::d16: return Format::d16;
        case DepthFormat::d24: return Format::d24;
        case DepthFormat::d16f: return Format::d16f;
        case DepthFormat::d24f: return Format::d24f;
        case DepthFormat::d32f: break;
    }
    return Format::d32f;
}

}  // namespace strata::pipeline
