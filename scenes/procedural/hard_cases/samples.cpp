// scenes/procedural/hard_cases/samples.cpp - what a port with several samples per pixel gets wrong where programs run
// once a pixel: the depth at the pixel's centre is not that of a sample (tools/lab/multisampling/MULTISAMPLING.md). The
// answers are those of one sample, at the centre.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// Depth changes by 1/64 across a pixel, four times the distance of the planes.
void steep_layers(CaseScene& scene) {
    for (int i = 0; i < 3; ++i) add_quad(scene, whole(scene), {0.25 + ((i + 1) % 3) / 256.0, 1.0 / 64, 0}, color_of(i));
}

// Strips over the samples at 10 and 14 sixteenths of a pixel and not over its centre, in front of a plane.
void beside_centres(CaseScene& scene) {
    add_quad(scene, whole(scene), {0.75, 0, 0}, color_of(0));
    for (int i = 0; i < 4; ++i) {
        const double left = 4 + 8 * i;
        add_quad(scene, {left + 9.0 / 16, 0, left + 15.0 / 16, 32}, {0.25, 1.0 / 256, 0}, color_of(i + 1));
    }
}

// The planes meet a quarter of a pixel from the left side of column 16.
void crossing_within_pixels(CaseScene& scene) {
    add_quad(scene, whole(scene), {0.5, 0, 0}, color_of(1));
    add_quad(scene, whole(scene), {0.5 - 16.25 / 64, 1.0 / 64, 0}, color_of(2));
}

}  // namespace

std::span<const HardCase> sample_cases() {
    static const HardCase cases[]{
        {.name = "samples-steep",
         .hard = "Across a pixel the depth changes four times as much as from layer to layer.",
         .answer = "Three layers a pixel.",
         .build = steep_layers,
         .counts = {3072, 3, 3, 0}},
        {.name = "samples-beside-centre",
         .hard = "Strips cover samples of a pixel and not its centre, which lies outside of their triangles.",
         .answer = "At the centres one layer a pixel, the plane; at the samples of four columns two.",
         .build = beside_centres,
         .counts = {1024, 1, 1, 0}},
        {.name = "samples-crossing",
         .hard = "Two planes cross within a column of pixels: samples on both sides have them in other orders.",
         .answer = "Two layers a pixel, without a tie.",
         .build = crossing_within_pixels,
         .counts = {2048, 2, 2, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
