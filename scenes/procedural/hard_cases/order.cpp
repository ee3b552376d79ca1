// scenes/procedural/hard_cases/order.cpp - surfaces that cannot be ordered by sorting triangles or objects.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// Four bars along the sides of the frame; each is deep at one end and near at the other.
void cyclic_overlap(CaseScene& scene) {
    add_quad(scene, {0, 0, 32, 8}, {0.75, -1.0 / 64, 0}, color_of(1));
    add_quad(scene, {24, 0, 32, 32}, {0.75, 0, -1.0 / 64}, color_of(2));
    add_quad(scene, {0, 24, 32, 32}, {0.25, 1.0 / 64, 0}, color_of(3));
    add_quad(scene, {0, 0, 8, 32}, {0.25, 0, 1.0 / 64}, color_of(4));
}

// Two combs of 16 strips each that pass through each other.
void woven(CaseScene& scene) {
    for (int i = 0; i < 8; ++i) {
        const double at = i * 4.0;
        add_quad(scene, {0, at, 32, at + 4}, {i % 2 == 0 ? 0.25 : 0.5, 1.0 / 128, 0}, color_of(i));
        add_quad(scene, {at, 0, at + 4, 32}, {i % 2 == 0 ? 0.5 : 0.25, 0, 1.0 / 128}, color_of(i + 8));
    }
}

void inside_out(CaseScene& scene) {
    // Nested boxes drawn from the innermost pair of faces outwards.
    for (int i = 0; i < 8; ++i) {
        add_quad(scene, {8.0 - i, 8.0 - i, 24.0 + i, 24.0 + i}, {0.5 - (i + 1) / 32.0, 0, 0}, color_of(i));
        add_quad(scene, {8.0 - i, 8.0 - i, 24.0 + i, 24.0 + i}, {0.5 + (i + 1) / 32.0, 0, 0}, color_of(i + 8));
    }
}

}  // namespace

std::span<const HardCase> order_cases() {
    static const HardCase cases[]{
        // Four bars of 8 x 32 pixels; they meet in four corners of 8 x 8.
        {.name = "cyclic-overlap",
         .hard = "Four bars overlap in a ring, each one above the next.",
         .answer = "Each corner shows two layers, and no order of the bars is right in all four.",
         .build = cyclic_overlap,
         .counts = {1024, 2, 2, 0},
         .is_moved = true},
        // Tie: row depth a + (x + 1/2) / 128 against column depth b + (y + 1/2) / 128 with a, b in {1/4, 1/2} by the
        // parity of their strips. Where a = b, x = y ties: in the strips' squares (i, i) a and b always differ. Where
        // a - b = +-1/4, x - y = -+32, which no pixel has.
        {.name = "woven",
         .hard = "Strips along rows and strips along columns pass over and under each other.",
         .answer = "Every pixel has two layers, and the upper one changes from square to square.",
         .build = woven,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        // Two faces of (16 + 2 i)^2 pixels each for i = 0 to 7: 2 * 4400.
        {.name = "inside-out",
         .hard = "Eight boxes around each other are drawn from the innermost to the outermost.",
         .answer = "The middle has 16 layers, front faces from the outside in and back faces from the inside out.",
         .build = inside_out,
         .counts = {8800, 16, 16, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
