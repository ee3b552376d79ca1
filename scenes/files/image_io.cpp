#include "scenes/files/image_io.h"

#include <OpenImageIO/deepdata.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <filesystem>

#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_formats.h"
#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

constexpr int max_size = 16384;

bool ends_with(const std::string& path, std::string_view ending) {
    if (path.size() < ending.size()) return false;
    return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [](char wanted, char c) { return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
}

void check_size(const std::string& path, const OIIO::ImageSpec& spec) {
    const bool plain = spec.depth == 1 && spec.nchannels > 0;
    if (plain && spec.width > 0 && spec.height > 0 && spec.width <= max_size && spec.height <= max_size) return;
    throw InputError(path, "size", "at most 16384x16384",
                     std::to_string(spec.width) + "x" + std::to_string(spec.height));
}

// Whether what was written last can be read: OpenEXR does not report what fails when it flushes its last buffer.
bool has_last_row(const std::string& path) {
    const auto input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    if (!input->open(path, spec)) return false;
    int part = 0;
    while (input->seek_subimage(part + 1, 0)) ++part;
    (void)input->geterror();  // the last seek's
    spec = input->spec(part, 0);
    std::vector<std::byte> row(spec.scanline_bytes(true));
    OIIO::DeepData deep;
    const int y = spec.height - 1;
    return spec.deep
               ? input->read_native_deep_scanlines(part, 0, y, y + 1, 0, 0, spec.nchannels, deep)
               : input->read_scanlines(part, 0, y, y + 1, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, row.data());
}

}  // namespace

ImageFile image_file(const std::string& path) {
    if (ends_with(path, ".png")) return ImageFile::png;
    if (ends_with(path, ".exr")) return ImageFile::exr;
    throw InputError(path, "name", "a file name that ends in .png or .exr", "another ending");
}

float channel_value(pipeline::ChannelType type, std::uint32_t code) noexcept {
    if (type == pipeline::ChannelType::unorm8) return pipeline::from_unorm8(static_cast<std::uint8_t>(code));
    if (type == pipeline::ChannelType::half) return pipeline::half_to_float(static_cast<std::uint16_t>(code));
    return std::bit_cast<float>(code);
}

void write_with(const char* format, const std::string& path, const Body& body) {
    AtomicFile file{path};
    FileProxy proxy{path, file};
    std::string error = "no writer";
    if (const auto output = OIIO::ImageOutput::create(format)) {
        output->set_ioproxy(&proxy);
        error = body(*output, path) ? "" : output->geterror();
    }
    if (error.empty() || file.failed()) return file.commit();  // which knows the system's reason
    throw SystemError(path, "write", error);
}

void write_exr_by_name(const std::string& path, const Body& body) {
    AtomicFile file{path};
    std::string error = "no writer";
    if (const auto output = OIIO::ImageOutput::create("openexr"))
        error = body(*output, file.temporary()) ? "" : output->geterror();
    if (!error.empty()) throw SystemError(path, "write", error);
    if (!has_last_row(file.temporary())) throw SystemError(path, "write", "the file is not whole; is the disk full?");
    file.commit();
}

std::unique_ptr<OIIO::ImageInput> open_exr(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw InputError(path, "file", "an image", "no file of that name");
    auto input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    if (input == nullptr || !input->open(path, spec)) throw InputError(path, "file", "an EXR image", "something else");
    for (int part = 0; input->seek_subimage(part, 0); ++part) check_size(path, input->spec());
    (void)input->geterror();  // the last seek's
    input->seek_subimage(0, 0);
    return input;
}

OIIO::ImageSpec base_spec(int width, int height, const Attributes& attributes) {
    OIIO::ImageSpec spec{width, height, 0, OIIO::TypeDesc::FLOAT};
    spec.attribute("DateTime", "");  // else the EXR writer stamps the present
    spec.attribute("Software", "strata");
    for (const auto& [key, value] : attributes) spec.attribute("strata:" + key, value);
    return spec;
}

std::string attribute(const OIIO::ImageSpec& spec, const std::string& key) {
    return std::string{spec.get_string_attribute("strata:" + key)};
}

Attributes described(const OutputColor& image) {
    Attributes attributes = image.attributes;
    attributes["format.color"] = pipeline::info(image.color.format).name;
    attributes["digest.color"] = digest(image.color);
    attributes["colour"] = image.space == pipeline::ColorSpace::encoded ? "encoded" : "linear";
    if (!image.depth.codes.empty()) {
        attributes["format.depth"] = pipeline::info(image.depth.format).name;
        attributes["digest.depth"] = digest(image.depth);
    }
    return attributes;
}

void write_image(const std::string& path, const OutputColor& image) {
    const FloatEnvironment environment;
    assert(pipeline::is_color(image.color.format) && image.color.samples == 1);
    switch (image_file(path)) {
        case ImageFile::png: return write_png(path, image);
        case ImageFile::exr: return write_exr(path, image);
    }
}

std::vector<FileImage> read_images(const std::string& path) {
    const FloatEnvironment environment;
    switch (image_file(path)) {
        case ImageFile::png: return read_png(path);
        case ImageFile::exr: return read_exr(path);
    }
    return {};  // unreachable: the enum is closed
}

}  // namespace strata::scenes
