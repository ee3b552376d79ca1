// scenes/files/exr.cpp - flat and multi-part EXR files: premultiplied colours for viewers, and the targets' codes for
// comparisons.
//
// Rule     R G B A are premultiplied values. If the target is premultiplied half or binary32 they are its codes bit for
//          bit, in its own type; else they are FLOAT, and the codes are stored in addition as UINT32 `Rbits Gbits Bbits
//          Abits`. `Z` is the depth as a FLOAT, `Zbits` its code. All bits survive: OpenEXR copies each channel in
//          its own type.
// Cost     Colours of a target that is not premultiplied are stored twice; the codes are small after zip compression.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <memory>
#include <optional>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_formats.h"

namespace strata::scenes {
namespace {

using pipeline::ChannelType;
using pipeline::Format;
using pipeline::Image;

constexpr std::string_view channel_names[4] = {"R", "G", "B", "A"};

// True for premultiplied half and binary32 targets, whose codes are the values that viewers need. Another code is an
// integer and not a channel's value.
bool values_are_codes(const OutputColor& image) noexcept {
    const ChannelType type = pipeline::info(image.color.format).type;
    return image.premultiplied && (type == ChannelType::half || type == ChannelType::single);
}

// The channels in the order of their bytes in a pixel; append_pixel() below writes them in this order.
PartHeader header_of(const OutputColor& image) {
    PartHeader header{.width = image.color.width, .height = image.color.height};
    const auto add = [&](std::string name, StoredType type) { header.channels.push_back({std::move(name), type}); };
    const bool is_half = values_are_codes(image) && pipeline::info(image.color.format).type == ChannelType::half;
    const int channels = image.color.channels();
    for (int c = 0; c < channels; ++c)
        add(std::string{channel_names[c]}, is_half ? StoredType::half : StoredType::single);
    if (!image.depth.codes.empty()) add("Z", StoredType::single);
    if (!values_are_codes(image))
        for (int c = 0; c < channels; ++c) add(fmt::format("{}bits", channel_names[c]), StoredType::word);
    if (!image.depth.codes.empty()) add("Zbits", StoredType::word);
    header.attributes = prefixed(described(image));
    header.space = stored_space(image.space);
    return header;
}

// The buffer into which all parts of a file are encoded, one after another.
using RowBytes = std::shared_ptr<std::vector<std::byte>>;

// Rows of pixels as required by PartSource: interleaved channels, each in its own type.
class ExrRows {
  public:
    // The image must outlive the rows.
    ExrRows(const OutputColor& image, const PartHeader& header, RowBytes bytes)
        : image_{image},
          type_{pipeline::info(image.color.format).type},
          pixel_bytes_{pixel_bytes(header)},
          bytes_{std::move(bytes)} {}

    // Rows `first` to `last` - 1, in a buffer that the next call overwrites.
    [[nodiscard]] const std::byte* encode(int first, int last) {
        const std::size_t needed =
            static_cast<std::size_t>(last - first) * static_cast<std::size_t>(image_.color.width) * pixel_bytes_;
        if (bytes_->size() < needed) bytes_->resize(needed);
        next_ = bytes_->data();
        for (int y = first; y < last; ++y)
            for (int x = 0; x < image_.color.width; ++x) append_pixel(x, y);
        assert(next_ == bytes_->data() + needed);
        return bytes_->data();
    }

  private:
    template <class T>
    void append(T word) noexcept {
        std::memcpy(next_, &word, sizeof word);
        next_ += sizeof word;
    }

    void append_pixel(int x, int y) {
        const int channels = image_.color.channels();
        const std::uint32_t* codes = &image_.color.codes[image_.color.index(x, y)];
        // bare: the channel itself is the code, and no "bits" channel follows.
        const bool bare = values_are_codes(image_);
        for (int c = 0; c < channels; ++c) {
            if (bare && type_ == ChannelType::half) append(static_cast<std::uint16_t>(codes[c]));
            if (bare && type_ == ChannelType::single) append(codes[c]);
            if (!bare) append(premultiplied(codes, c, channels));
        }
        const bool has_depth = !image_.depth.codes.empty();
        const std::uint32_t depth = has_depth ? image_.depth.codes[image_.depth.index(x, y)] : 0;
        const auto format = pipeline::depth_format(image_.depth.format);
        // Z is the rounded value, for other programs; comparisons read Zbits below.
        if (has_depth) append(static_cast<float>(rasterizer::depth_value(depth, format)));
        if (!bare)
            for (int c = 0; c < channels; ++c) append(codes[c]);
        if (has_depth) append(depth);
    }

    // Alpha, and colours without alpha, are unchanged. One multiplication, rounded once.
    [[nodiscard]] float premultiplied(const std::uint32_t* codes, int c, int channels) const noexcept {
        const pipeline::Format format = image_.color.format;
        const float v = blended_value(format, c, codes[c]);
        return image_.premultiplied || channels < 4 || c == 3 ? v : v * blended_value(format, 3, codes[3]);
    }

