// scenes/procedural/hard_cases/clip.cpp - triangles that leave the view volume: at the eye, at the near and far planes,
// and far outside the frame.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// A floor one unit below the eye, from 64 in front of it to 64 behind it, and as wide as the view at its far end.
void through_the_eye(CaseScene& scene) {
    scene.view = perspective_view(0.25);
    add(scene.transparent, {pipeline::Vec3{-64, -1, -64}, {-64, -1, 64}, {64, -1, 64}}, color_of(1));
    add(scene.transparent, {pipeline::Vec3{-64, -1, -64}, {64, -1, 64}, {64, -1, -64}}, color_of(2));
}

// The tip of a wedge is in the eye's plane, where w is 0; its sides are the sides of the frame.
void w_zero(CaseScene& scene) {
    scene.view = perspective_view(0.25);
    add(scene.transparent, {pipeline::Vec3{0, -1, 0}, {64, -1, -64}, {-64, -1, -64}}, color_of(1));
}

void behind_the_eye(CaseScene& scene) {
    scene.view = perspective_view(0.5);
    add_facing_quad(scene, -2, color_of(1));
    add_facing_quad(scene, 2, color_of(2));
    add_facing_quad(scene, -0x1p-100, color_of(3));
}

void through_near(CaseScene& scene) { add_quad(scene, whole(scene), {-0.5, 1.0 / 32, 0}, color_of(1)); }
void through_far(CaseScene& scene) { add_quad(scene, whole(scene), {0.5, 1.0 / 32, 0}, color_of(1)); }

void through_near_and_far(CaseScene& scene) {
    add_quad(scene, whole(scene), {-1, 3.0 / 32, 0}, color_of(1));
    add_quad(scene, whole(scene), {2, 0, -3.0 / 32}, color_of(2));
}

void guard_band(CaseScene& scene) { add_quad(scene, {-32768, -32768, 32768, 32768}, {0.5, 0, 0}, color_of(1)); }

void beyond_guard_band(CaseScene& scene) {
    add_quad(scene, {-0x1p20, -0x1p20, 0x1p20, 0x1p20}, {0.5, 0, 0}, color_of(1));
    add_quad(scene, {-0x1p30, -16, 0x1p30, 48}, {0.25, 0, 0}, color_of(2), Diagonal::rising);
}

void vertices_1e38(CaseScene& scene) {
    add(scene.transparent, {pipeline::Vec3{-1e38f, -1e38f, 0}, {1e38f, -1e38f, 0}, {0, 1e38f, 0}}, color_of(1));
}

}  // namespace

std::span<const HardCase> clip_cases() {
    static const HardCase cases[]{
        // Window y is 16 + 16 / w: the floor begins at 16.25, above the centres of row 16, and ends below the frame.
        {.name = "through-the-eye",
         .hard = "A floor runs from in front of the eye to behind it: w goes from 64 over 0 to -64.",
         .answer = "It covers the lower half of the frame exactly once.",
         .build = through_the_eye,
         .counts = {512, 1, 1, 0}},
        {.name = "w-zero",
         .hard = "One corner of a triangle has w = 0 exactly, and two of its sides are the frame's.",
         .answer = "It covers the lower half of the frame exactly once.",
         .build = w_zero,
         .counts = {512, 1, 1, 0}},
        {.name = "behind-the-eye",
         .hard = "Of three squares one is in front of the eye and two are behind it, the last by 2^-100.",
         .answer = "One fragment a pixel.",
         .build = behind_the_eye,
         .counts = {1024, 1, 1, 0}},
        {.name = "through-near",
         .hard = "A square runs through the near plane in the middle of the frame.",
         .answer = "The right half of the frame has one fragment a pixel.",
         .build = through_near,
         .counts = {512, 1, 1, 0},
         .is_moved = true},
        {.name = "through-far",
         .hard = "A square runs through the far plane in the middle of the frame.",
         .answer = "The left half of the frame has one fragment a pixel.",
         .build = through_far,
         .counts = {512, 1, 1, 0},
         .is_moved = true},
        // Depth -1 + 3 (x + 1/2) / 32 is from 0 to 1 in columns 11 to 20, and the other square's in rows 11 to 20.
        // They tie where 3 (x + 1/2) / 32 - 1 = 2 - 3 (y + 1/2) / 32: x + y = 31, ten pixels of both bands.
        {.name = "through-near-and-far",
         .hard = "Two squares run through both the near and the far plane, one along x and one along y.",
         .answer = "A cross of two bands of 10 x 32 pixels; where the bands meet, ten pixels have a tie.",
         .build = through_near_and_far,
         .counts = {640, 2, 2, 10},
         .is_moved = true},
        {.name = "guard-band",
         .hard = "A square reaches 32,768 pixels to every side, where edge functions end.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = guard_band,
         .counts = {1024, 1, 1, 0}},
        {.name = "beyond-the-guard-band",
         .hard = "Squares reach 2^20 and 2^30 pixels beyond the frame and are cut before they are drawn.",
         .answer = "Every pixel of the frame has two fragments.",
         .build = beyond_guard_band,
         .counts = {2048, 2, 2, 0}},
        {.name = "vertices-1e38",
         .hard = "The corners of a triangle are 10^38 away, near the end of binary32.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = vertices_1e38,
         .counts = {1024, 1, 1, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
