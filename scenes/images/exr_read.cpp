// scenes/images/exr_read.cpp - the parts of an EXR file as bytes in their own types.
#include <OpenImageIO/deepdata.h>

#include <cstring>
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/images/openimageio.h"

namespace strata::scenes::images {
namespace {

using OIIO::TypeDesc;

constexpr int max_size = 16384;

void check_size(const std::string& path, const OIIO::ImageSpec& spec) {
    const bool plain = spec.depth == 1 && spec.nchannels > 0;
    if (plain && spec.width > 0 && spec.height > 0 && spec.width <= max_size && spec.height <= max_size) return;
    throw InputError(path, "size", "at most 16384x16384",
                     std::to_string(spec.width) + "x" + std::to_string(spec.height));
}

std::unique_ptr<OIIO::ImageInput> open(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw InputError(path, "file", "an image", "no file of that name");
    auto input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    if (input == nullptr || !input->open(path, spec)) throw InputError(path, "file", "an EXR image", "something else");
    for (int part = 0; input->seek_subimage(part, 0); ++part) check_size(path, input->spec());
    (void)input->geterror();  // the last seek's
    return input;
}

// EXR has these three types alone.
StoredType as_stored(TypeDesc type) noexcept {
    if (type == TypeDesc::HALF) return StoredType::half;
    return type == TypeDesc::FLOAT ? StoredType::single : StoredType::word;
}

PartHeader header_of(const OIIO::ImageSpec& spec) {
    PartHeader header{.width = spec.width, .height = spec.height, .is_deep = spec.deep};
    header.name = spec.get_string_attribute("oiio:subimagename").str();
    for (int c = 0; c < spec.nchannels; ++c)
        header.channels.push_back({spec.channel_name(c).str(), as_stored(spec.channelformat(c))});
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == TypeDesc::STRING)
            header.attributes.emplace(attribute.name().string(), attribute.get_string());
    return header;
}

void read_flat(OIIO::ImageInput& input, int number, StoredPart& part) {
    const OIIO::ImageSpec spec = input.spec(number, 0);
    part.bytes.resize(spec.image_bytes(true));
    part.is_whole = input.read_image(number, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, part.bytes.data());
}

void read_deep(OIIO::ImageInput& input, int number, StoredPart& part) {
    OIIO::DeepData data;
    part.is_whole = input.read_native_deep_image(number, 0, data);
    if (!part.is_whole) return;
    const auto& channels = part.header.channels;
    for (std::int64_t pixel = 0; pixel < data.pixels(); ++pixel) {
        part.samples.push_back(static_cast<std::uint32_t>(data.samples(pixel)));
        for (int sample = 0; sample < data.samples(pixel); ++sample)
            for (std::size_t c = 0; c < channels.size(); ++c) {
                const auto* from = static_cast<const std::byte*>(data.data_ptr(pixel, static_cast<int>(c), sample));
                part.bytes.insert(part.bytes.end(), from, from + size_of(channels[c].type));
            }
    }
}

}  // namespace

void read_exr(const std::string& path, const std::function<void(StoredPart&&)>& take) {
    const auto input = open(path);
    for (int number = 0; input->seek_subimage(number, 0); ++number) {
        StoredPart part{.header = header_of(input->spec())};
        if (part.header.is_deep)
            read_deep(*input, number, part);
        else
            read_flat(*input, number, part);
        (void)input->geterror();  // `is_whole` says it
        take(std::move(part));
    }
    (void)input->geterror();  // the last seek's
}

}  // namespace strata::scenes::images
