// scenes/procedural/hard_cases/hard_case.h - small scenes on which rasterizers and peels fail, each with its exact
// answer.
//
// Rule     A case is a draw list, a view and a frame. Its corners are the same binary32 numbers on every computer, and
//          its answer is counted over exact geometry: positions are not snapped, planes are not rounded, and a pixel
//          centre on an edge belongs to a triangle by the top-left rule.
// Tests    tests/scenes/procedural/hard_cases_test.cpp: every answer by rational arithmetic
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace strata::scenes {

// A fragment is visible if it is between the near and the far plane, both inclusive, and its exact window depth is less
// than the opaque surface's, or less than 1 where there is no opaque surface.
struct HardAnswer {
    // Visible fragments of the frame.
    std::uint64_t fragments = 0;
    // The largest number of them, and of distinct exact depths, at one pixel.
    int deepest = 0, layers = 0;
    // Pixels where two visible fragments have exactly the same depth.
    std::uint64_t tied_pixels = 0;
    friend bool operator==(const HardAnswer&, const HardAnswer&) = default;
};

// The scene of a case: triangles of two materials, both two-sided and unlit.
struct CaseScene {
    int width = 1, height = 1;  // pixels
    pipeline::Mesh transparent{}, opaque{};
    pipeline::View view{};
    std::vector<pipeline::Texture> textures{};  // the first belongs to the transparent material
};

struct HardCase {
    std::string_view name;
    std::string_view hard;    // the difficulty, as one sentence
    std::string_view answer;  // the exact answer, as one sentence
    int width = 32, height = 32;
    void (*build)(CaseScene& scene) = nullptr;
    HardAnswer counts{};
    // The largest difference of a colour channel from all fragments composited in binary64, in 1/255, that an exact
    // algorithm may have on an 8-bit target where no tie loses a fragment.
    double bound = 7;
    // glDepthRange.
    float depth_near = 0, depth_far = 1;
    // The input contains numbers that are not finite, so an image may contain NaN or miss a triangle.
    bool is_non_finite = false;
    // Used in the measurements of stability and of flicker.
    bool is_moved = false;
};

// All cases in the order of the list; names are unique.
[[nodiscard]] std::span<const HardCase> hard_cases();

// Null if there is no such case.
[[nodiscard]] const HardCase* find_hard_case(std::string_view name);

// The scene, with the case's view as own_view.
[[nodiscard]] Scene make_hard_case(const SceneOptions& options, const HardCase& hard);

}  // namespace strata::scenes
