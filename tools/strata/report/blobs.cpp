#include "tools/strata/report/blobs.h"

#include "tools/strata/report/picture_bytes.h"

namespace strata::tools {

namespace {

template <class Word>
std::vector<std::uint8_t> planes(std::span<const Word> values) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size_bytes());
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
        for (const Word value : values) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * plane)));
    return bytes;
}

std::string packed(std::string_view text) { return base64(deflated(text)); }

}  // namespace

std::size_t Blobs::add_bytes(const std::vector<std::uint8_t>& bytes) {
    encoded_.push_back(packed({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
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
