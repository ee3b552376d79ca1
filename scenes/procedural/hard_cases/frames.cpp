// scenes/procedural/hard_cases/frames.cpp - frames of one pixel, of one row or column, and of the largest size that the
// older devices support.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

void three_layers(CaseScene& scene) {
    for (int i = 0; i < 3; ++i) add_quad(scene, whole(scene), {(i + 1) / 4.0, 0, 0}, color_of(i));
}

// A plane whose depth increases from 1/4 to 3/4, and one whose depth decreases from 3/4 to 1/4.
void crossing(CaseScene& scene) {
    const double slope = 0.25 / (scene.width > scene.height ? scene.width : scene.height);
    add_quad(scene, whole(scene), {0.25, slope, slope}, color_of(1));
    add_quad(scene, whole(scene), {0.75, -slope, -slope}, color_of(2));
}

// A row and a column of pixels through the middle, whose depths increase equally from 1/4, and two layers of 8 x 8
// pixels in each corner: a large frame that is cheap to check.
void cross_and_corners(CaseScene& scene) {
    const double side = scene.width, middle = side / 2, slope = 0.5 / side;
    add_quad(scene, {0, middle, side, middle + 1}, {0.25, slope, 0}, color_of(1));
    add_quad(scene, {middle, 0, middle + 1, side}, {0.25, 0, slope}, color_of(2));
    for (const double left : {0.0, side - 8})
        for (const double top : {0.0, side - 8})
            for (int i = 0; i < 2; ++i)
                add_quad(scene, {left, top, left + 8, top + 8}, {0.625 - 0.125 * i, 0, 0}, color_of(3 + i));
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
        // 2 * 8192 fragments of the cross, and 2 * 64 in each corner. At (4096, 4096) both have depth 1/4 + 4096.5 /
        // 16384.
        {.name = "frame-8192x8192",
         .hard = "The frame has 67 million pixels; a row, a column and the corners are drawn.",
         .answer = "One layer along the row and the column, which tie where they meet; two in each corner.",
         .width = 8192,
         .height = 8192,
         .build = cross_and_corners,
         .counts = {16896, 2, 2, 1}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
