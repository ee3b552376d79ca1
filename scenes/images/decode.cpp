// scenes/images/decode.cpp - a PNG or JPEG in memory to 8-bit RGBA; files/image_decode.h states the rule.
#include <memory>
#include <stdexcept>

#include "scenes/images/openimageio.h"

namespace strata::scenes::images {
namespace {

using Codes = std::vector<std::uint8_t>;

std::unique_ptr<OIIO::ImageInput> open(OIIO::Filesystem::IOProxy& memory, const EncodedPicture& picture,
                                       const Place& place) {
    std::unique_ptr<OIIO::ImageInput> reader = OIIO::ImageInput::create(picture.reader);
    if (!reader) throw std::runtime_error(std::string("OpenImageIO has no reader named ") + picture.reader);
    OIIO::ImageSpec spec, how;
    // Straight alpha: the reader would multiply the colours by it.
    how.attribute("oiio:UnassociatedAlpha", 1);
    reader->set_ioproxy(&memory);
    if (!reader->open(std::string("image.") + picture.reader, spec, how))
        place.fail("IMAGE_DATA_INVALID", "an image that decodes", in_quotes(reader->geterror()));
    // The memory budget was paid for the header's size: a decoder that finds another size is stopped before it
    // writes.
    if (spec.width != picture.width || spec.height != picture.height || spec.depth != 1 || spec.nchannels < 1 ||
        spec.nchannels > 4)
        place.fail("IMAGE_DATA_INVALID", "an image of the size that its header says", "another");
    return reader;
}

// All channels as the file has them, 8 bits each.
Codes read(OIIO::ImageInput& reader, const Place& place) {
    const OIIO::ImageSpec& spec = reader.spec();
    const std::size_t count = static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels;
    // 16-bit channels are read as they are: the reader's own way to 8 bits would round by a rule of its own.
    const bool is_wide = spec.format == OIIO::TypeDesc::UINT16;
    std::vector<std::uint16_t> wide(is_wide ? count : 0);
    Codes codes(is_wide ? 0 : count);
    void* const target = is_wide ? static_cast<void*>(wide.data()) : codes.data();
    if (!reader.read_image(0, 0, 0, spec.nchannels, is_wide ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8, target))
        place.fail("IMAGE_DATA_INVALID", "an image that decodes", in_quotes(reader.geterror()));
    if (!is_wide) return codes;
    codes.reserve(count);
    // c / 257 to the nearest code, for 65535 = 255 * 257. The sum stays below 2^17 in int.
    for (const std::uint16_t c : wide) codes.push_back(static_cast<std::uint8_t>((c + 128) / 257));
    return codes;
}

// Grey, grey and alpha, rgb or rgba to rgba.
// 1, 2, 3 or 4 channels; grey fills red, green and blue, and a missing alpha is 255.
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

Codes decode(const EncodedPicture& picture, const Place& place) {
    OIIO::Filesystem::IOMemReader memory(picture.bytes.data(), picture.bytes.size());
    const auto reader = open(memory, picture, place);
    Codes codes = read(*reader, place);
    const auto channels = static_cast<std::size_t>(reader->spec().nchannels);
    reader->close();
    return channels == 4 ? codes : to_rgba(codes, channels);
}

StoredCodes decode_codes(const EncodedPicture& picture, const Place& place) {
    OIIO::Filesystem::IOMemReader memory(picture.bytes.data(), picture.bytes.size());
    const auto reader = open(memory, picture, place);
    const OIIO::ImageSpec& spec = reader->spec();
    StoredCodes stored{.width = spec.width,
                       .height = spec.height,
                       .channels = spec.nchannels,
                       .bits = spec.format == OIIO::TypeDesc::UINT16 ? 16 : 8};
    if (stored.bits == 16) {
        stored.codes.resize(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
        if (!reader->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, stored.codes.data()))
            place.fail("IMAGE_DATA_INVALID", "an image that decodes", in_quotes(reader->geterror()));
    } else {
        const Codes codes = read(*reader, place);
        stored.codes.assign(codes.begin(), codes.end());
    }
    reader->close();
    return stored;
}

}  // namespace strata::scenes::images
