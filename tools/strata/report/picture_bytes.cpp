#include "tools/strata/report/picture_bytes.h"

#include <zlib.h>

#include <new>

namespace strata::tools {

namespace {

std::string big_endian(std::uint32_t word) {
    return {static_cast<char>(word >> 24), static_cast<char>(word >> 16), static_cast<char>(word >> 8),
            static_cast<char>(word)};
}

// Length, name and data, and the check over the last two.
std::string chunk(const std::string& name, const std::string& data) {
    const std::string checked = name + data;
    const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    return big_endian(static_cast<std::uint32_t>(data.size())) + checked + big_endian(static_cast<std::uint32_t>(sum));
}

}  // namespace

std::string deflated(std::string_view bytes) {
    uLongf room = ::compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(room, '\0');
    // It fails for want of memory alone: the room is enough.
    if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &room, reinterpret_cast<const Bytef*>(bytes.data()),
                    static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    packed.resize(room);
    return packed;
}

std::string base64(std::string_view bytes) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? std::uint32_t{static_cast<std::uint8_t>(bytes[i])} : 0u;
    };
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (std::size_t digit = 0; digit < 4; ++digit)
            text += digit <= bytes.size() - i ? digits[three >> (18 - 6 * digit) & 63] : '=';
    }
    return text;
}

std::string png_bytes(const pipeline::Image& image) {
    std::string rows;
    for (int y = 0; y < image.height; ++y) {
        rows += '\0';
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) rows += static_cast<char>(image.codes[image.index(x, y, c)]);
    }
    constexpr char bits = 8, red_green_blue = 2;
    const std::string header = big_endian(static_cast<std::uint32_t>(image.width)) +
                               big_endian(static_cast<std::uint32_t>(image.height)) +
                               std::string{bits, red_green_blue, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", deflated(rows)) + chunk("IEND", "");
}

}  // namespace strata::tools
