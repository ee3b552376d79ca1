// scenes/procedural/hard_cases/frames.cpp - frames of one pixel, of one row, and of sides that tiles do not divide.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

void three_layers(CaseScene& scene) {
    for (int i = 0; i < 3; ++i) add_quad(scene, whole(scene), {(i + 1) / 4.0, 0, 0}, color_of(i));
}

// Depths from 1/4 to 3/4 and back.
void crossing(CaseScene& scene) {
    const double slope = 0.25 / (scene.width > scene.height ? scene.width : scene.height);
    add_quad(scene, whole(scene), {0.25, slope, slope}, color_of(1));
    add_quad(scene, whole(scene), {0.75, -slope, -slope}, color_of(2));
}

}  // namespace

std::span<const HardCase> frame_cases() {
    static const HardCase cases[]{
        {.name = "frame-1x1",
         .hard = "The frame is one pixel.",
         .answer = "Three layers.",
         .width = 1,
         .height = 1,
         .build = three_layers,
         .counts = {3, 3, 3, 0}},
        // The planes meet where x + y is the longer side: i + j = 63, 64 pixels.
        {.name = "frame-64x64",
         .hard = "Two planes cross along a diagonal of pixel centres of a frame of 64 x 64.",
         .answer = "Two layers a pixel; 64 pixels have a tie.",
         .width = 64,
         .height = 64,
         .build = crossing,
         .counts = {8192, 2, 2, 64},
         .is_moved = true},
        {.name = "frame-1x64",
         .hard = "The frame is one column of 64 pixels.",
         .answer = "Two layers a pixel; one pixel has a tie.",
         .width = 1,
         .height = 64,
         .build = crossing,
         .counts = {128, 2, 2, 1}},
        {.name = "frame-16384x1",
         .hard = "The frame is one row of 16,384 pixels, the widest there is.",
         .answer = "Two layers a pixel; one pixel has a tie.",
         .width = 16384,
         .height = 1,
         .build = crossing,
         .counts = {32768, 2, 2, 1}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
