// pipeline/formats/image.h - a finished rectangle of raw target codes: the result that is digested, written and
// compared.
#pragma once
#include <cstdint>
#include <string>

#include "pipeline/formats/format.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

using ImageCodes = UninitializedVector<std::uint32_t>;

// One code per channel; rows from top to bottom, pixels from left to right, samples, then channels R G B A. UNORM8 and
// stencil codes and half-float bits are zero-extended to 32 bits; binary32 bits and depth codes are stored unchanged
// (D32F: float bits).
struct Image {
    Format format = Format::rgba8;
    int width = 0, height = 0, samples = 1;
    ImageCodes codes;

    Image() = default;
    Image(Format f, int w, int h, int s = 1) : format{f}, width{w}, height{h}, samples{s}, codes(size(), 0u) {}
    // Leaves the codes uninitialized, for callers that write all of them.
    [[nodiscard]] static Image for_overwrite(Format f, int w, int h, int s = 1) {
        Image image;
        image.format = f;
        image.width = w;
        image.height = h;
        image.samples = s;
        image.codes.resize(image.size());
        return image;
    }

    // The number of codes: width * height * samples * channels.
    [[nodiscard]] std::size_t size() const noexcept {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(samples) *
               static_cast<std::size_t>(channels());
    }
    [[nodiscard]] int channels() const noexcept { return info(format).channels; }
    // The index of a code in `codes`; y is 0 in the top row.
    [[nodiscard]] std::size_t index(int x, int y, int channel = 0, int sample = 0) const noexcept {
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        return (pixel * static_cast<std::size_t>(samples) + static_cast<std::size_t>(sample)) *
                   static_cast<std::size_t>(channels()) +
               static_cast<std::size_t>(channel);
    }
    friend bool operator==(const Image&, const Image&) = default;
};

// XXH3-128 in lower-case hexadecimal (high 64 bits first) of: the format's name in ASCII, a zero byte, u32 width, u32
// height, u32 samples, then the codes in the order above: u8 for UNORM8 and stencil, u16 for halves, u32 for binary32
// and every depth format; all little-endian (pipeline/reference/formats.md 8).
[[nodiscard]] std::string digest(const Image& image);

}  // namespace strata::pipeline
