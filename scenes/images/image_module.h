// scenes/images/image_module.h - the border to OpenImageIO: what the rest of the project asks of it, and what it answers.
//
// Rule     OpenImageIO brings some 250 shared libraries, so it stands in a shared library of its own that is loaded
//          when the first image file is read or written (files/load_image_module.h). Standard types alone cross the
//          border: a `pipeline::Image` has an allocator that the module does not share. The module knows no format of
//          a target, no digest and no temporary name; its answers are bytes, sizes and sentences.
// Tests    tests/scenes/files/exr_test.cpp, deep_exr_test.cpp, png_test.cpp; tests/tools/image_module_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/place.h"

namespace strata::scenes {

enum class StoredType : std::uint8_t { half, single, word };  // EXR's HALF, FLOAT and UINT32

[[nodiscard]] constexpr std::size_t size_of(StoredType type) noexcept { return type == StoredType::half ? 2 : 4; }

struct StoredChannel {
    std::string name;
    StoredType type = StoredType::single;
};

// The colour space that a file declares to other programs: sRGB values, or linear light.
enum class StoredSpace : std::uint8_t { srgb, linear };

// One part of an EXR file without its pixels.
struct PartHeader {
    int width = 0, height = 0;
    std::string name{};                               // "" where the file has one part alone
    std::vector<StoredChannel> channels{};            // in the order in which a pixel's bytes hold them
    std::map<std::string, std::string> attributes{};  // under their full names
    StoredSpace space = StoredSpace::linear;          // written, not read
    bool is_deep = false;
};

[[nodiscard]] inline std::size_t pixel_bytes(const PartHeader& header) noexcept {
    std::size_t bytes = 0;
    for (const StoredChannel& channel : header.channels) bytes += size_of(channel.type);
    return bytes;
}

// `rows(first, last)` gives the bytes of the rows from `first` to `last` - 1: pixel by pixel (deep: sample by sample), the
// channels one after the other, each in its own type. They stay until the next call.
struct PartSource {
    PartHeader header;
    std::function<const std::byte*(int first, int last)> rows;
    std::span<const std::uint32_t> samples{};  // of each pixel; deep parts alone have them
};

// One part of an EXR file as the reader hands it over.
struct StoredPart {
    PartHeader header;
    bool is_whole = false;                 // else the file is damaged and there are no bytes
    std::vector<std::byte> bytes{};        // as PartSource::rows gives them
    std::vector<std::uint32_t> samples{};  // of each pixel; deep parts alone have them
};

// A file that is being written. Its functions report failures to their owner, who asks for no more.
struct ByteSink {
    std::string path;  // where the bytes can be seen once `seek` has flushed them
    std::function<std::size_t(const void* bytes, std::size_t size)> write;
    std::function<bool(std::int64_t position)> seek;
    std::function<std::int64_t()> position;
};

// 8-bit r, g, b, a in rows from the top, colours not multiplied by alpha.
struct StraightPicture {
    int width = 0, height = 0;
    std::span<const std::uint8_t> rgba;
    std::map<std::string, std::string> attributes;
};

// The bytes of a PNG or JPEG file and what its header says of its size.
struct EncodedPicture {
    Bytes bytes;
    const char* reader = "";  // "png" or "jpeg"
    int width = 0, height = 0;
};

// A PNG's channels as the file has them: a palette is looked up, nothing else is changed. 16-bit codes where `bits` is 16, else 8.
struct StoredCodes {
    int width = 0, height = 0, channels = 0, bits = 8;
    std::vector<std::uint16_t> codes{};
};

// The writers answer "", or OpenImageIO's words for what failed.
struct ImageModule {
    const char* version;
    std::string (*write_png)(const ByteSink& sink, const StraightPicture& picture);
    std::string (*write_exr)(const ByteSink& sink, const PartSource& part);
    // Several parts, and deep ones: OpenImageIO 2.4 writes these by name.
    std::string (*write_exr_parts)(const std::string& path, std::span<const PartSource> parts);
    // Calls `take` with part after part. InputError if `path` is no EXR file of sane size.
    void (*read_exr)(const std::string& path, const std::function<void(StoredPart&&)>& take);
    // width * height * 4 codes. InputError at `place` where the bytes do not decode to that size.
    std::vector<std::uint8_t> (*decode)(const EncodedPicture& picture, const Place& place);
    // The same without a change to width, channels or bits.
    StoredCodes (*decode_codes)(const EncodedPicture& picture, const Place& place);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* image_module_symbol = "strata_image_module";
using ImageModuleEntry = const ImageModule* (*)();

}  // namespace strata::scenes
