// tools/library/picture.cpp - copies the codes of pictures from and to a program's memory, byte by byte.
#include "strata/picture.h"

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/oracle/picture/numbers_file.h"

namespace strata {
inline namespace v0_1 {

namespace {

// The distance between rows in bytes. Throws InputError unless `rows` rows of `row` bytes at distances of `row_bytes`
// are within `memory` bytes.
std::size_t checked_row_bytes(std::size_t memory, std::size_t row, std::size_t rows, std::size_t row_bytes) {
    if (row_bytes == 0) row_bytes = row;
    if (row_bytes < row)
        throw InputError("picture", "row_bytes", "0 or at least " + std::to_string(row), std::to_string(row_bytes));
    const std::size_t least = (rows - 1) * row_bytes + row;
    if (memory < least)
        throw InputError("picture", "memory", "at least " + std::to_string(least) + " bytes", std::to_string(memory));
    return row_bytes;
}

void check_side(const char* field, int side) {
    if (side < 1 || side > 16384) throw InputError("layout", field, "1 to 16384", std::to_string(side));
}

}  // namespace

oracle::RawLayout layout(std::string_view text) {
    if (const auto found = oracle::raw_layout(text)) return *found;
    throw InputError("layout", "text", oracle::raw_layout_expected, "'" + std::string{text} + "'");
}

Picture from_memory(std::span<const std::byte> memory, const oracle::RawLayout& layout, std::size_t row_bytes) {
    check_side("width", layout.width);
    check_side("height", layout.height);
    if (layout.channels < 1 || layout.channels > 4)
        throw InputError("layout", "channels", "1 to 4", std::to_string(layout.channels));
    const std::size_t row = oracle::own_row_bytes(layout);
    const auto rows = static_cast<std::size_t>(layout.height);
    if (layout.offset >= memory.size())
        throw InputError("layout", "offset", "less than " + std::to_string(memory.size()),
                         std::to_string(layout.offset));
    const std::size_t stride =
        checked_row_bytes(memory.size() - layout.offset, row, rows, row_bytes != 0 ? row_bytes : layout.row_bytes);
    oracle::RawLayout apart = layout;
    apart.row_bytes = stride;
    const std::string_view bytes{reinterpret_cast<const char*>(memory.data()),
                                 layout.offset + (rows - 1) * stride + row};
    return {"memory", {oracle::raw_target(bytes, "memory", apart)}};
}

Picture from_memory(const void* memory, std::size_t bytes, std::string_view text, std::size_t row_bytes) {
    if (memory == nullptr) throw InputError("picture", "memory", "an address", "null");
    return from_memory({static_cast<const std::byte*>(memory), bytes}, layout(text), row_bytes);
}

Picture picture_of(const Image& image) {
    if (image.codes.empty() || image.codes.size() != image.size())
        throw InputError("image", "codes", std::to_string(std::max<std::size_t>(image.size(), 1)),
                         std::to_string(image.codes.size()));
    if (image.samples != 1) throw InputError("image", "samples", "1", std::to_string(image.samples));
    return {"memory", {oracle::as_target(image, pipeline::is_depth(image.format) ? "depth" : "color")}};
}

Picture picture_of(const Image& color, const Image& depth) {
    Picture picture = picture_of(color), behind = picture_of(depth);
    if (color.width != depth.width || color.height != depth.height)
        throw InputError("image", "depth size", std::to_string(color.width) + "x" + std::to_string(color.height),
                         std::to_string(depth.width) + "x" + std::to_string(depth.height));
    picture.targets.push_back(std::move(behind.targets[0]));
    return picture;
}

std::size_t channel_bytes(const Image& image) noexcept {
    switch (pipeline::info(image.format).type) {
        case pipeline::ChannelType::unorm8:
        case pipeline::ChannelType::stencil: return 1;
        case pipeline::ChannelType::unorm10:
        case pipeline::ChannelType::half: return 2;
        case pipeline::ChannelType::depth: return pipeline::info(image.format).bytes_per_pixel == 2 ? 2 : 4;
        case pipeline::ChannelType::single: break;
    }
    return 4;
}

void to_memory(const Image& image, std::span<std::byte> memory, Rows rows, std::size_t row_bytes) {
    static_cast<void>(picture_of(image));  // throws unless the image has one sample
    const std::size_t size = channel_bytes(image), height = static_cast<std::size_t>(image.height);
    const std::size_t codes = image.codes.size() / height;
    row_bytes = checked_row_bytes(memory.size(), codes * size, height, row_bytes);
    for (std::size_t y = 0; y < height; ++y) {
        std::byte* to = memory.data() + (rows == Rows::bottom_up ? height - 1 - y : y) * row_bytes;
        for (std::size_t i = 0; i < codes; ++i) {
            const std::uint32_t code = image.codes[y * codes + i];
            for (std::size_t b = 0; b < size; ++b) *to++ = static_cast<std::byte>(code >> (8 * b) & 0xffu);
        }
    }
}

std::vector<std::byte> to_memory(const Image& image, Rows rows) {
    std::vector<std::byte> memory(image.codes.size() * channel_bytes(image));
    to_memory(image, memory, rows);
    return memory;
}

}  // namespace v0_1
}  // namespace strata
