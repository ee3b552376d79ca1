// pipeline/region/repeated_pass.h - what a pass left that a next one may leave again: a peel by another depth than the stored one comes to
// fragments that lie behind themselves, and finds the same in every pass (execution.md 7.1).
//
// Rule     FragmentSelection::repeats promises that a pass whose bounds are those of the pass before writes what that one wrote. Bounds
//          are the codes of `behind` and of the depth target, at all pixels of the region; where nothing lay behind the former, nothing
//          lies behind greater ones.
// Numbers  12 bytes a pixel of a tile and up to 20 a pixel with a kept fragment, once a thread, beside --fragment-memory.
// Tests    tests/pipeline/region/repeated_pass_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/frame/pass.h"

namespace strata::pipeline {

struct RepeatedPass {
    FragmentSelection selection;  // without its targets
    Format color_format = Format::rgba8;
    std::vector<std::uint32_t> behind, stored;  // codes before the pass
    std::vector<std::uint32_t> behind_most;     // up to which `behind` finds the same
    std::vector<std::uint32_t> left;            // words of depth and of colour, each of all kept fragments

    void begin(const std::uint32_t* behind_codes, const std::uint32_t* stored_codes, std::size_t pixels) {
        behind.assign(behind_codes, behind_codes + pixels);
        stored.assign(stored_codes, stored_codes + pixels);
        behind_most.assign(pixels, ~0u);  // where there are no fragments
    }
    [[nodiscard]] bool is_of(const std::uint32_t* behind_codes, const std::uint32_t* stored_codes) const noexcept {
        std::uint32_t differing = 0;
        for (std::size_t p = 0; p < behind.size(); ++p)
            differing |= mask(behind_codes[p] < behind[p]) | mask(behind_codes[p] > behind_most[p]) |
                         (stored_codes[p] ^ stored[p]);
        return differing == 0;
    }
};

}  // namespace strata::pipeline
