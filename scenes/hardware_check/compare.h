// scenes/hardware_check/compare.h - a drawn picture against the chip's.
//
// Rule     Label pixels of a colour capture, (255, 255, 255, 0), and hidden rectangles are not compared. A colour pixel differs by
//          its largest channel difference in 1/255; a depth word by depth units, its stencil by itself. Words of 16 bits stand in
//          a capture as R5G6B5 widened: their upper bits are exact.
// Source   the captures' own descriptions, as repeated in nv2a-fragment.md and nv2a-geometry.md.
// Tests    tests/scenes/hardware_check_test.cpp
#pragma once
#include <array>
#include <map>
#include <optional>

#include "scenes/hardware_check/picture.h"

namespace strata::scenes::hardware_check {

struct Comparison {
    std::uint64_t compared = 0, differing = 0;
    std::uint32_t largest = 0;                          // difference
    std::map<std::int64_t, std::uint64_t> histogram{};  // difference, theirs minus ours -> pixels; colours: largest channel, no sign
    std::array<int, 2> first{};                         // x, y of the first differing pixel
    std::uint32_t ours = 0, theirs = 0;                 // there: the word, or the largest difference's channel
    bool within_bound = false;
};

// `capture`: rgba8. Throws InputError, naming `path`, if its size is another.
[[nodiscard]] Comparison compare(const Picture& drawn, const pipeline::Image& capture, const std::string& path);

// The drawn picture as a capture of it would look: rgba8, depth words shown as their reading says.
[[nodiscard]] pipeline::Image as_capture(const Picture& drawn);

// |difference| of every pixel, white where not compared; for people.
[[nodiscard]] pipeline::Image difference_picture(const Picture& drawn, const pipeline::Image& capture);

}  // namespace strata::scenes::hardware_check
