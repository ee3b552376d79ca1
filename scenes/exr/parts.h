// scenes/exr/parts.h - the parts of an EXR file as bytes in their own types, read and written by OpenEXR.
//
// Rule     OpenEXR copies each channel in its own type, so no bit changes. What would depend on the time, the host or
//          the library's defaults is set here or left out. Colours say what they are in three ways, for viewers take an
//          EXR's colours for linear light where nothing says otherwise: `oiio:ColorSpace` (OpenImageIO),
//          `colorInteropID` (OpenEXR 3.4 and later) and `chromaticities` (those of BT.709 and its white in both
//          spaces).
// Tests    tests/scenes/files/exr_test.cpp, exr_foreign_test.cpp, deep_exr_test.cpp; tests/tools/system_faults_test.cpp
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
    std::string name{};                               // "" where the file has one part alone
    std::vector<StoredChannel> channels{};            // in the order in which a pixel's bytes hold them
    std::map<std::string, std::string> attributes{};  // those that are text, under their full names
    StoredSpace space = StoredSpace::linear;          // written, not read
    bool is_deep = false;
};

[[nodiscard]] inline std::size_t pixel_bytes(const PartHeader& header) noexcept {
    std::size_t bytes = 0;
    for (const StoredChannel& channel : header.channels) bytes += size_of(channel.type);
    return bytes;
}

// `rows(first, last)` gives the bytes of the rows from `first` to `last` - 1: pixel by pixel (deep: sample by sample),
// the channels one after the other, each in its own type. They stay until the next call, of another part, too. The
// writer asks for every row once, from the top, part after part.
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

namespace exr {

// OpenEXR packs and unpacks on threads of its own, one a processor. The first call starts them, reading and writing at
// the latest: call it before loops of ours take what the system has. Where the system refuses them the caller works by
// itself. Answers how many there are.
int start_threads();

// Answers "", or OpenEXR's words for what failed. A failure of the sink is its owner's to report.
[[nodiscard]] std::string write_parts(const ByteSink& sink, std::span<const PartSource> parts);

// Calls `take` with part after part, the channels in the order of their names. InputError if `path` is no EXR file, or
// one with a part that is larger than 16384 x 16384 or has channels of fewer samples than pixels; all parts are looked
// at before the first is read.
void read_parts(const std::string& path, const std::function<void(StoredPart&&)>& take);

}  // namespace exr
}  // namespace strata::scenes
