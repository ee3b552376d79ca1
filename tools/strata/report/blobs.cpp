#include "tools/strata/report/blobs.h"

#include <zlib.h>

#include <new>

namespace strata::tools {

namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t three = std::uint32_t{bytes[i]} << 16 | (left > 1 ? std::uint32_t{bytes[i + 1]} << 8 : 0) |
                                    (left > 2 ? std::uint32_t{bytes[i + 2]} : 0);
        for (std::size_t digit = 0; digit < 4; ++digit)
            text += digit <= left ? digits[three >> (18 - 6 * digit) & 63] : '=';
    }
    return text;
}

std::vector<std::uint8_t> deflated(const std::uint8_t* bytes, std::size_t size) {
    uLongf room = ::compressBound(static_cast<uLong>(size));
    std::vector<std::uint8_t> packed(room);
    // It fails for want of memory alone: the room is enough.
    if (::compress2(packed.data(), &room, bytes, static_cast<uLong>(size), Z_BEST_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    packed.resize(room);
    return packed;
}

template <class Word>
std::vector<std::uint8_t> planes(std::span<const Word> values) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size_bytes());
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
        for (const Word value : values) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * plane)));
    return bytes;
}

std::string packed(std::string_view text) {
    return base64(deflated(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace

std::size_t Blobs::add_bytes(const std::vector<std::uint8_t>& bytes) {
    encoded_.push_back(base64(deflated(bytes.data(), bytes.size())));
    return encoded_.size() - 1;
}

std::size_t Blobs::add(std::span<const std::uint8_t> values) { return add_bytes(planes(values)); }
std::size_t Blobs::add(std::span<const std::uint16_t> values) { return add_bytes(planes(values)); }
std::size_t Blobs::add(std::span<const std::uint32_t> values) { return add_bytes(planes(values)); }
std::size_t Blobs::add_text(std::string_view text) {
    encoded_.push_back(packed(text));
    return encoded_.size() - 1;
}

std::size_t packed_size(std::string_view text) { return packed(text).size(); }

std::size_t Blobs::size() const noexcept {
    std::size_t characters = 0;
    for (const std::string& blob : encoded_) characters += blob.size();
    return characters;
}

std::string Blobs::html() const {
    std::string text;
    for (const std::string& blob : encoded_)
        text += "<script type=\"text/plain\" class=\"blob\">" + blob + "</script>\n";
    return text;
}

}  // namespace strata::tools
