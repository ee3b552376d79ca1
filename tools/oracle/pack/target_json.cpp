#include "tools/oracle/pack/target_json.h"

#include <algorithm>

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;
using pipeline::ChannelType;
using pipeline::Format;
using pipeline::Image;
using scenes::Element;
using scenes::NumberArray;

Image part_of(const Image& image, int x0, int y0) {
    Image part{image.format, std::min(pack_tile_px, image.width - x0), std::min(pack_tile_px, image.height - y0),
               image.samples};
    const std::size_t row = part.size() / static_cast<std::size_t>(part.height);
    for (int y = 0; y < part.height; ++y)
        std::copy_n(image.codes.begin() + static_cast<std::ptrdiff_t>(image.index(x0, y0 + y)), row,
                    part.codes.begin() + static_cast<std::ptrdiff_t>(part.index(0, y)));
    return part;
}

// The digest of each channel's codes, in elements of their own width.
ordered_json channel_digests(const Image& image) {
    ordered_json digests = ordered_json::array();
    const auto channels = static_cast<std::size_t>(image.channels());
    for (std::size_t c = 0; c < channels; ++c) {
        NumberArray codes{.element = element_of(image.format)};
        for (std::size_t i = c; i < image.codes.size(); i += channels) codes.append(image.codes[i]);
        digests.push_back(scenes::digest_of_bytes(codes.bytes));
    }
    return digests;
}

ordered_json tile_digests(const Image& image) {
    ordered_json digests = ordered_json::array();
    for (int y = 0; y < image.height; y += pack_tile_px)
        for (int x = 0; x < image.width; x += pack_tile_px) digests.push_back(pipeline::digest(part_of(image, x, y)));
    return digests;
}

}  // namespace

Element element_of(Format format) noexcept {
    switch (pipeline::info(format).type) {
        case ChannelType::unorm8:
        case ChannelType::stencil: return Element::u1;
        case ChannelType::unorm10: return Element::u2;
        case ChannelType::half: return Element::f2;
        case ChannelType::single: return Element::f4;
        case ChannelType::depth: break;
    }
    switch (pipeline::depth_format(format)) {
        case pipeline::DepthFormat::d16:
        case pipeline::DepthFormat::d16f: return Element::u2;
        case pipeline::DepthFormat::d24:
        case pipeline::DepthFormat::d24f: return Element::u4;
        case pipeline::DepthFormat::d32f: break;
    }
    return Element::f4;
}

NumberArray as_array(const Image& image) {
    NumberArray array{.element = element_of(image.format),
                      .shape = {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)}};
    if (image.samples > 1) array.shape.push_back(static_cast<std::size_t>(image.samples));
    if (image.samples > 1 || image.channels() > 1) array.shape.push_back(static_cast<std::size_t>(image.channels()));
    array.bytes.reserve(image.codes.size() * scenes::bytes_of(array.element));
    for (const std::uint32_t code : image.codes) array.append(code);
    return array;
}

std::optional<Image> as_image(const NumberArray& array, Format format, int samples) {
    if (array.element != element_of(format) || array.shape.size() < 2 || array.count() == 0) return std::nullopt;
    // The shape is compared before memory is allocated; its size is that of the file.
    Image image{format, 1, 1, samples};
    std::vector<std::size_t> shape = as_array(image).shape;
    shape[0] = array.shape[0], shape[1] = array.shape[1];
    if (shape != array.shape) return std::nullopt;
    image = {format, static_cast<int>(array.shape[1]), static_cast<int>(array.shape[0]), samples};
    for (std::size_t i = 0; i < image.codes.size(); ++i) image.codes[i] = array.word(i);
    return image;
}

ordered_json TargetWriter::write(const std::string& place, const std::string& name, const Image& image) {
    const std::string file = folder_ + "/" + place + name + ".npy";
    const std::string digest = pipeline::digest(image);
    files_.add(file, as_array(image));
    last_[name] = {digest, file};
    return {{"name", name},
            {"format", pipeline::info(image.format).name},
            {"samples", image.samples},
            {"file", file},
            {"digest", digest},
            {"channels", channel_digests(image)},
            {"tile_size", pack_tile_px},
            {"tiles", tile_digests(image)}};
}

ordered_json TargetWriter::write_once(const std::string& place, const std::string& name, const Image& image) {
    const auto last = last_.find(name);
    if (last == last_.end() || last->second.digest != pipeline::digest(image)) return write(place, name, image);
    return {{"name", name},
            {"format", pipeline::info(image.format).name},
            {"samples", image.samples},
            {"file", last->second.file},
            {"digest", last->second.digest}};
}

}  // namespace strata::oracle