    const OutputColor& image_;
    ChannelType type_;
    std::size_t pixel_bytes_;
    RowBytes bytes_;
    std::byte* next_ = nullptr;
};

// The source owns its rows, because it is copied into the writer's list.
PartSource source_of(const OutputColor& image, const RowBytes& bytes) {
    PartSource part;
    part.header = header_of(image);
    part.rows = [rows = std::make_shared<ExrRows>(image, part.header, bytes)](int first, int last) {
        return rows->encode(first, last);
    };
    return part;
}

// The format named by an attribute; empty for any other text.
std::optional<Format> format_named(std::string_view name) {
    for (const Format format : enum_values<Format>)
        if (pipeline::info(format).name == name) return format;
    return std::nullopt;
}

StoredType type_of_codes(Format format) {
    return pipeline::info(format).type == ChannelType::half ? StoredType::half : StoredType::single;
}

// Converts a part of a file back to targets. Also reads files of other programs that have R G B A.
class PartReader {
  public:
    PartReader(const StoredPart& part, int number, const std::string& path)
        : path_{path}, number_{number}, part_{part}, header_{part.header}, pixel_bytes_{pixel_bytes(header_)} {
        if (header_.is_deep) fail("a flat image", "a deep image");
        if (!part.is_whole) fail("pixels that OpenEXR can read", "a truncated or damaged image");
    }

    void append_to(std::vector<FileImage>& images) const {
        images.push_back({header_.name, "color", target(color_format(), {"R", "G", "B", "A"})});
        if (!find_channel(header_, "Zbits")) return;
        const auto depth = format_named(attribute(header_, "format.depth"));
        if (!depth || !pipeline::is_depth(*depth))
            fail("the attribute strata:format.depth with the name of a depth format", "no such attribute");
        images.push_back({header_.name, "depth", target(*depth, {"Z"})});
    }

  private:
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw InputError(path_, fmt::format("part {}", number_), expected, found);
    }

    // By name, or, in a file of another program, by the type of channel R.
    [[nodiscard]] Format color_format() const {
        if (const auto format = format_named(attribute(header_, "format.color")); format && pipeline::is_color(*format))
            return *format;
        const auto red = find_channel(header_, "R");
        if (!red || red->type == StoredType::word) fail("colour channels R G B A", "no such channels");
        return red->type == StoredType::half ? Format::rgba16f : Format::rgba32f;
    }

    // One target from the channels `names`. The codes are read from the "bits" channel if there is one; otherwise the
    // channel must have the type of the format's codes, because a converted value would not be the code.
    [[nodiscard]] Image target(Format format, const std::vector<std::string>& names) const {
        Image image{format, header_.width, header_.height};
        const auto channels = static_cast<std::size_t>(image.channels());
        for (std::size_t c = 0; c < channels; ++c) {
            const auto bits = find_channel(header_, names[c] + "bits");
            const auto source = bits ? bits : find_channel(header_, names[c]);
            if (!source || source->type != (bits ? StoredType::word : type_of_codes(format)))
                fail(fmt::format("the channel {} of a {} target", names[c], pipeline::info(format).name),
                     "no such channel");
            copy_codes(*source, image, c);
        }
        return image;
    }

    // memcpy, because a channel may begin at any byte of a pixel. A half fills the low 16 bits of its word.
    void copy_codes(const ChannelLayout& source, Image& image, std::size_t channel) const {
        const auto channels = static_cast<std::size_t>(image.channels());
        const std::byte* from = part_.bytes.data() + source.offset;
        for (std::size_t i = channel; i < image.codes.size(); i += channels, from += pixel_bytes_) {
            std::uint16_t half = 0;
            std::memcpy(&half, from, sizeof half);
            if (source.type == StoredType::half) image.codes[i] = half;
            if (source.type != StoredType::half) std::memcpy(&image.codes[i], from, sizeof image.codes[i]);
        }
    }

    const std::string& path_;
    int number_;
    const StoredPart& part_;
    const PartHeader& header_;
    std::size_t pixel_bytes_;
};

}  // namespace

void write_exr(const std::string& path, const OutputColor& image) {
    const PartSource part = source_of(image, std::make_shared<std::vector<std::byte>>());
    write_exr_parts(path, {&part, 1});
}

void write_layers(const std::string& path, std::span<const OutputColor> layers) {
    assert(!layers.empty() && "a file without parts is none");
    if (!is_standard_output(path) && image_file(path) != ImageFile::exr)
        throw InputError(path, "name", "a file name that ends in .exr", "another ending");
    const FloatEnvironment environment;
    const auto bytes = std::make_shared<std::vector<std::byte>>();
    std::vector<PartSource> parts;
    for (const OutputColor& layer : layers) {
        parts.push_back(source_of(layer, bytes));
        // Three digits sort correctly up to a thousand layers; beyond that the number gets longer.
        parts.back().header.name = layer.part.empty() ? fmt::format("layer.{:03}", parts.size() - 1) : layer.part;
    }
    write_exr_parts(path, parts);
}

std::vector<FileImage> as_images(const StoredPart& part, int number, const std::string& path) {
    std::vector<FileImage> images;
    PartReader{part, number, path}.append_to(images);
    return images;
}

std::vector<FileImage> read_exr(const std::string& path) {
    std::vector<FileImage> images;
    exr::read_parts(path, [&, number = 0](StoredPart&& part) mutable {
        PartReader{part, number++, path}.append_to(images);
    });
    return images;
}

}  // namespace strata::scenes
