// scenes/exr/read_parts.cpp - reads the parts of an EXR file, in scan lines or tiles, flat or deep, as bytes in their
// stored types, at their place in the display window.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/openexr.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>

#include "rasterizer/base/input_error.h"
#include "scenes/exr/openexr.h"
#include "scenes/lfs_pointer.h"
#include "scenes/memory_limit.h"
#include "scenes/read_files.h"

namespace strata::scenes::exr {
namespace {

// The largest side of the project's own targets; a larger one means damage or another kind of file.
constexpr int max_size = 16384;

void check(const std::string& path, const char* place, const Imath::Box2i& window) {
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > max_size || height > max_size)
        throw InputError(path, place, "at most 16384x16384", std::to_string(width) + "x" + std::to_string(height));
}

void check(const std::string& path, const Imf::Header& header) {
    check(path, "size", header.dataWindow());
    check(path, "size of the display window", header.displayWindow());
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw InputError(path, std::string{"channel "} + channel.name(),
                             "a sample for every pixel (sampling 1 x 1)",
                             "sampling " + std::to_string(channel.channel().xSampling) + " x " +
                                 std::to_string(channel.channel().ySampling));
    // A channel is stored as bytes and as 32-bit codes.
    constexpr std::uint64_t most_bytes_a_channel = 8;
    std::uint64_t channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) ++channels;
    for (const Imath::Box2i& window : {header.dataWindow(), header.displayWindow()})
        check_pixels(path, static_cast<std::uint64_t>(window.max.x - window.min.x) + 1,
                     static_cast<std::uint64_t>(window.max.y - window.min.y) + 1, most_bytes_a_channel * channels);
}

StoredType as_stored(Imf::PixelType type) noexcept {
    if (type == Imf::HALF) return StoredType::half;
    return type == Imf::FLOAT ? StoredType::single : StoredType::word;
}

PartHeader header_of(const Imf::Header& header) {
    const Imath::Box2i& window = header.dataWindow();
    PartHeader part{.width = window.max.x - window.min.x + 1, .height = window.max.y - window.min.y + 1};
    part.is_deep = header.hasType() && Imf::isDeepData(header.type());
    if (header.hasName()) part.name = header.name();
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        part.channels.push_back({channel.name(), as_stored(channel.channel().type)});
    // Attributes of other types are ignored: the project only reads text.
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            part.attributes.emplace(attribute.name(), text->value());
    return part;
}

void read_flat(Imf::MultiPartInputFile& file, int number, StoredPart& part) {
    const Imath::Box2i window = file.header(number).dataWindow();
    part.bytes.resize(pixel_bytes(part.header) * static_cast<std::size_t>(part.header.width) *
                      static_cast<std::size_t>(part.header.height));
    Imf::InputPart input{file, number};  // reads tiles, too
    input.setFrameBuffer(flat_frame(part.header, window, part.bytes.data()));
    input.readPixels(window.min.y, window.max.y);
}

void read_counts(Imf::DeepScanLineInputPart& input, const Imath::Box2i& window) {
    input.readPixelSampleCounts(window.min.y, window.max.y);
}
void read_samples(Imf::DeepScanLineInputPart& input, const Imath::Box2i& window) {
    input.readPixels(window.min.y, window.max.y);
}
// The tiles of the first level, which is the full image.
void read_counts(Imf::DeepTiledInputPart& input, const Imath::Box2i&) {
    input.readPixelSampleCounts(0, input.numXTiles(0) - 1, 0, input.numYTiles(0) - 1, 0, 0);
}
void read_samples(Imf::DeepTiledInputPart& input, const Imath::Box2i&) {
    input.readTiles(0, input.numXTiles(0) - 1, 0, input.numYTiles(0) - 1, 0, 0);
}

// Sample by sample with interleaved channels, as PartSource::rows; a pixel may have no sample.
template <class Part>
void read_deep(Imf::MultiPartInputFile& file, int number, StoredPart& part) {
    const Imath::Box2i window = file.header(number).dataWindow();
    Part input{file, number};
    DeepRows rows{part.header,
                  static_cast<std::size_t>(part.header.width) * static_cast<std::size_t>(part.header.height)};
    input.setFrameBuffer(rows.frame(window));
    read_counts(input, window);
    part.samples.assign(rows.counts.begin(), rows.counts.end());
    const auto samples = std::accumulate(part.samples.begin(), part.samples.end(), std::size_t{0});
    part.bytes.resize(samples * pixel_bytes(part.header));
    rows.point_at(part.bytes.data());
    read_samples(input, window);
}

