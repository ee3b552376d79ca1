// scenes/files/exr.cpp - flat and multi-part EXR: premultiplied colours to look at, the targets' own codes to compare.
//
// Rule     R G B A hold premultiplied values. Where the target is premultiplied half or binary32 they are its codes bit
//          for bit, in its own type; else they are FLOAT, and the codes stand beside them as UINT32 `Rbits Gbits Bbits
//          Abits`. `Z` is the depth as a FLOAT, `Zbits` its code. All bits survive: OpenImageIO copies native types
//          without looking.
// Cost     Colours of a straight target are stored twice; zip shrinks the smaller codes to little.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <optional>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_formats.h"

namespace strata::scenes {
namespace {

using OIIO::TypeDesc;
using pipeline::ChannelType;
using pipeline::Format;
using pipeline::Image;

constexpr std::string_view channel_names[4] = {"R", "G", "B", "A"};

bool values_are_codes(const OutputColor& image) noexcept {
    return image.premultiplied && pipeline::info(image.color.format).type != ChannelType::unorm8;
}

OIIO::ImageSpec spec_of(const OutputColor& image) {
    OIIO::ImageSpec spec = base_spec(image.color.width, image.color.height, described(image));
    const auto add = [&](std::string name, TypeDesc type) {
        spec.channelnames.push_back(std::move(name));
        spec.channelformats.push_back(type);
    };
    const bool is_half = values_are_codes(image) && pipeline::info(image.color.format).type == ChannelType::half;
    const int channels = image.color.channels();
    for (int c = 0; c < channels; ++c) add(std::string{channel_names[c]}, is_half ? TypeDesc::HALF : TypeDesc::FLOAT);
    if (!image.depth.codes.empty()) add("Z", TypeDesc::FLOAT);
    if (!values_are_codes(image))
        for (int c = 0; c < channels; ++c) add(fmt::format("{}bits", channel_names[c]), TypeDesc::UINT32);
    if (!image.depth.codes.empty()) add("Zbits", TypeDesc::UINT32);
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.attribute("compression", "zip");
    return spec;
}

// Rows of pixels as OpenImageIO takes them: the channels of one pixel after the other, each in its own type.
class Rows {
  public:
    explicit Rows(const OutputColor& image) : image_{image}, type_{pipeline::info(image.color.format).type} {}

    [[nodiscard]] const std::byte* encode(int first, int last) {
        bytes_.clear();
        for (int y = first; y < last; ++y)
            for (int x = 0; x < image_.color.width; ++x) append_pixel(x, y);
        return bytes_.data();
    }

  private:
    template <class T>
    void append(T word) {
        const auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(word);
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }

    void append_pixel(int x, int y) {
        const int channels = image_.color.channels();
        const std::uint32_t* codes = &image_.color.codes[image_.color.index(x, y)];
        const bool bare = values_are_codes(image_);
        for (int c = 0; c < channels; ++c) {
            if (bare && type_ == ChannelType::half) append(static_cast<std::uint16_t>(codes[c]));
            if (bare && type_ == ChannelType::single) append(codes[c]);
            if (!bare) append(premultiplied(codes, c, channels));
        }
        const bool has_depth = !image_.depth.codes.empty();
        const std::uint32_t depth = has_depth ? image_.depth.codes[image_.depth.index(x, y)] : 0;
        const auto format = pipeline::depth_format(image_.depth.format);
        if (has_depth) append(static_cast<float>(rasterizer::depth_value(depth, format)));
        if (!bare)
            for (int c = 0; c < channels; ++c) append(codes[c]);
        if (has_depth) append(depth);
    }

    [[nodiscard]] float premultiplied(const std::uint32_t* codes, int c, int channels) const noexcept {
        const float v = channel_value(type_, codes[c]);
        return image_.premultiplied || channels < 4 || c == 3 ? v : v * channel_value(type_, codes[3]);
    }

