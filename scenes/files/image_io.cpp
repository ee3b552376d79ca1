// scenes/files/image_io.cpp - shared parts of PNG and EXR: the choice by name, the atomic file around every writer,
// attributes and digests.
#include "scenes/files/image_io.h"

#include <bit>
#include <cassert>

#include "pipeline/formats/half.h"
#include "pipeline/formats/srgb.h"
#include "pipeline/formats/unorm8.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/file_ending.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/image_formats.h"
#include "scenes/files/system_error.h"
#include "scenes/memory_limit.h"

namespace strata::scenes {
ImageFile image_file(const std::string& path) {
    if (has_ending(path, ".png")) return ImageFile::png;
    if (has_ending(path, ".exr")) return ImageFile::exr;
    throw InputError(path, "name", "a file name that ends in .png or .exr", "another ending");
}

// A code is in the low 8, 16 or 32 bits of its word, depending on the type.
float channel_value(pipeline::ChannelType type, std::uint32_t code) noexcept {
    if (type == pipeline::ChannelType::unorm8) return pipeline::from_unorm8(static_cast<std::uint8_t>(code));
    if (type == pipeline::ChannelType::unorm10) return static_cast<float>(code) / 1023.0f;
    if (type == pipeline::ChannelType::half) return pipeline::half_to_float(static_cast<std::uint16_t>(code));
    return std::bit_cast<float>(code);
}

float blended_value(pipeline::Format format, int channel, std::uint32_t code) noexcept {
    if (format == pipeline::Format::srgb8_alpha8 && channel < 3) return pipeline::srgb_to_linear[code & 0xffu];
    return channel_value(pipeline::info(format).type, code);
}

void write_with(const std::string& path, const std::function<std::string(const ByteSink& sink)>& write) {
    AtomicFile file{path};
    // The sink's functions never throw: exceptions must not pass through the library that calls them.
    const std::string failure =
        write({.path = file.temporary(),
               .write = [&](const void* bytes, std::size_t size) { return file.write(bytes, size); },
               .seek = [&](std::int64_t position) { return file.seek(position); },
               .position = [&] { return file.position(); }});
    // If both report a failure, commit() throws the system's reason, which is more precise than the library's.
    if (failure.empty() || file.failed()) return file.commit();  // throws the system's reason
    throw SystemError(path, "write", failure);
}

void write_exr_parts(const std::string& path, std::span<const PartSource> parts) {
    write_with(path, [&](const ByteSink& sink) { return exr::write_parts(sink, parts); });
}

// The prefix separates the project's keys from those that a format or a library interprets.
Attributes prefixed(const Attributes& attributes) {
    Attributes named;
    for (const auto& [key, value] : attributes) named.emplace("strata:" + key, value);
    return named;
}

std::string attribute(const PartHeader& header, const std::string& key) {
    const auto found = header.attributes.find("strata:" + key);
    return found != header.attributes.end() ? found->second : "";
}

std::string name_of(pipeline::ColorSpace space) {
    return space == pipeline::ColorSpace::encoded ? "encoded" : "linear";
}

StoredSpace stored_space(pipeline::ColorSpace space) noexcept {
    return space == pipeline::ColorSpace::encoded ? StoredSpace::srgb : StoredSpace::linear;
}

// Channels are interleaved in a pixel's bytes, in the header's order and without padding.
std::optional<ChannelLayout> find_channel(const PartHeader& header, const std::string& name) {
    std::size_t offset = 0;
    for (const StoredChannel& channel : header.channels) {
        if (channel.name == name) return ChannelLayout{offset, channel.type};
        offset += size_of(channel.type);
    }
    return std::nullopt;
}

// The writer's own keys replace the caller's keys of the same name, because they describe the file's content.
Attributes described(const OutputColor& image) {
    Attributes attributes = image.attributes;
    attributes["format.color"] = pipeline::info(image.color.format).name;
    attributes["digest.color"] = digest(image.color);
    attributes["colour"] = name_of(image.space);
    attributes["alpha"] = image.premultiplied ? "premultiplied" : "straight";
    if (!image.depth.codes.empty()) {
        attributes["format.depth"] = pipeline::info(image.depth.format).name;
        attributes["digest.depth"] = digest(image.depth);
    }
    return attributes;
}

void write_image(const std::string& path, const OutputColor& image) { write_image(path, image, image_file(path)); }

void write_image(const std::string& path, const OutputColor& image, ImageFile kind) {
    const FloatEnvironment environment;
    // Samples are resolved before: an image file has one value per pixel.
    assert(pipeline::is_color(image.color.format) && image.color.samples == 1);
    switch (kind) {
        case ImageFile::png: return write_png(path, image);
        case ImageFile::exr: return write_exr(path, image);
    }
}

// image_header.cpp has read the header; the decoder rejects an image that differs from it.
std::vector<std::uint8_t> decode_image(Bytes bytes, const ImageHeader& header, const FileLocation& location) {
    // Texels, next to the decoder's codes.
    constexpr std::uint64_t bytes_of_a_texel = 8;
    check_memory_need(location.file, location.pointer.empty() ? "size" : location.pointer,
                      {.kind = "an image that takes",
                       .amount = std::to_string(header.width) + "x" + std::to_string(header.height) + ", which takes",
                       .bytes = std::uint64_t{header.width} * header.height * bytes_of_a_texel});
    return image_module().decode({.bytes = bytes,
                                  .reader = header.kind == ImageKind::png ? "png" : "jpeg",
                                  .width = static_cast<int>(header.width),
                                  .height = static_cast<int>(header.height)},
                                 location);
}

std::vector<FileImage> read_images(const std::string& path) {
    const FloatEnvironment environment;
    switch (image_file(path)) {
        case ImageFile::png: return read_png(path);
        case ImageFile::exr: break;
    }
    return read_exr(path);
}

std::vector<FileDigest> digests_of(const std::string& path) {
    const FloatEnvironment environment;
    std::vector<FileDigest> digests;
    const auto add = [&](const FileImage& found) {
        const pipeline::Image& image = found.image;
        digests.push_back({found.part, found.target, std::string{pipeline::info(image.format).name}, image.width,
                           image.height, digest(image)});
    };
    // A PNG is one target; an EXR's parts are read one by one and freed once their digest is known.
    if (image_file(path) == ImageFile::png) {
        for (const FileImage& image : read_png(path)) add(image);
        return digests;
    }
    exr::read_parts(path, [&, number = 0](StoredPart&& part) mutable {
        if (part.header.is_deep) {
            const DeepFragments fragments = as_fragments(part, path);
            digests.push_back(
                {part.header.name, "fragments", "deep", fragments.width, fragments.height, digest(fragments)});
        } else {
            for (const FileImage& image : as_images(part, number, path)) add(image);
        }
        ++number;
    });
    return digests;
}

}  // namespace strata::scenes
