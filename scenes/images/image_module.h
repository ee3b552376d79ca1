// scenes/images/image_module.h - the border to OpenImageIO: what the rest of the project asks of it, and what it answers.
//
// Rule     OpenImageIO brings some 250 shared libraries, so it stands in a shared library of its own that is loaded
//          when the first PNG or JPEG is read (files/load_image_module.h; images/png_encode.h writes). Standard types alone cross the
//          border: a `pipeline::Image` has an allocator that the module does not share. The module knows no format of
//          a target, no digest and no temporary name; its answers are bytes, sizes and sentences.
// Tests    tests/scenes/files/png_test.cpp; tests/tools/image_module_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/place.h"

namespace strata::scenes {

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

struct ImageModule {
    const char* version;
    // width * height * 4 codes. InputError at `place` where the bytes do not decode to that size.
    std::vector<std::uint8_t> (*decode)(const EncodedPicture& picture, const Place& place);
    // The same without a change to width, channels or bits.
    StoredCodes (*decode_codes)(const EncodedPicture& picture, const Place& place);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* image_module_symbol = "strata_image_module";
using ImageModuleEntry = const ImageModule* (*)();

}  // namespace strata::scenes