// Moves a part's pixels from its data window to their place in the display window, which is the picture. Pixels outside
// of the data window are 0, those outside of the display window are not seen.
void place(StoredPart& part, const Imath::Box2i& data, const Imath::Box2i& display) {
    if (data == display) return;
    StoredPart placed{.header = part.header, .is_whole = true};
    placed.header.width = display.max.x - display.min.x + 1;
    placed.header.height = display.max.y - display.min.y + 1;
    const auto pixels = static_cast<std::size_t>(placed.header.width) * static_cast<std::size_t>(placed.header.height);
    const std::size_t size = pixel_bytes(part.header);
    if (part.header.is_deep)
        placed.samples.assign(pixels, 0);
    else
        placed.bytes.assign(pixels * size, std::byte{0});
    std::size_t pixel = 0, sample = 0;
    for (int y = data.min.y; y <= data.max.y; ++y)
        for (int x = data.min.x; x <= data.max.x; ++x, ++pixel) {
            const std::size_t samples = part.header.is_deep ? part.samples[pixel] : 1;
            const std::byte* const from = part.bytes.data() + sample * size;
            sample += samples;
            if (!display.intersects(Imath::V2i{x, y})) continue;
            const auto to =
                static_cast<std::size_t>(y - display.min.y) * static_cast<std::size_t>(placed.header.width) +
                static_cast<std::size_t>(x - display.min.x);
            if (part.header.is_deep) {
                placed.samples[to] = part.samples[pixel];
                placed.bytes.insert(placed.bytes.end(), from, from + samples * size);
            } else {
                std::copy_n(from, size, placed.bytes.begin() + static_cast<std::ptrdiff_t>(to * size));
            }
        }
    part = std::move(placed);
}

StoredPart read_part(Imf::MultiPartInputFile& file, int number) {
    StoredPart part{.header = header_of(file.header(number))};
    try {
        if (!part.header.is_deep)
            read_flat(file, number, part);
        else if (file.header(number).type() == Imf::DEEPTILE)
            read_deep<Imf::DeepTiledInputPart>(file, number, part);
        else
            read_deep<Imf::DeepScanLineInputPart>(file, number, part);
        part.is_whole = true;
        place(part, file.header(number).dataWindow(), file.header(number).displayWindow());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // OpenEXR's exceptions are derived from it
        part.bytes.clear();
        part.samples.clear();
    }
    return part;
}

// A size error found by OpenEXR's second parser, which compares the sizes of attributes with the file's. The classes
// below would allocate first, up to 2 GiB for a text that is not in the file (OpenEXR 3.1).
struct WrongSize {
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    std::string message{};
};

void check_sizes_of_attributes(const std::string& path) {
    WrongSize wrong;
    wrong.initializer.user_data = &wrong;
    wrong.initializer.error_handler_fn = [](exr_const_context_t context, exr_result_t code, const char* text) {
        void* found = nullptr;
        if (code == EXR_ERR_ATTR_SIZE_MISMATCH && exr_get_user_data(context, &found) == EXR_ERR_SUCCESS &&
            found != nullptr)
            static_cast<WrongSize*>(found)->message = text;
    };
    exr_context_t context = nullptr;
    if (exr_start_read(&context, path.c_str(), &wrong.initializer) == EXR_ERR_SUCCESS) exr_finish(&context);
    if (!wrong.message.empty())
        throw InputError(path, "file", "an EXR image",
                         "an attribute that ends beyond the end of the file (" + wrong.message + ")");
}

std::unique_ptr<Imf::MultiPartInputFile> open(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) throw InputError(path, "no such file");
    check_sizes_of_attributes(path);
    note_read_file(path);
    try {
        return std::make_unique<Imf::MultiPartInputFile>(path.c_str(), start_threads());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        std::string begin(64, '\0');
        std::ifstream{path, std::ios::binary}.read(begin.data(), static_cast<std::streamsize>(begin.size()));
        throw InputError(path, "file", "an EXR image",
                         is_lfs_pointer(begin) ? lfs_pointer_found : "a header that OpenEXR cannot read");
    }
}

}  // namespace

void read_parts(const std::string& path, const std::function<void(StoredPart&&)>& take) {
    const auto file = open(path);
    for (int number = 0; number < file->parts(); ++number) check(path, file->header(number));
    for (int number = 0; number < file->parts(); ++number) take(read_part(*file, number));
}

}  // namespace strata::scenes::exr
