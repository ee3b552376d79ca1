#include "tools/strata/report/picture_bytes.h"

#include <zlib.h>

#include <new>

namespace strata::tools {

std::string deflated(std::string_view bytes) {
    uLongf room = ::compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(room, '\0');
    // compress2 can fail only for lack of memory, because the buffer is large enough.
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

}  // namespace strata::tools
