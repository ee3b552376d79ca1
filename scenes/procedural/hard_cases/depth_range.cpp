// scenes/procedural/hard_cases/depth_range.cpp - depths at the ends of the depth range, and narrow depth ranges.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// Squares at distances 2, 4, 8 and so on up to the far plane.
void powers_of_two(CaseScene& scene, double far) {
    scene.view = perspective_view(1, far);
    int number = 0;
    for (double w = 2; w < far; w *= 2) add_facing_quad(scene, w, color_of(number++));
}

void far_10(CaseScene& scene) { powers_of_two(scene, 10); }
void far_1000(CaseScene& scene) { powers_of_two(scene, 1e3); }
void far_million(CaseScene& scene) { powers_of_two(scene, 1e6); }
void far_billion(CaseScene& scene) { powers_of_two(scene, 1e9); }

void flat(CaseScene& scene, std::initializer_list<double> depths) {
    int number = 0;
    for (const double depth : depths) add_quad(scene, whole(scene), {depth, 0, 0}, color_of(number++));
}

void eighths(CaseScene& scene) { flat(scene, {0.125, 0.875, 0.25, 0.75, 0.375, 0.625, 0.5}); }
void zero_and_one(CaseScene& scene) { flat(scene, {1, 0.5, 0}); }
void last_unit(CaseScene& scene) { flat(scene, {1 - 0x1p-20, 1 - 0x1p-24, 1 - 0x1p-25}); }
void first_unit(CaseScene& scene) { flat(scene, {0x1p-23, 0x1p-24, 0x1p-25}); }

void clear_equals_depth(CaseScene& scene) {
    add_opaque_quad(scene, whole(scene), {0.5, 0, 0}, {0.25f, 0.5f, 0.75f, 1});
    flat(scene, {0.25, 0.5, 0.75});
}

void opaque_crossing(CaseScene& scene) {
    add_opaque_quad(scene, whole(scene), {0.5, 0, 0}, {0.25f, 0.5f, 0.75f, 1});
    add_quad(scene, whole(scene), {0.5 - 16.5 / 64, 0, 1.0 / 64}, color_of(1));
}

}  // namespace

std::span<const HardCase> depth_range_cases() {
    static const HardCase cases[]{
        {.name = "far-10-times-near",
         .hard = "Squares stand at 2, 4 and 8 times the near plane's distance; far is 10.",
         .answer = "Three layers.",
         .build = far_10,
         .counts = {3072, 3, 3, 0}},
        {.name = "far-1000-times-near",
         .hard = "Squares stand at every power of two between near and far; far is 1000.",
         .answer = "Nine layers.",
         .build = far_1000,
         .counts = {9216, 9, 9, 0}},
        {.name = "far-million-times-near",
         .hard = "Squares stand at every power of two between near and far; far is 10^6.",
         .answer = "19 layers.",
         .build = far_million,
         .counts = {19456, 19, 19, 0},
         .is_moved = true},
        {.name = "far-billion-times-near",
         .hard = "Squares stand at every power of two between near and far; far is 10^9.",
         .answer = "29 layers, of which the last are closer to depth 1 than binary32 can say.",
         .build = far_billion,
         .counts = {29696, 29, 29, 0}},
        {.name = "depth-denormal",
         .hard = "The depth range is 0 to 2^-130, so that all depths are denormal numbers of binary32.",
         .answer = "Seven layers.",
         .build = eighths,
         .counts = {7168, 7, 7, 0},
         .depth_far = 0x1p-130f},
        {.name = "depth-zero-and-one",
         .hard = "Squares stand at depth 0 and at depth 1 exactly, where buffers are cleared to 1.",
         .answer = "Two layers: what is at depth 1 is not nearer than nothing.",
         .build = zero_and_one,
         .counts = {2048, 2, 2, 0}},
        {.name = "last-depth-unit",
         .hard = "Of three squares two are nearer to depth 1 than one code of a 24-bit buffer.",
         .answer = "Three layers.",
         .build = last_unit,
         .counts = {3072, 3, 3, 0}},
        {.name = "first-depth-unit",
         .hard = "Three squares have depths 2^-25, 2^-24 and 2^-23.",
         .answer = "Three layers.",
         .build = first_unit,
         .counts = {3072, 3, 3, 0}},
        {.name = "clear-equals-depth",
         .hard = "A transparent square lies exactly on the opaque surface, another before and another behind it.",
         .answer = "One layer: equal to the opaque depth is not nearer.",
         .build = clear_equals_depth,
         .counts = {1024, 1, 1, 0}},
        // Rows 0 to 15 are in front of the opaque surface; row 16 is exactly on it.
        {.name = "opaque-crossing",
         .hard = "A transparent plane crosses the opaque surface along the centres of a row of pixels.",
         .answer = "The 16 rows above that row have a layer, the row itself has none.",
         .build = opaque_crossing,
         .counts = {512, 1, 1, 0},
         .is_moved = true},
        {.name = "equal-near-and-far",
         .hard = "The depth range begins and ends at 1/2, so that every fragment has the same depth.",
         .answer = "Seven fragments a pixel, of one depth.",
         .build = eighths,
         .counts = {7168, 7, 1, 1024},
         .depth_near = 0.5f,
         .depth_far = 0.5f},
        {.name = "reversed-range",
         .hard = "The depth range runs from 1 to 0.",
         .answer = "Seven layers in the opposite order; a peel refuses it by name.",
         .build = eighths,
         .counts = {7168, 7, 7, 0},
         .depth_near = 1,
         .depth_far = 0},
        {.name = "narrow-range",
         .hard = "The depth range is 2^-14 wide: seven layers share four codes of a 16-bit buffer.",
         .answer = "Seven layers.",
         .build = eighths,
         .counts = {7168, 7, 7, 0},
         .depth_near = 0.5f,
         .depth_far = 0.5f + 0x1p-14f},
    };
    return cases;
}

}  // namespace strata::scenes::hard
