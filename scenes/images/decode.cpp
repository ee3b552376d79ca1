// scenes/images/decode.cpp - decodes a PNG or JPEG in memory to 8-bit RGBA (rule: files/image_decode.h).
#include <memory>
#include <stdexcept>

#include "scenes/images/openimageio.h"
#include "scenes/images/orientation.h"
#include "scenes/images/scaled_pnm.h"

namespace strata::scenes::images {
namespace {

using Codes = std::vector<std::uint8_t>;

// A size that is impossible for a file of so many bytes is rejected before memory for its pixels is allocated.
void check_size(const OIIO::ImageSpec& spec, std::size_t file_bytes, const FileLocation& location) {
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
    if (spec.width < 1 || spec.height < 1 || spec.width > static_cast<int>(max_image_side) ||
        spec.height > static_cast<int>(max_image_side))
        location.fail("VALUE_NOT_IN_RANGE", "an image of 1 x 1 to 16384 x 16384", size);
    if (spec.image_bytes() / max_packing > file_bytes)
        location.fail("IMAGE_UNEXPECTED_EOS", "a file that can hold " + size + " pixels",
                      std::to_string(file_bytes) + " bytes");
}

std::unique_ptr<OIIO::ImageInput> open(OIIO::Filesystem::IOProxy& memory, const EncodedPicture& picture,
                                       const FileLocation& location) {
    std::unique_ptr<OIIO::ImageInput> reader = OIIO::ImageInput::create(picture.reader);
    if (!reader) throw std::runtime_error(std::string("OpenImageIO has no reader named ") + picture.reader);
    OIIO::ImageSpec spec, how;
    // By default the reader would multiply the colours by alpha.
    how.attribute("oiio:UnassociatedAlpha", 1);
    reader->set_ioproxy(&memory);
    if (!reader->open(std::string("image.") + picture.reader, spec, how))
        location.fail("IMAGE_DATA_INVALID", "an image that OpenImageIO can decode", in_quotes(reader->geterror()));
    // The memory budget was charged for the header's size: a decoder that finds another size is stopped before it
    // writes.
    if (picture.width != 0 && (spec.width != picture.width || spec.height != picture.height))
        location.fail(
            "IMAGE_DATA_INVALID",
            "the header's " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels",
            std::to_string(spec.width) + " x " + std::to_string(spec.height));
    if (spec.depth != 1 || spec.nchannels < 1 || spec.nchannels > 4 || (spec.nchannels == 4 && spec.alpha_channel != 3))
        location.fail("IMAGE_DATA_INVALID", "1 to 4 channels: grey or RGB, with or without alpha",
                      std::to_string(spec.nchannels) + " channels");
    check_size(spec, picture.bytes.size(), location);
    // A code is stored in 32 bits, next to the reader's.
    const std::uint64_t bytes_a_channel = sizeof(std::uint32_t) + spec.format.size();
    if (picture.check != nullptr)
        picture.check(location, spec.width, spec.height, bytes_a_channel * static_cast<std::uint64_t>(spec.nchannels));
    return reader;
}

// The reader of TIFF reports success where pixels could not be read, and keeps a message.
void check_read(bool has_read, OIIO::ImageInput& reader, const FileLocation& location) {
    if (has_read && !reader.has_error()) return;
    const std::string why = reader.geterror();
    location.fail("IMAGE_DATA_INVALID", "an image that OpenImageIO can decode",
                  why.empty() ? "one that ends too early or is damaged" : in_quotes(why));
}

// All channels as stored, 8 bits each.
Codes read(OIIO::ImageInput& reader, const FileLocation& location) {
    const OIIO::ImageSpec& spec = reader.spec();
    const std::size_t count = static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels;
    // 16-bit channels are read unchanged: the reader's own conversion to 8 bits has another rounding rule.
    const bool is_wide = spec.format == OIIO::TypeDesc::UINT16;
    std::vector<std::uint16_t> wide(is_wide ? count : 0);
    Codes codes(is_wide ? 0 : count);
    void* const target = is_wide ? static_cast<void*>(wide.data()) : codes.data();
    const OIIO::TypeDesc type = is_wide ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    check_read(reader.read_image(0, 0, 0, spec.nchannels, type, target), reader, location);
    if (!is_wide) return codes;
    codes.reserve(count);
    // c / 257 to the nearest code, as 65535 = 255 * 257. The sum is below 2^17 and fits an int.
    for (const std::uint16_t c : wide) codes.push_back(static_cast<std::uint8_t>((c + 128) / 257));
    return codes;
}

// 1, 2, 3 or 4 channels; grey is copied to red, green and blue, and a missing alpha is 255.
Codes to_rgba(const Codes& codes, std::size_t channels) {
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    Codes texels;
    texels.reserve(codes.size() / channels * 4);
    for (std::size_t i = 0; i < codes.size(); i += channels) {
        for (std::size_t c = 0; c < 3; ++c) texels.push_back(codes[is_grey ? i : i + c]);
        texels.push_back(has_alpha ? codes[i + channels - 1] : std::uint8_t{255});
    }
    return texels;
}

}  // namespace

Codes decode(const EncodedPicture& picture, const FileLocation& location) {
    OIIO::Filesystem::IOMemReader memory(picture.bytes.data(), picture.bytes.size());
    const auto reader = open(memory, picture, location);
    Codes codes = read(*reader, location);
    const auto channels = static_cast<std::size_t>(reader->spec().nchannels);
    reader->close();
    return channels == 4 ? codes : to_rgba(codes, channels);
}

namespace {

// All codes as unsigned integers of their own width.
template <class Word>
void read_words(OIIO::ImageInput& reader, OIIO::TypeDesc type, const FileLocation& location, FileCodes& to) {
    const OIIO::ImageSpec& spec = reader.spec();
    std::vector<Word> words(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
    check_read(reader.read_image(0, 0, 0, spec.nchannels, type, words.data()), reader, location);
    to.codes.assign(words.begin(), words.end());
}

// The fourth byte of a BMP's pixel is alpha in some files and 0 in others: if it is 0 everywhere, there is no alpha.
void drop_empty_alpha(FileCodes& stored) {
    for (std::size_t i = 3; i < stored.codes.size(); i += 4)
        if (stored.codes[i] != 0) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < stored.codes.size(); ++i)
        if (i % 4 != 3) stored.codes[to++] = stored.codes[i];
    stored.codes.resize(to);
    stored.channels = 3;
}

}  // namespace

FileCodes decode_codes(const EncodedPicture& picture, const FileLocation& location) {
    OIIO::Filesystem::IOMemReader memory(picture.bytes.data(), picture.bytes.size());
    const auto reader = open(memory, picture, location);
    const OIIO::ImageSpec& spec = reader->spec();
    FileCodes stored{.width = spec.width, .height = spec.height, .channels = spec.nchannels};
    const std::string_view bytes{reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size()};
    if (auto scaled = scaled_pnm(bytes, location, spec.width, spec.height, spec.nchannels)) return *std::move(scaled);
    if (spec.format == OIIO::TypeDesc::UINT16) {
        stored.bits = 16;
        read_words<std::uint16_t>(*reader, OIIO::TypeDesc::UINT16, location, stored);
    } else if (spec.format == OIIO::TypeDesc::HALF) {
        stored.bits = 16;
        stored.is_float = true;
        read_words<std::uint16_t>(*reader, OIIO::TypeDesc::HALF, location, stored);
    } else if (spec.format == OIIO::TypeDesc::FLOAT) {
        stored.bits = 32;
        stored.is_float = true;
        read_words<std::uint32_t>(*reader, OIIO::TypeDesc::FLOAT, location, stored);
    } else if (spec.format == OIIO::TypeDesc::UINT8) {
        read_words<std::uint8_t>(*reader, OIIO::TypeDesc::UINT8, location, stored);
    } else {
        location.fail("IMAGE_DATA_INVALID", "channels of type uint8, uint16, half or float",
                      in_quotes(spec.format.c_str()));
    }
    turn_upright(stored, spec.get_int_attribute("Orientation", 1));
    reader->close();
    if (picture.reader == std::string_view{"bmp"} && stored.channels == 4) drop_empty_alpha(stored);
    return stored;
}

}  // namespace strata::scenes::images
