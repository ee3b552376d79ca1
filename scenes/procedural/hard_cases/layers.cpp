// scenes/procedural/hard_cases/layers.cpp - pixels with as many fragments as counters, sums and 8-bit blending can
// represent, and more.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// `count` flat layers over a box, 1/4096 of depth apart, in an order that is neither sorted nor random: 1237 is prime,
// so every layer occurs once.
void add_stack(CaseScene& scene, const CaseBox& box, int count, float alpha) {
    for (int i = 0; i < count; ++i) {
        const int layer = static_cast<int>(std::int64_t{i} * 1237 % count);
        add_quad(scene, box, {(layer + 1) / 4096.0, 0, 0}, color_of(layer, alpha));
    }
}

void one_layer(CaseScene& scene) { add_stack(scene, whole(scene), 1, 0.5f); }
void layers_64(CaseScene& scene) { add_stack(scene, whole(scene), 64, 0.25f); }
void layers_129(CaseScene& scene) { add_stack(scene, whole(scene), 129, 0.0625f); }
void layers_256(CaseScene& scene) { add_stack(scene, whole(scene), 256, 0.0625f); }
void layers_500(CaseScene& scene) { add_stack(scene, whole(scene), 500, 0.015625f); }

// A layer is one triangle over its pixel's corner, whose third side passes between the pixel's centre and the
// neighbouring centres.
void add_pixel(CaseScene& scene, double x, double y, int count) {
    for (int i = 0; i < count; ++i) {
        const int layer = static_cast<int>(std::int64_t{i} * 1237 % count);
        const double depth = (layer + 1) / 4096.0;
        add(scene, {CaseCorner{x, y, depth}, {x, y + 1.5, depth}, {x + 1.5, y, depth}}, color_of(layer, 0.03125f));
    }
}

// The first row, from left to right.
void add_row(CaseScene& scene, std::initializer_list<int> counts) {
    double x = 0;
    for (const int count : counts) add_pixel(scene, x++, 0, count);
}

void ladder(CaseScene& scene) {
    add_row(scene, {1, 2, 3, 5, 10, 100, 1000, 4000});
    for (int y = 1; y < 8; ++y)
        for (int x = 0; x < 8; ++x) add_pixel(scene, x, y, x + y);
}

void counts_past_2048(CaseScene& scene) { add_row(scene, {2047, 2049}); }

// 16,000 times 1 to 8: past 65,504 from the fifth pixel on.
void sums_past_65504(CaseScene& scene) {
    for (int count = 1; count <= 8; ++count)
        for (int i = 0; i < count; ++i)
            add_quad(scene, {count - 1.0, 0, static_cast<double>(count), 1}, {(i + 1) / 16.0, 0, 0},
                     {16000, 8000, 100, 1});
}

}  // namespace

std::span<const HardCase> layer_cases() {
    static const HardCase cases[]{
        {.name = "layer-1",
         .hard = "One layer, after which a peel has to stop.",
         .answer = "One layer.",
         .build = one_layer,
         .counts = {1024, 1, 1, 0}},
        {.name = "layers-64",
         .hard = "64 layers come out of order.",
         .answer = "64 layers.",
         .width = 16,
         .height = 16,
         .build = layers_64,
         .counts = {16384, 64, 64, 0},
         .bound = 16,
         .is_moved = true},
        {.name = "layers-129",
         .hard = "129 layers: one more than a counter of seven bits holds.",
         .answer = "129 layers.",
         .width = 8,
         .height = 8,
         .build = layers_129,
         .counts = {8256, 129, 129, 0},
         .bound = 32},
        {.name = "layers-256",
         .hard = "256 layers: one more than a stencil counter holds.",
         .answer = "256 layers.",
         .width = 8,
         .height = 8,
         .build = layers_256,
         .counts = {16384, 256, 256, 0},
         .bound = 32},
        {.name = "layers-500",
         .hard = "500 layers of alpha 1/64 are blended into 8 bits.",
         .answer = "500 layers.",
         .width = 8,
         .height = 8,
         .build = layers_500,
         .counts = {32000, 500, 500, 0},
         .bound = 128},
        {.name = "layer-ladder",
         .hard = "Eight pixels have 1, 2, 3, 5, 10, 100, 1000 and 4000 layers, those of the rows below 1 to 14.",
         .answer = "As many layers as said.",
         .width = 8,
         .height = 8,
         .build = ladder,
         .counts = {5541, 4000, 4000, 0},
         .bound = 64},
        {.name = "counts-past-2048",
         .hard = "Two pixels have 2047 and 2049 layers; a half counts no further than 2048.",
         .answer = "As many layers as said.",
         .width = 2,
         .height = 1,
         .build = counts_past_2048,
         .counts = {4096, 2049, 2049, 0},
         .bound = 64},
        {.name = "sums-past-65504",
         .hard = "Colours of 16,000 add up to more than a half can hold from the fifth pixel on.",
         .answer = "Pixel i has i + 1 layers of one colour.",
         .width = 8,
         .height = 1,
         .build = sums_past_65504,
         .counts = {36, 8, 8, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
