// tools/oracle/picture/read_picture.cpp - reads EXR files, and formats that OpenImageIO supports, into a Picture (rule:
// picture.h).
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "pipeline/formats/format.h"
#include "rasterizer/base/input_error.h"
#include "scenes/exr/parts.h"
#include "scenes/file_ending.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/image_formats.h"
#include "tools/oracle/picture/numbers_file.h"
#include "tools/oracle/picture/picture.h"
#include "tools/oracle/picture/read_deep.h"

namespace strata::oracle {

namespace {

using scenes::StoredPart;

Code code_of_channel(scenes::StoredType type) noexcept {
    switch (type) {
        case scenes::StoredType::half: return Code::half;
        case scenes::StoredType::single: return Code::single;
        case scenes::StoredType::word: break;
    }
    return Code::integer;
}

// A part written by Strata states the format of its codes.
TargetImage of_image(const scenes::FileImage& found) {
    TargetImage target = as_target(found.image, found.target);
    target.part = found.part;
    return target;
}

// Channels of one type in the given order. They may be unaligned, so they are copied.
TargetImage of_channels(const StoredPart& part, const std::vector<std::string>& names, Meaning meaning) {
    TargetImage target{
        .part = part.header.name, .meaning = meaning, .width = part.header.width, .height = part.header.height};
    target.channels = static_cast<int>(names.size());
    target.codes.resize(target.pixels() * names.size());
    const std::size_t stride = pixel_bytes(part.header);
    for (std::size_t c = 0; c < names.size(); ++c) {
        const scenes::ChannelLayout place = *scenes::find_channel(part.header, names[c]);
        target.code = code_of_channel(place.type);
        for (std::size_t i = 0; i < target.pixels(); ++i)
            std::memcpy(&target.codes[i * names.size() + c], &part.bytes[i * stride + place.offset],
                        size_of(place.type));
    }
    return target;
}

// A part with only a depth target: its codes have the format that the part names.
TargetImage own_depth(const StoredPart& part, const std::string& format) {
    TargetImage target = of_channels(part, {"Zbits"}, Meaning::depth);
    target.name = "depth";
    for (const pipeline::Format known : {pipeline::Format::d16, pipeline::Format::d24, pipeline::Format::d24s8,
                                         pipeline::Format::d32f, pipeline::Format::d16f, pipeline::Format::d24f})
        if (pipeline::info(known).name == format) target.code = code_of(known);
    return target;
}

// A part from another program: its colours, its depth, and every other channel as its own target.
void add_foreign(const StoredPart& part, const std::string& path, int number, std::vector<TargetImage>& targets) {
    std::vector<std::string> colors, others;
    for (const char* name : {"R", "G", "B", "A"})
        if (scenes::find_channel(part.header, name)) colors.emplace_back(name);
    const auto type_of = [&](const std::string& name) { return scenes::find_channel(part.header, name)->type; };
    for (const std::string& name : colors)
        if (type_of(name) != type_of(colors[0]))
            throw InputError(path, fmt::format("part {}", number), "colour channels R, G, B and A of one type",
                             "channels of several types");
    if (!colors.empty()) {
        targets.push_back(of_channels(part, colors, Meaning::color));
        targets.back().name = "color";
        targets.back().alpha_form = AlphaForm::premultiplied;  // required by the format
    }
    for (const scenes::StoredChannel& channel : part.header.channels) {
        if (std::ranges::find(colors, channel.name) != colors.end()) continue;
        const bool is_depth = channel.name == "Z";
        targets.push_back(of_channels(part, {channel.name}, is_depth ? Meaning::depth : Meaning::other));
        targets.back().name = is_depth ? "depth" : channel.name;
    }
}

Picture read_exr(const std::string& path) {
    Picture picture{path, {}};
    scenes::exr::read_parts(path, [&, number = 0](StoredPart&& part) mutable {
        const auto fail = [&](const char* expected, const char* found) {
            throw InputError(path, fmt::format("part {}", number), expected, found);
        };
        if (!part.is_whole) fail("pixels that OpenEXR can read", "a truncated or damaged image");
        if (part.header.is_deep) {
            for (TargetImage& layer : layers_of_deep(part, path)) {
                if (part.header.name.starts_with("sample.")) layer.part = part.header.name + "." + layer.part;
                picture.targets.push_back(std::move(layer));
            }
        } else if (const std::string format = scenes::attribute(part.header, "format.depth");
                   scenes::attribute(part.header, "format.color").empty() && !format.empty())
            picture.targets.push_back(own_depth(part, format));
        else if (scenes::attribute(part.header, "format.color").empty())
            add_foreign(part, path, number, picture.targets);
        else
            for (const scenes::FileImage& image : scenes::as_images(part, number, path)) {
                picture.targets.push_back(of_image(image));
                const bool is_straight = scenes::attribute(part.header, "alpha") == "straight";
                if (image.target == "color")
                    picture.targets.back().alpha_form = is_straight ? AlphaForm::straight : AlphaForm::premultiplied;
            }
        ++number;
    });
    return picture;
}

Picture read_by(const char* reader, const std::string& path) {
    scenes::FileCodes stored = scenes::read_codes(path, reader);
    const Code halves_or_codes = stored.is_float ? Code::half : Code::unorm16;
    TargetImage target{.name = "color",
                       .code = stored.bits == 8    ? Code::unorm8
                               : stored.bits == 16 ? halves_or_codes
                                                   : Code::single,
                       .width = stored.width,
                       .height = stored.height,
                       .channels = stored.channels,
                       .codes = std::move(stored.codes),
                       .is_grey = stored.channels < 3,
                       .alpha_form = AlphaForm::straight,
                       .holds_encoded = !stored.is_float};
    return {path, {std::move(target)}};
}

}  // namespace

Code code_of(pipeline::Format format) {
    switch (pipeline::info(format).type) {
        case pipeline::ChannelType::unorm8: return Code::unorm8;
        case pipeline::ChannelType::unorm10: return Code::unorm10;
        case pipeline::ChannelType::half: return Code::half;
        case pipeline::ChannelType::single: return Code::single;
        case pipeline::ChannelType::stencil: return Code::integer;
        case pipeline::ChannelType::depth: break;
    }
    switch (pipeline::depth_format(format)) {
        case pipeline::DepthFormat::d16: return Code::unorm16;
        case pipeline::DepthFormat::d24: return Code::unorm24;
        case pipeline::DepthFormat::d16f:
        case pipeline::DepthFormat::d24f: return Code::integer;
        case pipeline::DepthFormat::d32f: break;
    }
    return Code::single;
}

TargetImage as_target(const pipeline::Image& image, std::string name) {
    TargetImage target{.name = std::move(name),
                       .meaning = pipeline::is_depth(image.format) ? Meaning::depth : Meaning::color,
                       .code = code_of(image.format),
                       .width = image.width,
                       .height = image.height,
                       .channels = image.channels(),
                       .holds_encoded = image.format == pipeline::Format::srgb8_alpha8};
    target.codes.assign(image.codes.begin(), image.codes.end());
    return target;
}

Picture read_picture(const std::string& path, const std::optional<RawLayout>& layout) {
    if (scenes::has_ending(path, ".exr")) return read_exr(path);
    if (scenes::has_ending(path, ".npy")) return {path, {read_npy(path)}};
    if (const char* const reader = scenes::reader_of(path)) return read_by(reader, path);
    if (layout) return {path, {read_raw(path, *layout)}};
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw InputError(path, "no such file");
    throw InputError(
        path, "name",
        "a file that ends in .exr, .npy, .png, .jpg, .ppm, .pgm, .tga, .bmp, .tif or .hdr, or --layout for a file of "
        "raw numbers",
        "another ending");
}

}  // namespace strata::oracle
