// tools/port/probe/kit.h - reads a kit of scenes written by `strata probe -o KIT`, with the port's own reader.
//
// Rule     KIT/kit.json (../../probe/DESIGN.md): floats are the 8 hexadecimal digits of their bits, so that no decimal
//          is parsed.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/port/gl/objects.h"

namespace strata::port {

struct KitBlend {
    GLenum equation = GL_FUNC_ADD, source = GL_ONE, destination = GL_ZERO;
};

struct KitDraw {
    // x y z w in clip space, then r g b a: 8 words per corner, bits of binary32.
    std::vector<std::uint32_t> words;
    std::optional<KitBlend> blend;
    // Factor and units.
    std::optional<std::array<float, 2>> polygon_offset;
    // The reference of an alpha test GREATER.
    std::optional<float> alpha_above;
};

struct KitItem {
    std::string name;
    FrameSize size;
    PixelFormat color;
    std::optional<PixelFormat> depth;
    std::array<float, 2> depth_range{0, 1};
    std::array<float, 4> clear{};
    std::vector<KitDraw> draws;
};

struct Kit {
    std::string digest;
    std::vector<KitItem> items;
    // As in the file, with their digest; an empty array and no digest if the file has none.
};

// The words of a text of hexadecimal digits, 8 per word.
[[nodiscard]] std::vector<std::uint32_t> words_of(const std::string& digits);
// Throws std::runtime_error with the file and the JSON pointer.
[[nodiscard]] Kit read_kit(const std::string& folder);

}  // namespace strata::port
