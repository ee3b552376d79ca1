// scenes/files/picture_attributes.cpp - the text chunks of a PNG and the attributes of an EXR file, by which an image
// states how it was made (picture_attributes.h).
#include "scenes/files/picture_attributes.h"

#include <span>

#include "scenes/exr/parts.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/text_file.h"

namespace strata::scenes {
namespace {

constexpr std::string_view prefix = "strata:";

void add(Attributes& attributes, const std::string& key, std::string value) {
    if (key.starts_with(prefix)) attributes.emplace(key.substr(prefix.size()), std::move(value));
}

std::size_t big_endian32(std::string_view bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

// PNG 11.3.4.3: a tEXt chunk is a keyword, a zero byte and the text. The chunks are complete: read_image_header has
// checked them.
Attributes png_attributes(const std::string& path) {
    constexpr std::size_t largest = std::size_t{1} << 30, signature = 8, around = 12, type = 4, data = 8;
    const std::string file = read_text_file(path, largest);
    static_cast<void>(read_image_header(std::as_bytes(std::span{file}), FileLocation{path, ""}));
    const std::string_view bytes = file;
    Attributes attributes;
    for (std::size_t at = signature; at + around <= bytes.size(); at += around + big_endian32(bytes, at)) {
        if (bytes.substr(at + type, 4) == "IEND") break;
        if (bytes.substr(at + type, 4) != "tEXt") continue;
        const std::string_view text = bytes.substr(at + data, big_endian32(bytes, at));
        const std::size_t zero = text.find('\0');
        if (zero != text.npos) add(attributes, std::string(text.substr(0, zero)), std::string(text.substr(zero + 1)));
    }
    return attributes;
}

Attributes exr_attributes(const std::string& path) {
    Attributes attributes;
    bool is_first = true;
    exr::read_parts(path, [&](StoredPart&& part) {
        if (!is_first) return;
        for (const auto& [key, value] : part.header.attributes) add(attributes, key, value);
        is_first = false;
    });
    return attributes;
}

}  // namespace

Attributes read_attributes(const std::string& path) {
    return image_file(path) == ImageFile::png ? png_attributes(path) : exr_attributes(path);
}

}  // namespace strata::scenes
