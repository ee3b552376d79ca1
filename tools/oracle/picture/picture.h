// tools/oracle/picture/picture.h - an image from any program: targets with raw codes, read from a file without changing
// a bit.
//
// Rule     EXR: parts with R, G, B, A (or fewer), Z and the additional codes that Strata writes; PNG, JPEG, PPM, PGM,
//          TGA, BMP, TIFF (8 and 16 bits, floats) and Radiance HDR with grey, colour and alpha as stored; NPY of shape
//          (rows, columns) or (rows, columns, channels) in C order with elements u1, u2, u4, f2 or f4, little endian;
//          deep EXR parts as layers (read_deep.h); raw bytes with a given layout. Nothing is scaled, premultiplied or
//          decoded; an orientation that TIFF or EXIF states is applied.
// Tests    tests/tools/oracle/picture/read_picture_test.cpp
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/formats/image.h"
#include "tools/oracle/picture/codes.h"

namespace strata::pipeline {
struct Image;
}

namespace strata::oracle {

// The name of one sample of a target: "color.sample2", or the target's own in a frame of one sample.
[[nodiscard]] inline std::string name_of_sample(const std::string& target, int sample, int samples) {
    return samples == 1 ? target : target + ".sample" + std::to_string(sample);
}

enum class Meaning : std::uint8_t { color, depth, other };

// The relation of colours to their alpha: unknown; not multiplied by it (PNG, TGA, BMP, TIFF); multiplied by it (EXR,
// and every finished frame of this project).
enum class AlphaForm : std::uint8_t { unknown, straight, premultiplied };

// Rows from the top, pixel by pixel, with interleaved channels.
struct TargetImage {
    std::string part{};  // "layer.000"; "" if the file has one image
    std::string name{};  // "color", "depth"
    Meaning meaning = Meaning::color;
    Code code = Code::unorm8;
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint32_t> codes{};
    bool is_grey = false;  // the first of one or two channels is used for red, green and blue; a second one is alpha
    AlphaForm alpha_form = AlphaForm::unknown;
    bool holds_encoded = false;  // a file for display (PNG, JPEG, TGA ...), whose values are encoded for sRGB

    [[nodiscard]] std::size_t pixels() const noexcept {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    [[nodiscard]] StoredCode at(std::size_t pixel, int channel) const noexcept {
        return {code, codes[pixel * static_cast<std::size_t>(channels) + static_cast<std::size_t>(channel)]};
    }
    [[nodiscard]] double value_at(std::size_t pixel, int channel) const noexcept {
        const StoredCode stored = at(pixel, channel);
        return value(stored.code, stored.word);
    }
};

// The type of a target's codes.
[[nodiscard]] Code code_of(pipeline::Format format);

struct Picture {
    std::string file{};
    std::vector<TargetImage> targets{};  // at least one
};

[[nodiscard]] inline bool has_depth(const Picture& picture) {
    return std::ranges::any_of(picture.targets, [](const TargetImage& t) { return t.meaning == Meaning::depth; });
}

// The layout of a pixel's channels in plain numbers: interleaved, red first or blue first; or a little-endian word of
// 32 bits, from its lowest bit: red, green, blue of 10 bits and alpha of 2 (OpenGL's 2_10_10_10_REV, DXGI's
// R10G10B10A2), or blue, green, red and alpha.
// Depth of 24 bits with 8 bits of something else above it, or below it.
enum class Packing : std::uint8_t { channels, blue_first, rgb10a2, bgr10a2, low_depth, high_depth };

// The layout of a file of plain little-endian numbers.
struct RawLayout {
    int width = 0, height = 0, channels = 0;
    Code code = Code::unorm8;  // unorm10 for packed words, whose 2-bit alpha becomes a 10-bit code of its value
    Meaning meaning = Meaning::color;
    Packing packing = Packing::channels;
    bool bottom_up = false;     // the first row in the file is the lowest, as from glReadPixels
    std::size_t offset = 0;     // bytes before the first row
    std::size_t row_bytes = 0;  // from one row to the next; 0: rows without padding
    friend bool operator==(const RawLayout&, const RawLayout&) = default;
};

// WIDTHxHEIGHT:FORMAT[:bottom-up][:offset=BYTES][:stride=BYTES], as "640x480:rgba8" or
// "640x480:bgra8:offset=54:bottom-up". Formats: r, rg, rgb and rgba with 8, 16, 16f or 32f; bgr8, bgra8, rgb10a2,
// bgr10a2; d16, d24 (in 32-bit words whose upper byte is 0), d32f; and named from the highest bit of a 32-bit word:
// x8d24 (the upper byte is anything), s8d24 (Direct3D's D24_UNORM_S8_UINT), d24s8 (OpenGL's UNSIGNED_INT_24_8), of
// which the stencil is left out. Empty for any other text.
[[nodiscard]] std::optional<RawLayout> raw_layout(std::string_view text);
inline constexpr const char* raw_layout_expected =
    "WIDTHxHEIGHT:FORMAT such as 640x480:rgba8, bgra8, rgb10a2, rgb16, rgba32f, d24, d24s8 or d32f, and :bottom-up if "
    "the "
    "lowest row comes first, "
    ":offset=BYTES for a header, :stride=BYTES from row to row";

// A finished target, unchanged, without a part.
[[nodiscard]] TargetImage as_target(const pipeline::Image& image, std::string name);

// By the ending of the name: .exr, .npy, or an image format (image_decode.h, reader_of); all other files are raw and
// need a layout. InputError names the file and the position.
[[nodiscard]] Picture read_picture(const std::string& path, const std::optional<RawLayout>& layout = {});

}  // namespace strata::oracle
