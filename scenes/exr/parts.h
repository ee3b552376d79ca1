// scenes/exr/parts.h - reads and writes the parts of an EXR file as bytes in their stored types, with OpenEXR.
//
// Rule     OpenEXR copies each channel in its own type, so no bit changes. Attributes that would depend on the time,
//          the host or the library's defaults are set here or left out. The colour space is declared by three
//          attributes, because viewers assume linear light if none is given: `oiio:ColorSpace` (OpenImageIO),
//          `colorInteropID` (OpenEXR 3.4 and later) and `chromaticities` (those of BT.709 and its white in both
//          spaces).
// Tests    tests/scenes/files/exr_test.cpp, exr_foreign_test.cpp, deep_exr_test.cpp;
//          tests/tools/strata/program/system_faults_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scenes/exr/byte_sink.h"

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
    std::string name{};                               // "" if the file has only one part
    std::vector<StoredChannel> channels{};            // in the order of their bytes in a pixel
    std::map<std::string, std::string> attributes{};  // text attributes, under their full names
    StoredSpace space = StoredSpace::linear;          // set by the writer; not read
    bool is_deep = false;
};

[[nodiscard]] inline std::size_t pixel_bytes(const PartHeader& header) noexcept {
    std::size_t bytes = 0;
    for (const StoredChannel& channel : header.channels) bytes += size_of(channel.type);
    return bytes;
}

// `rows(first, last)` returns the bytes of the rows from `first` to `last` - 1: pixel by pixel (deep: sample by
// sample), with interleaved channels, each in its own type. They are valid until the next call, also of another part's.
// The writer requests every row once, from the top, part after part.
struct PartSource {
    PartHeader header;
    std::function<const std::byte*(int first, int last)> rows;
    std::span<const std::uint32_t> samples{};  // per pixel; only deep parts have them
};

// One part of an EXR file as read.
struct StoredPart {
    PartHeader header;
    bool is_whole = false;                 // false: the file is damaged and there are no bytes
    std::vector<std::byte> bytes{};        // laid out as PartSource::rows
    std::vector<std::uint32_t> samples{};  // per pixel; only deep parts have them
};

namespace exr {

// OpenEXR compresses and decompresses on threads of its own, one per processor. The first call starts them; reading and
// writing call it, too. Call it before the program's own loops start threads. If the system allows no thread the caller
// does the work. Returns the number of threads.
int start_threads();

// Returns "", or OpenEXR's message. A failure of the sink is reported by the sink's owner.
[[nodiscard]] std::string write_parts(const ByteSink& sink, std::span<const PartSource> parts);

// Calls `take` with part after part, the channels sorted by name. A part has the size of the display window: pixels
// that its data window lacks are 0 (deep: have no sample). InputError if `path` is no EXR file, or has a part
// that is larger than 16384 x 16384 or has channels of fewer samples than pixels; all parts are checked before the
// first is read.
void read_parts(const std::string& path, const std::function<void(StoredPart&&)>& take);

}  // namespace exr
}  // namespace strata::scenes