    const OutputColor& image_;
    ChannelType type_;
    std::vector<std::byte> bytes_;
};

bool write_part(OIIO::ImageOutput& output, const OutputColor& image) {
    constexpr int rows_at_once = 64;  // a multiple of zip's 16
    Rows rows{image};
    for (int y = 0; y < image.color.height; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, image.color.height);
        if (!output.write_scanlines(y, end, 0, TypeDesc::UNKNOWN, rows.encode(y, end))) return false;
    }
    return true;
}

bool write_parts(OIIO::ImageOutput& output, const std::string& name, std::span<const OutputColor> layers) {
    std::vector<OIIO::ImageSpec> specs;
    for (const OutputColor& layer : layers) {
        specs.push_back(spec_of(layer));
        specs.back().attribute("oiio:subimagename", fmt::format("layer.{:03}", specs.size() - 1));
    }
    if (!output.open(name, static_cast<int>(specs.size()), specs.data())) return false;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (i > 0 && !output.open(name, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
        if (!write_part(output, layers[i])) return false;
    }
    return output.close();
}

// Where a part keeps a target's codes: a channel's offset in the native pixel, and its type.
struct Source {
    std::size_t offset = 0;
    TypeDesc type;
};

std::optional<Source> find_channel(const OIIO::ImageSpec& spec, const std::string& name) {
    const int index = spec.channelindex(name);
    if (index < 0) return std::nullopt;
    return Source{spec.pixel_bytes(0, index, true), spec.channelformat(index)};
}

std::optional<Format> format_named(std::string_view name) {
    for (const Format format : enum_values<Format>)
        if (pipeline::info(format).name == name) return format;
    return std::nullopt;
}

TypeDesc type_of_codes(Format format) {
    return pipeline::info(format).type == ChannelType::half ? TypeDesc::HALF : TypeDesc::FLOAT;
}

class PartReader {
  public:
    PartReader(OIIO::ImageInput& input, int part, const std::string& path)
        : path_{path}, part_{part}, spec_{input.spec(part, 0)}, pixel_bytes_{spec_.pixel_bytes(true)} {
        pixels_.resize(spec_.image_bytes(true));
        if (!input.read_image(part, 0, 0, spec_.nchannels, TypeDesc::UNKNOWN, pixels_.data()))
            fail("a whole image", "a damaged one");
    }

    void append_to(std::vector<FileImage>& images) const {
        const std::string part{spec_.get_string_attribute("oiio:subimagename")};
        images.push_back({part, "color", target(color_format(), {"R", "G", "B", "A"})});
        if (spec_.channelindex("Zbits") < 0) return;
        const auto depth = format_named(attribute(spec_, "format.depth"));
        if (!depth || !pipeline::is_depth(*depth))
            fail("an attribute strata:format.depth that names a depth format", "none");
        images.push_back({part, "depth", target(*depth, {"Z"})});
    }

  private:
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw InputError(path_, fmt::format("part {}", part_), expected, found);
    }

    // By name, or, in somebody else's file, by the type of R.
    [[nodiscard]] Format color_format() const {
        if (const auto format = format_named(attribute(spec_, "format.color")); format && pipeline::is_color(*format))
            return *format;
        const auto red = find_channel(spec_, "R");
        if (!red || red->type == TypeDesc::UINT32) fail("colour channels R G B A", "none");
        return red->type == TypeDesc::HALF ? Format::rgba16f : Format::rgba32f;
    }

    [[nodiscard]] Image target(Format format, const std::vector<std::string>& names) const {
        Image image{format, spec_.width, spec_.height};
        const auto channels = static_cast<std::size_t>(image.channels());
        for (std::size_t c = 0; c < channels; ++c) {
            const auto bits = find_channel(spec_, names[c] + "bits");
            const auto source = bits ? bits : find_channel(spec_, names[c]);
            if (!source || source->type != (bits ? TypeDesc{TypeDesc::UINT32} : type_of_codes(format)))
                fail(fmt::format("a channel {} with codes of {}", names[c], pipeline::info(format).name), "none");
            copy_codes(*source, image, c);
        }
        return image;
    }

    void copy_codes(const Source& source, Image& image, std::size_t channel) const {
        const auto channels = static_cast<std::size_t>(image.channels());
        const std::byte* from = pixels_.data() + source.offset;
        for (std::size_t i = channel; i < image.codes.size(); i += channels, from += pixel_bytes_) {
            std::uint16_t half = 0;
            std::memcpy(&half, from, sizeof half);
            if (source.type == TypeDesc::HALF) image.codes[i] = half;
            if (source.type != TypeDesc::HALF) std::memcpy(&image.codes[i], from, sizeof image.codes[i]);
        }
    }

    const std::string& path_;
    int part_;
    OIIO::ImageSpec spec_;
    std::size_t pixel_bytes_;
    std::vector<std::byte> pixels_;
};

}  // namespace

void write_exr(const std::string& path, const OutputColor& image) {
    const OIIO::ImageSpec spec = spec_of(image);
    write_with("openexr", path, [&](OIIO::ImageOutput& output, const std::string& name) {
        return output.open(name, spec) && write_part(output, image) && output.close();
    });
}

void write_layers(const std::string& path, std::span<const OutputColor> layers) {
    assert(!layers.empty() && "a file without parts is none");
    if (image_file(path) != ImageFile::exr)
        throw InputError(path, "name", "a file name that ends in .exr", "another ending");
    const FloatEnvironment environment;
    write_exr_by_name(
        path, [&](OIIO::ImageOutput& output, const std::string& name) { return write_parts(output, name, layers); });
}

std::vector<FileImage> read_exr(const std::string& path) {
    const auto input = open_exr(path);
    std::vector<FileImage> images;
    for (int part = 0; input->seek_subimage(part, 0); ++part) {
        if (input->spec().deep) throw InputError(path, fmt::format("part {}", part), "a flat image", "a deep one");
        PartReader{*input, part, path}.append_to(images);
    }
    return images;
}

}  // namespace strata::scenes
