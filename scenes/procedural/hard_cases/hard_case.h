// scenes/procedural/hard_cases/hard_case.h - small scenes on which rasterizers and peels go wrong, each with its right
// answer.
//
// Rule     A case is a draw list, a view and a frame. Its corners are the same binary32 numbers on every machine, and
//          its right answer is counted over exact geometry: positions that are not snapped, planes that are not
//          rounded, and a pixel centre on a side owned by the top-left rule.
// Tests    tests/scenes/procedural/hard_cases_test.cpp: every answer by rational arithmetic
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace strata::scenes {

// A fragment is visible if it lies between the near and the far plane, both included, and its exact window depth is
// less than the opaque surface's, or less than 1 where no opaque surface is.
struct HardAnswer {
    // Visible fragments of the frame.
    std::uint64_t fragments = 0;
    // The most of them at one pixel, and the most distinct exact depths at one pixel.
    int deepest = 0, layers = 0;
    // Pixels where two visible fragments have exactly the same depth.
    std::uint64_t tied_pixels = 0;
    friend bool operator==(const HardAnswer&, const HardAnswer&) = default;
};

// What a case is built into: triangles of two materials, both two-sided and unlit.
struct CaseScene {
    int width = 1, height = 1;  // pixels
    pipeline::Mesh transparent{}, opaque{};
    pipeline::View view{};
    std::vector<pipeline::Texture> textures{};  // the first one is the transparent material's
};

struct HardCase {
    std::string_view name;
    std::string_view hard;    // what is hard about it, a sentence
    std::string_view answer;  // the right answer, a sentence
    int width = 32, height = 32;
    void (*build)(CaseScene& scene) = nullptr;
    HardAnswer counts{};
    // The greatest difference of a colour channel from all fragments composited in binary64, in 1/255, that an exact
    // algorithm may show on an 8-bit target where no tie loses anything.
    double bound = 7;
    // glDepthRange.
    float depth_near = 0, depth_far = 1;
    // The numbers that went in are not all finite, so that a picture may hold a NaN or miss a triangle.
    bool is_non_finite = false;
    // Takes part in the measurements of stability and of flicker.
    bool is_moved = false;
};

// All cases, in the order in which they are listed; no name comes twice.
[[nodiscard]] std::span<const HardCase> hard_cases();

// Null if there is no such case.
[[nodiscard]] const HardCase* find_hard_case(std::string_view name);

// The scene, with the case's own view.
[[nodiscard]] Scene make_hard_case(const SceneOptions& options, const HardCase& hard);

}  // namespace strata::scenes
