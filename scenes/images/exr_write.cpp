// scenes/images/exr_write.cpp - the parts of an EXR file, flat or deep, as their bytes are given.
//
// Rule     Channels are written in their own types, so that OpenImageIO copies the bytes without looking. Colours say
//          what they are in three ways, for viewers take an EXR's colours for linear light where nothing says otherwise:
//          `oiio:ColorSpace` (OpenImageIO), `colorInteropID` (OpenEXR 3.4 and later) and `chromaticities` (those of
//          BT.709 and its white in both spaces).
#include <OpenImageIO/deepdata.h>

#include <algorithm>
#include <cstring>

#include "scenes/images/openimageio.h"

namespace strata::scenes::images {
namespace {

using OIIO::TypeDesc;

TypeDesc as_type(StoredType type) noexcept {
    switch (type) {
        case StoredType::half: return TypeDesc::HALF;
        case StoredType::single: return TypeDesc::FLOAT;
        case StoredType::word: return TypeDesc::UINT32;
    }
    return TypeDesc::UNKNOWN;  // unreachable: the enum is closed
}

void tell_space(OIIO::ImageSpec& spec, StoredSpace space) {
    const bool is_srgb = space == StoredSpace::srgb;
    spec.attribute(std::string{color_space_stand_in}, is_srgb ? "sRGB" : "Linear");
    spec.attribute("colorInteropID", is_srgb ? "srgb_rec709_scene" : "lin_rec709_scene");
    constexpr float bt709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};  // r, g, b, white
    spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), bt709);
}

// The header of one part. Whatever would depend on the time, the host or the library's defaults is set here.
OIIO::ImageSpec spec_of(const PartHeader& header) {
    OIIO::ImageSpec spec = base_spec(header.width, header.height, header.attributes);
    spec.attribute("DateTime", "");  // else the writer stamps the present
    for (const StoredChannel& channel : header.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(as_type(channel.type));
    }
    spec.nchannels = static_cast<int>(header.channels.size());
    spec.deep = header.is_deep;
    spec.attribute("compression", header.is_deep ? "zips" : "zip");  // the strongest that deep images may have
    if (!header.name.empty()) spec.attribute("oiio:subimagename", header.name);
    tell_space(spec, header.space);
    return spec;
}

bool write_flat(OIIO::ImageOutput& output, const PartSource& part) {
    constexpr int rows_at_once = 64;  // a multiple of zip's 16
    for (int y = 0; y < part.header.height; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, part.header.height);
        if (!output.write_scanlines(y, end, 0, TypeDesc::UNKNOWN, part.rows(y, end))) return false;
    }
    return true;
}

// All samples are copied into the library's own store, channel by channel: it takes deep pixels in no other
// form.
bool write_deep(OIIO::ImageOutput& output, const OIIO::ImageSpec& spec, const PartSource& part) {
    OIIO::DeepData data{spec};
    data.set_all_samples(OIIO::cspan<unsigned int>(part.samples.data(), part.samples.size()));
    const auto& channels = part.header.channels;
    std::int64_t pixel = 0;
    for (int y = 0; y < part.header.height; ++y) {
        const std::byte* from = part.rows(y, y + 1);
        for (int x = 0; x < part.header.width; ++x, ++pixel)
            for (int sample = 0; sample < data.samples(pixel); ++sample)
                for (std::size_t c = 0; c < channels.size(); from += size_of(channels[c++].type))
                    std::memcpy(data.data_ptr(pixel, static_cast<int>(c), sample), from, size_of(channels[c].type));
    }
    return output.write_deep_image(data);
}

// All parts are declared at the first open; each later one is opened by appending, and only after the part
// before it is complete.
bool write_all(OIIO::ImageOutput& output, const std::string& path, std::span<const PartSource> parts) {
    std::vector<OIIO::ImageSpec> specs;
    for (const PartSource& part : parts) specs.push_back(spec_of(part.header));
    const bool is_open = parts.size() == 1 ? output.open(path, specs[0])
                                           : output.open(path, static_cast<int>(specs.size()), specs.data());
    if (!is_open) return false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i > 0 && !output.open(path, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
        const bool done =
            parts[i].header.is_deep ? write_deep(output, specs[i], parts[i]) : write_flat(output, parts[i]);
        if (!done) return false;
    }
    return output.close();
}

constexpr const char* not_whole = "the file is not whole; is the disk full?";

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
    return spec.deep ? input->read_native_deep_scanlines(part, 0, y, y + 1, 0, 0, spec.nchannels, deep)
                     : input->read_scanlines(part, 0, y, y + 1, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, row.data());
}

}  // namespace

std::string write_exr(const ByteSink& sink, const PartSource& part) {
    const auto output = OIIO::ImageOutput::create("openexr");
    if (output == nullptr) return "OpenImageIO has no writer of EXR";
    SinkProxy proxy{sink};
    output->set_ioproxy(&proxy);
    if (!write_all(*output, sink.path, {&part, 1})) return output->geterror();
    // Seeking flushes the bytes, so that the file can be read by its name.
    return sink.seek(0) && finish_headers(sink.path) ? "" : not_whole;
}

std::string write_exr_parts(const std::string& path, std::span<const PartSource> parts) {
    const auto output = OIIO::ImageOutput::create("openexr");
    if (output == nullptr) return "OpenImageIO has no writer of EXR";
    if (!write_all(*output, path, parts)) return output->geterror();
    return finish_headers(path) && has_last_row(path) ? "" : not_whole;
}

}  // namespace strata::scenes::images
