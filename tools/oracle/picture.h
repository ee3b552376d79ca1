// tools/oracle/picture.h - a picture of any program: targets with raw codes, read from a file without changing a bit.
//
// Rule     EXR: parts with R, G, B, A (or fewer), Z and the codes that Strata writes beside them; PNG of 8 and 16 bits with grey, colour
//          and alpha as the file has them; NPY of shape (rows, columns) or (rows, columns, channels) in C order with elements u1, u2,
//          u4, f2 or f4, little endian; deep EXR parts as layers (read_deep.h); raw bytes with a stated layout. Nothing is scaled, premultiplied or decoded.
// Tests    tests/tools/oracle/read_picture_test.cpp
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/formats/image.h"
#include "tools/oracle/codes.h"

namespace strata::pipeline {
struct Image;
}

namespace strata::oracle {

enum class Meaning : std::uint8_t { color, depth, other };

// Rows from the top, pixel by pixel, channel by channel.
struct Target {
    std::string part{};  // "layer.000"; "" where the file has one picture
    std::string name{};  // "color", "depth"
    Meaning meaning = Meaning::color;
    Code code = Code::unorm8;
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint32_t> codes{};

    [[nodiscard]] std::size_t pixels() const noexcept {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    [[nodiscard]] Stored at(std::size_t pixel, int channel) const noexcept {
        return {code, codes[pixel * static_cast<std::size_t>(channels) + static_cast<std::size_t>(channel)]};
    }
    [[nodiscard]] double value_at(std::size_t pixel, int channel) const noexcept {
        const Stored stored = at(pixel, channel);
        return value(stored.code, stored.word);
    }
};

// Of a target's codes.
[[nodiscard]] Code code_of(pipeline::Format format);

struct Picture {
    std::string file{};
    std::vector<Target> targets{};  // at least one
};

[[nodiscard]] inline bool has_depth(const Picture& picture) {
    return std::ranges::any_of(picture.targets, [](const Target& t) { return t.meaning == Meaning::depth; });
}

// The layout of a file of bare numbers: little endian, rows without padding.
struct RawLayout {
    int width = 0, height = 0, channels = 0;
    Code code = Code::unorm8;
    Meaning meaning = Meaning::color;
    bool bottom_up = false;  // the first row in the file is the lowest, as glReadPixels leaves it
};

// "640x480:rgba8", "640x480:d24:bottom-up"; formats r, rg, rgb and rgba with 8, 16, 16f or 32f, and d16, d24 (in 32-bit words), d32f.
// Nothing for any other text.
[[nodiscard]] std::optional<RawLayout> raw_layout(std::string_view text);

// A finished target as it is, without a part.
[[nodiscard]] Target as_target(const pipeline::Image& image, std::string name);

// By the ending of the name: .exr, .png, .npy; all else is raw and needs a layout. InputError names file and place.
[[nodiscard]] Picture read_picture(const std::string& path, const std::optional<RawLayout>& layout = {});

}  // namespace strata::oracle
