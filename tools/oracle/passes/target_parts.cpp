#include "tools/oracle/passes/target_parts.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <memory>
#include <vector>

#include "rasterizer/base/float_environment.h"
#include "scenes/files/image_formats.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

namespace {

using pipeline::ChannelType;
using pipeline::Format;
using pipeline::Image;

constexpr std::string_view channel_letters = "RGBA";

// Codes that are not values: a channel of bits follows.
bool has_integers(ChannelType type) noexcept { return type == ChannelType::unorm8 || type == ChannelType::unorm10; }

std::vector<scenes::StoredChannel> channels_of(Format format) {
    const pipeline::FormatInfo info = pipeline::info(format);
    std::vector<scenes::StoredChannel> channels;
    const auto values = info.type == ChannelType::half ? scenes::StoredType::half : scenes::StoredType::single;
    switch (info.type) {
        case ChannelType::stencil: return {{"S", scenes::StoredType::word}};
        case ChannelType::depth: return {{"Z", scenes::StoredType::single}, {"Zbits", scenes::StoredType::word}};
        case ChannelType::unorm8:
        case ChannelType::unorm10:
        case ChannelType::half:
        case ChannelType::single: break;
    }
    for (int c = 0; c < info.channels; ++c)
        channels.push_back({std::string(1, channel_letters[static_cast<std::size_t>(c)]), values});
    if (has_integers(info.type))
        for (int c = 0; c < info.channels; ++c)
            channels.push_back(
                {fmt::format("{}bits", channel_letters[static_cast<std::size_t>(c)]), scenes::StoredType::word});
    return channels;
}

void append(std::vector<std::byte>& bytes, auto word) {
    const auto own = std::bit_cast<std::array<std::byte, sizeof word>>(word);
    bytes.insert(bytes.end(), own.begin(), own.end());
}

// One pixel's channels in the order of channels_of.
void append_pixel(std::vector<std::byte>& bytes, const Image& image, const std::uint32_t* codes) {
    const ChannelType type = pipeline::info(image.format).type;
    const auto channels = static_cast<std::size_t>(image.channels());
    if (type == ChannelType::depth)
        append(bytes, static_cast<float>(rasterizer::depth_value(codes[0], pipeline::depth_format(image.format))));
    for (std::size_t c = 0; c < channels; ++c) {
        if (type == ChannelType::half)
            append(bytes, static_cast<std::uint16_t>(codes[c]));
        else if (has_integers(type))
            append(bytes, scenes::blended_value(image.format, static_cast<int>(c), codes[c]));
        else
            append(bytes, codes[c]);
    }
    for (std::size_t c = 0; c < channels && has_integers(type); ++c) append(bytes, codes[c]);
}

scenes::PartSource part_of(const NamedImage& target, int sample) {
    const Image& image = target.image;
    scenes::PartHeader header{.width = image.width, .height = image.height, .channels = channels_of(image.format)};
    header.name = name_of_sample(target.name, sample, image.samples);
    const std::string format{pipeline::info(image.format).name};
    if (pipeline::is_color(image.format)) header.attributes["strata:format.color"] = format;
    if (pipeline::is_depth(image.format)) header.attributes["strata:format.depth"] = format;
    header.attributes["strata:digest"] = pipeline::digest(image);
    const auto bytes = std::make_shared<std::vector<std::byte>>();
    return {.header = header, .rows = [&image, sample, bytes](int first, int last) {
                bytes->clear();
                for (int y = first; y < last; ++y)
                    for (int x = 0; x < image.width; ++x)
                        append_pixel(*bytes, image, &image.codes[image.index(x, y, 0, sample)]);
                return static_cast<const std::byte*>(bytes->data());
            }};
}

}  // namespace

void write_targets(const std::string& path, std::span<const NamedImage> targets) {
    const FloatEnvironment ours;
    std::vector<scenes::PartSource> parts;
    for (const NamedImage& target : targets)
        for (int sample = 0; sample < target.image.samples; ++sample) parts.push_back(part_of(target, sample));
    scenes::write_exr_parts(path, parts);
}

}  // namespace strata::oracle
