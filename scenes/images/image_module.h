// scenes/images/image_module.h - the interface of the module that wraps OpenImageIO.
//
// Rule     OpenImageIO depends on about 250 shared libraries, so it is in a separate shared library that is loaded when
//          the first image is read (files/load_module.h; images/png_encode.h writes). The interface uses only standard
//          types: a `pipeline::Image` has an allocator that the module does not share. The module does not know target
//          formats, digests or temporary names; it returns bytes, sizes and messages.
// Tests    tests/scenes/files/png_test.cpp; tests/tools/strata/render/image_module_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/file_location.h"

namespace strata::scenes {

// The bytes of a file, and the size in its header.
struct EncodedPicture {
    Bytes bytes;
    const char* reader = "";    // OpenImageIO's name of the format: "png", "jpeg", "pnm"
    int width = 0, height = 0;  // 0: the header has not been read
    // Called with the size before memory for the pixels is taken, and may throw.
    void (*check)(const FileLocation& location, int width, int height, std::uint64_t bytes_a_pixel) = nullptr;
};

// The largest width and height of an image in pixels, and the largest number of pixel bytes per byte of a file.
inline constexpr std::uint32_t max_image_side = 16384;
inline constexpr std::uint64_t max_packing = 2048;

// An image's channels as stored, 1 to 4: a palette is looked up, nothing else is changed. 1 and 2 channels are grey;
// the last of 2 and of 4 is alpha. Codes have 8 or 16 bits; halves have 16 and floats 32 bits.
struct FileCodes {
    int width = 0, height = 0, channels = 0, bits = 8;
    bool is_float = false;
    std::vector<std::uint32_t> codes{};
};

struct ImageModule {
    const char* version;
    // Returns width * height * 4 codes. InputError at `location` if the bytes do not decode to that size.
    std::vector<std::uint8_t> (*decode)(const EncodedPicture& picture, const FileLocation& location);
    // The same with channels and bits unchanged, for any format that the library reads.
    FileCodes (*decode_codes)(const EncodedPicture& picture, const FileLocation& location);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* image_module_symbol = "strata_image_module";
using ImageModuleEntry = const ImageModule* (*)();

}  // namespace strata::scenes
