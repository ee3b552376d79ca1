// scenes/images/image_module.h - the border to OpenImageIO: what the rest of the project asks of it, and what it
// answers.
//
// Rule     OpenImageIO brings some 250 shared libraries, so it stands in a shared library of its own that is loaded
//          when the first picture is read (files/load_module.h; images/png_encode.h writes). Standard types alone cross
//          the border: a `pipeline::Image` has an allocator that the module does not share. The module knows no format
//          of a target, no digest and no temporary name; its answers are bytes, sizes and sentences.
// Tests    tests/scenes/files/png_test.cpp; tests/tools/image_module_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/place.h"

namespace strata::scenes {

// The bytes of a file and what its header says of its size.
struct EncodedPicture {
    Bytes bytes;
    const char* reader = "";    // OpenImageIO's name of the format: "png", "jpeg", "pnm"
    int width = 0, height = 0;  // 0: the header has not been read
};

// The largest picture, a side in pixels, and how many bytes of pixels a byte of a file may stand for.
inline constexpr std::uint32_t max_image_side = 16384;
inline constexpr std::uint64_t max_packing = 2048;

// A picture's channels as the file has them, 1 to 4: a palette is looked up, nothing else is changed. 1 and 2 channels
// are grey; the last of 2 and of 4 is alpha. Codes of 8 or 16 bits; or halves of 16 and floats of 32 bits.
struct StoredCodes {
    int width = 0, height = 0, channels = 0, bits = 8;
    bool is_float = false;
    std::vector<std::uint32_t> codes{};
};

struct ImageModule {
    const char* version;
    // width * height * 4 codes. InputError at `place` where the bytes do not decode to that size.
    std::vector<std::uint8_t> (*decode)(const EncodedPicture& picture, const Place& place);
    // The same without a change to channels or bits; of any format that the library reads.
    StoredCodes (*decode_codes)(const EncodedPicture& picture, const Place& place);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* image_module_symbol = "strata_image_module";
using ImageModuleEntry = const ImageModule* (*)();

}  // namespace strata::scenes
