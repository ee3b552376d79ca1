// scenes/files/image_io.h - finished targets to PNG and EXR files and back, without losing a bit or adding one.
//
// Rule     The file's name decides: .png holds 8-bit straight colours, .exr everything. images.md 2 and 3 list
//          channels, parts, attributes and the conversion to 8 bits. The same call writes the same bytes: no time, host
//          or path goes in. Written under a temporary name and renamed: SystemError, and no file, if that fails.
// Source   images.md 2 to 6; OpenImageIO would multiply PNG colours by alpha and stamp the time into EXR files unless
//          told not to.
// Tests    tests/scenes/files/png_test.cpp, exr_test.cpp, deep_exr_test.cpp
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pipeline/formats/image.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::scenes {

using Attributes = std::map<std::string, std::string>;  // stored as "strata:KEY"

struct OutputColor {
    pipeline::Image color{};     // one sample, a colour format
    pipeline::Image depth{};     // of the same size, or empty
    bool premultiplied = false;  // whether `color` holds colours times alpha
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;
    Attributes attributes{};  // formats, digests, colour space and the form of alpha are added by the writer
    std::string part{};       // its name among layers; "": layer.NNN by its number
};

// The kind of file that the ending of its name asks for.
enum class ImageFile : std::uint8_t { png, exr };

// By the name's ending; InputError if it is neither .png nor .exr. Call it before rendering.
[[nodiscard]] ImageFile image_file(const std::string& path);

// One target, with its depths in an EXR; a PNG leaves depths out. The second one is for a path whose ending says
// nothing, such as "-", standard output.
void write_image(const std::string& path, const OutputColor& image);
void write_image(const std::string& path, const OutputColor& image, ImageFile kind);

// Part `layer.000`, `layer.001` ... of one EXR file, or as each says; all of one size, and at least one.
void write_layers(const std::string& path, std::span<const OutputColor> layers);

// Every fragment of every pixel, pixel by pixel in rows from the top; within a pixel in the order given.
struct DeepFragments {
    int width = 0, height = 0;
    bool premultiplied = false;  // whether `rgba` holds colours times alpha
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;
    std::vector<std::uint32_t> count{};       // fragments a pixel
    std::vector<std::uint32_t> depth_code{};  // the others: one entry a fragment
    // The depth as a value, and the colour at that fragment.
    std::vector<float> z{};
    std::vector<pipeline::Rgba> rgba{};
    // The number of the triangle in submission order.
    std::vector<std::uint32_t> primitive{};
    friend bool operator==(const DeepFragments&, const DeepFragments&) = default;
};

// One deep part, in the binary32 and u32 channels that deep_exr.cpp lists. InputError unless the name ends in
// .exr.
void write_deep(const std::string& path, const DeepFragments& fragments, const Attributes& attributes);
[[nodiscard]] DeepFragments read_deep(const std::string& path);  // rgba as in the file: premultiplied

// The hash of pipeline::digest over "deep", a zero byte, width and height, the fragments of each pixel, then of each
// fragment R G B A (premultiplied), Z, depth code and primitive: u32 all of them.
[[nodiscard]] std::string digest(const DeepFragments& fragments);

// A target found in a file: "color" or "depth", of the part `layer.000` or of the whole file (part "").
struct FileImage {
    std::string part, target;
    pipeline::Image image;
};

// The targets of a file: a PNG's 8-bit codes, an EXR's codes. InputError for what is no such image, or a deep one.
[[nodiscard]] std::vector<FileImage> read_images(const std::string& path);

// One target's digest; of a deep part that of its "fragments", format "deep".
struct FileDigest {
    std::string part, target, format;
    int width = 0, height = 0;
    std::string digest;
};
// Part by part, so that no more than one part of a large file is in memory.
[[nodiscard]] std::vector<FileDigest> digests_of(const std::string& path);

// The pixels of a .png of `image`: straight alpha, 8-bit colours, encoded.
[[nodiscard]] pipeline::Image as_straight_rgba8(const OutputColor& image);

}  // namespace strata::scenes
