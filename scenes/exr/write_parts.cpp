// scenes/exr/write_parts.cpp - writes the parts of an EXR file, flat or deep, into a sink.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "scenes/exr/openexr.h"

namespace strata::scenes::exr {
namespace {

// Lets OpenEXR write into a ByteSink.
class SinkStream : public Imf::OStream {
  public:
    explicit SinkStream(const ByteSink& sink) : OStream{sink.path.c_str()}, sink_{sink} {}
    void write(const char bytes[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (is_ending_ && count == block_place_bytes && std::all_of(bytes, bytes + size, [](char b) { return b == 0; }))
            lacks_block_ = true;
        if (sink_.write(bytes, count) != count) throw std::runtime_error("a write failed");
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(sink_.position()); }
    void seekp(std::uint64_t position) override {
        if (!sink_.seek(static_cast<std::int64_t>(position))) throw std::runtime_error("a seek failed");
    }
    // Called after the last row; the tables of blocks follow.
    void end() noexcept { is_ending_ = true; }
    [[nodiscard]] bool lacks_block() const noexcept { return lacks_block_; }

  private:
    static constexpr std::size_t block_place_bytes = 8;
    const ByteSink& sink_;
    bool is_ending_ = false, lacks_block_ = false;
};

void tell_space(Imf::Header& header, StoredSpace space) {
    const bool is_srgb = space == StoredSpace::srgb;
    header.insert("oiio:ColorSpace", Imf::StringAttribute{is_srgb ? "sRGB" : "Linear"});
    header.insert("colorInteropID", Imf::StringAttribute{is_srgb ? "srgb_rec709_scene" : "lin_rec709_scene"});
    Imf::addChromaticities(header, {{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}});
}

Imf::Header header_of(const PartHeader& part) {
    Imf::Header header{part.width, part.height};
    header.compression() = part.is_deep ? Imf::ZIPS_COMPRESSION : Imf::ZIP_COMPRESSION;  // the strongest for deep parts
    header.zipCompressionLevel() = 3;                                                    // OpenEXR's default
    header.setType(part.is_deep ? Imf::DEEPSCANLINE : Imf::SCANLINEIMAGE);
    if (!part.name.empty()) header.setName(part.name);
    for (const StoredChannel& channel : part.channels)
        header.channels().insert(channel.name, Imf::Channel{pixel_type(channel.type)});
    header.insert("Software", Imf::StringAttribute{"strata"});
    for (const auto& [name, value] : part.attributes) header.insert(name, Imf::StringAttribute{value});
    tell_space(header, part.space);
    return header;
}

Imath::Box2i rows_of(const PartHeader& header, int first, int last) {
    return {{0, first}, {header.width - 1, last - 1}};
}

void write_flat(Imf::MultiPartOutputFile& file, int number, const PartSource& part) {
    constexpr int rows_at_once = 64;  // a multiple of zip's 16
    Imf::OutputPart output{file, number};
    for (int y = 0; y < part.header.height; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, part.header.height);
        output.setFrameBuffer(flat_frame(part.header, rows_of(part.header, y, end), part.rows(y, end)));
        output.writePixels(end - y);
    }
}

void write_deep(Imf::MultiPartOutputFile& file, int number, const PartSource& part) {
    const auto width = static_cast<std::size_t>(part.header.width);
    Imf::DeepScanLineOutputPart output{file, number};
    DeepRows row{part.header, width};
    for (int y = 0; y < part.header.height; ++y) {
        std::ranges::copy(part.samples.subspan(static_cast<std::size_t>(y) * width, width), row.counts.begin());
        row.point_at(const_cast<std::byte*>(part.rows(y, y + 1)));  // the library only reads them
        output.setFrameBuffer(row.frame(rows_of(part.header, y, y + 1)));
        output.writePixels(1);
    }
}

// While a file is written, every part has two blocks of 16 rows per thread in memory, about three times (with their
// compressed form and the compressor's state). Therefore a single image uses all threads and a file of many layers uses
// few: the additional memory is small compared with the layers.
int threads_for(std::span<const PartSource> parts) {
    const int all = start_threads();
    return parts.size() == 1 ? all : std::min(all, parts.front().header.height / 1024);
}

}  // namespace

// OpenEXR 3.1 silently omits a block that could not be compressed (zlib had no memory), and all that follow: it returns
// from OutputFile::writePixels before it checks its tasks for failures. The tables of blocks, written when the file
// closes, then contain a 0.
std::string write_parts(const ByteSink& sink, std::span<const PartSource> parts) try {
    std::vector<Imf::Header> headers;
    for (const PartSource& part : parts) headers.push_back(header_of(part.header));
    SinkStream stream{sink};
    {
        const auto count = static_cast<int>(headers.size());
        Imf::MultiPartOutputFile file{stream, headers.data(), count, false, threads_for(parts)};
        for (int number = 0; const PartSource& part : parts)
            part.header.is_deep ? write_deep(file, number++, part) : write_flat(file, number++, part);
        stream.end();
    }
    return stream.lacks_block() ? "not all blocks of rows could be packed" : "";
} catch (const std::bad_alloc&) {
    throw;
} catch (const std::exception& failure) {
    return failure.what();
}

}  // namespace strata::scenes::exr
