// scenes/files/image_io.h - writes finished targets to PNG and EXR files and reads them back, bit for bit.
//
// Rule     The file's ending selects the format: .png has 8-bit colours that are not premultiplied, .exr everything.
//          scenes/reference/images.md 2 and 3 list channels, parts, attributes and the conversion to 8 bits. The same
//          call writes the same bytes, without time, host or path. A file is written under a temporary name and
//          renamed; if that fails, SystemError is thrown and there is no file.
// Source   images.md 2 to 6; OpenImageIO would multiply PNG colours by alpha and stamp the time into EXR files by
//          default.
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
    pipeline::Image color{};     // single-sampled, a colour format
    pipeline::Image depth{};     // of the same size, or empty
    bool premultiplied = false;  // whether `color` is premultiplied by alpha
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;
    Attributes attributes{};  // the writer adds formats, digests, colour space and the form of alpha
    std::string part{};       // its name as a layer; "": layer.NNN by its index
};

// The file format given by the ending of a file's name.
enum class ImageFile : std::uint8_t { png, exr };

// By the name's ending; InputError if it is neither .png nor .exr. Call it before rendering.
[[nodiscard]] ImageFile image_file(const std::string& path);

// Writes one target, and in an EXR its depths; a PNG has no depths. The second overload is for a path without an
// ending, such as "-", standard output.
void write_image(const std::string& path, const OutputColor& image);
void write_image(const std::string& path, const OutputColor& image, ImageFile kind);

// Parts `layer.000`, `layer.001` ... of one EXR file, or with the names in `part`; all of one size, and at least one.
void write_layers(const std::string& path, std::span<const OutputColor> layers);

// Every fragment of every pixel: pixels in rows from the top, fragments of a pixel in the given order.
struct DeepFragments {
    int width = 0, height = 0;
    bool premultiplied = false;  // whether `rgba` is premultiplied by alpha
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;
    std::vector<std::uint32_t> count{};       // fragments per pixel
    std::vector<std::uint32_t> depth_code{};  // this array and the following have one entry per fragment
    // The depth as a value, and the fragment's colour.
    std::vector<float> z{};
    std::vector<pipeline::Rgba> rgba{};
    // The index of the triangle in submission order.
    std::vector<std::uint32_t> primitive{};
    friend bool operator==(const DeepFragments&, const DeepFragments&) = default;
};

// Writes a deep part for each sample of the pixels, named sample.0, sample.1 ... if there are several, with the
// binary32 and u32 channels listed in deep_exr.cpp. InputError unless the name ends in .exr.
void write_deep(const std::string& path, std::span<const DeepFragments> samples, const Attributes& attributes);
inline void write_deep(const std::string& path, const DeepFragments& fragments, const Attributes& attributes) {
    write_deep(path, std::span{&fragments, 1}, attributes);
}
[[nodiscard]] std::vector<DeepFragments> read_deep_samples(const std::string& path);  // rgba is premultiplied
[[nodiscard]] DeepFragments read_deep(const std::string& path);                       // the first part

// The hash of pipeline::digest over "deep", a zero byte, width and height, the fragments of each pixel, then of each
// fragment R G B A (premultiplied), Z, depth code and primitive, all as u32.
[[nodiscard]] std::string digest(const DeepFragments& fragments);

// A target found in a file: "color" or "depth", of the part `layer.000` or of the whole file (part "").
struct FileImage {
    std::string part, target;
    pipeline::Image image;
};

// The targets of a file: a PNG's 8-bit codes, an EXR's codes. InputError for other files and for a deep image.
[[nodiscard]] std::vector<FileImage> read_images(const std::string& path);

// One target's digest; for a deep part the digest of its "fragments", format "deep".
struct FileDigest {
    std::string part, target, format;
    int width = 0, height = 0;
    std::string digest;
};
// Reads part by part, so that only one part of a large file is in memory.
[[nodiscard]] std::vector<FileDigest> digests_of(const std::string& path);

// The pixels of a .png of `image`: 8-bit encoded colours, not premultiplied.
[[nodiscard]] pipeline::Image as_straight_rgba8(const OutputColor& image);

}  // namespace strata::scenes
