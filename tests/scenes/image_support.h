// tests/scenes/image_support.h - targets that contain every kind of code.
#pragma once
#include <cstdint>
#include <random>

#include "pipeline/formats/image.h"

namespace strata::test {

// Extreme codes first (zeros, ones, infinities, quiet and signalling NaN with payloads, denormals), then random ones.
inline pipeline::Image wild_image(pipeline::Format format, int width, int height, unsigned seed) {
    using pipeline::ChannelType;
    constexpr std::uint32_t half[] = {0x0000, 0x8000, 0x3c00, 0x7c00, 0xfc00, 0x7c01,
                                      0x7dff, 0xfe01, 0xffff, 0x0001, 0x83ff, 0x7bff};
    constexpr std::uint32_t single[] = {0,          0x80000000, 0x3f800000, 0x7f800000, 0xff800000, 0x7f800001,
                                        0x7fbfffff, 0xffc12345, 0xffffffff, 0x00000001, 0x807fffff, 0x7f7fffff};
    const ChannelType type = pipeline::info(format).type;
    const std::uint32_t mask = type == ChannelType::unorm8                                           ? 0xffu
                               : type == ChannelType::half                                           ? 0xffffu
                               : format == pipeline::Format::d16 || format == pipeline::Format::d16f ? 0xffffu
                               : format == pipeline::Format::d24                                     ? 0xffffffu
                                                                                                     : 0xffffffffu;
    pipeline::Image image{format, width, height};
    std::mt19937 random{seed};
    for (std::size_t i = 0; i < image.codes.size(); ++i) {
        const auto dice = static_cast<std::uint32_t>(random());
        const std::uint32_t special = type == ChannelType::half ? half[dice % 12] : single[dice % 12];
        image.codes[i] = (dice & 0x1000) != 0 ? special & mask : static_cast<std::uint32_t>(random()) & mask;
    }
    return image;
}

}  // namespace strata::test
