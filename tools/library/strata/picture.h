// strata/picture.h - copies pictures between the library and a program's own memory, without changing a bit.
//
// Rule     A picture is one or more targets with their stored codes (tools/oracle/picture/picture.h). Memory is little
//          endian, with rows from the top unless the layout says otherwise, with or without padding after each row.
//          Nothing is scaled, multiplied by alpha or decoded.
// Tests    tests/tools/library/memory_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/formats/image.h"
#include "tools/oracle/picture/picture.h"

namespace strata {
inline namespace v0_1 {

// The type of a picture with one or more targets; read_picture(path) reads it from an .exr, .png or .npy file.
using oracle::Picture;
using oracle::read_picture;
using pipeline::Image;

// Parses "640x480:rgba8" or "640x480:d24:bottom-up", as `strata compare --layout` does. Throws InputError for any other
// text.
[[nodiscard]] oracle::RawLayout layout(std::string_view text);

// Copies a picture from `memory`. row_bytes 0: rows without padding. Throws InputError unless all rows are within
// `memory`.
[[nodiscard]] Picture from_memory(std::span<const std::byte> memory, const oracle::RawLayout& layout,
                                  std::size_t row_bytes = 0);
[[nodiscard]] Picture from_memory(const void* memory, std::size_t bytes, std::string_view layout,
                                  std::size_t row_bytes = 0);

// A finished target as a picture that can be compared; with two arguments one picture with colour and depth.
[[nodiscard]] Picture picture_of(const Image& image);
[[nodiscard]] Picture picture_of(const Image& color, const Image& depth);

// Bytes per channel in memory: 1 for 8-bit codes, 2 for halves and D16, else 4.
[[nodiscard]] std::size_t channel_bytes(const Image& image) noexcept;
enum class Rows : std::uint8_t { top_down, bottom_up };
// Writes the codes of every channel to `memory`; row_bytes 0: rows without padding. Throws InputError if it is too
// small.
void to_memory(const Image& image, std::span<std::byte> memory, Rows rows = Rows::top_down, std::size_t row_bytes = 0);
// The same in a new vector, without padding.
[[nodiscard]] std::vector<std::byte> to_memory(const Image& image, Rows rows = Rows::top_down);

}  // namespace v0_1
}  // namespace strata
