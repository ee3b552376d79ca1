// scenes/procedural/hard_cases/planes.cpp - planes that nearly coincide, coincide, or cross at pixel centres.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// A plane whose corners are whole multiples of 2^-24 while its pixel centres are not: they are multiples of 2^-30, so
// every depth format rounds, and two parallel planes round differently from pixel to pixel.
constexpr Tilt tilted{0.5 + 0x1p-10, 2731 * 0x1p-29, 1639 * 0x1p-29};

Tilt behind(const Tilt& plane, double distance) noexcept { return {plane.start + distance, plane.right, plane.down}; }

// The farther plane first.
void two_planes(CaseScene& scene, double gap) {
    add_quad(scene, whole(scene), behind(tilted, gap), color_of(1));
    add_quad(scene, whole(scene), tilted, color_of(2), Diagonal::rising);
}

void one_unit(CaseScene& scene) { two_planes(scene, 0x1p-24); }
void two_units(CaseScene& scene) { two_planes(scene, 0x1p-23); }
void four_units(CaseScene& scene) { two_planes(scene, 0x1p-22); }
void one_unit_of_16_bits(CaseScene& scene) { two_planes(scene, 0x1p-16); }

void eight_planes_one_unit(CaseScene& scene) {
    for (int i = 0; i < 8; ++i) add_quad(scene, whole(scene), behind(tilted, (i * 5 % 8) * 0x1p-24), color_of(i));
}

void coincident(CaseScene& scene) {
    for (int i = 0; i < 3; ++i) add_quad(scene, whole(scene), tilted, color_of(i));
}

void coincident_other_diagonal(CaseScene& scene) {
    add_quad(scene, whole(scene), tilted, color_of(1), Diagonal::falling);
    add_quad(scene, whole(scene), tilted, color_of(2), Diagonal::rising);
}

// The triangles of the copy begin at another corner and have the opposite winding.
void duplicated_mesh(CaseScene& scene) {
    add_quad(scene, whole(scene), tilted, color_of(1));
    pipeline::Mesh& mesh = scene.transparent;
    const std::vector<std::uint32_t> first = mesh.indices;
    for (std::size_t i = 0; i < first.size(); i += 3)
        mesh.indices.insert(mesh.indices.end(), {first[i + 2], first[i + 1], first[i]});
}

void crossing_along_a_row(CaseScene& scene) {
    add_quad(scene, whole(scene), {0.5, 0, 0}, color_of(1));
    add_quad(scene, whole(scene), {0.5 - 16.5 / 64, 0, 1.0 / 64}, color_of(2));
}

void crossing_between_rows(CaseScene& scene) {
    add_quad(scene, whole(scene), {0.5, 0, 0}, color_of(1));
    add_quad(scene, whole(scene), {0.5 - 16.0 / 64, 0, 1.0 / 64}, color_of(2));
}

void three_through_a_point(CaseScene& scene) {
    add_quad(scene, whole(scene), {0.5, 0, 0}, color_of(1));
    add_quad(scene, whole(scene), {0.5 - 16.5 / 64, 1.0 / 64, 0}, color_of(2));
    add_quad(scene, whole(scene), {0.5 - 16.5 / 128, 0, 1.0 / 128}, color_of(3));
}

void eight_through_a_line(CaseScene& scene) {
    for (int k = 0; k < 8; ++k) {
        const double slope = (k - 4) / 256.0;
        add_quad(scene, whole(scene), {0.5 - 16.5 * slope, slope, 0}, color_of(k));
    }
}

void nearly_edge_on(CaseScene& scene) {
    // From near to far within one column of pixels: a depth of 2^-1 over 1/16 pixel around the centres of column 16.
    for (int i = 0; i < 4; ++i)
        add_quad(scene, {16.46875, i * 8.0, 16.53125, i * 8.0 + 8}, {0.5 - 8 * 16.5, 8, 0}, color_of(i));
}

}  // namespace

std::span<const HardCase> plane_cases() {
    // Two full planes have 2 * 32 * 32 fragments; gaps are constant, so no two of them ever have the same exact depth.
    static const HardCase cases[]{
        {.name = "planes-1-unit",
         .hard = "Two parallel tilted planes are 2^-24 apart, about one code of a 24-bit buffer.",
         .answer = "Both planes are layers at every pixel, the second one drawn in front.",
         .build = one_unit,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        {.name = "planes-2-units",
         .hard = "Two parallel tilted planes are 2^-23 apart, about two codes of a 24-bit buffer.",
         .answer = "Both planes are layers at every pixel, the second one drawn in front.",
         .build = two_units,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        {.name = "planes-4-units",
         .hard = "Two parallel tilted planes are 2^-22 apart, about four codes of a 24-bit buffer.",
         .answer = "Both planes are layers at every pixel, the second one drawn in front.",
         .build = four_units,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        {.name = "planes-1-unit-of-16-bits",
         .hard = "Two parallel tilted planes are 2^-16 apart, about one code of a 16-bit buffer.",
         .answer = "Both planes are layers at every pixel, the second one drawn in front.",
         .build = one_unit_of_16_bits,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        {.name = "planes-8-close",
         .hard = "Eight parallel tilted planes are 2^-24 apart and drawn out of order.",
         .answer = "All eight are layers at every pixel, in the order of their distances.",
         .build = eight_planes_one_unit,
         .counts = {8192, 8, 8, 0},
         .is_moved = true},
        {.name = "coincident",
         .hard = "Three copies of the same two triangles have three colours.",
         .answer = "Every pixel has three fragments of exactly one depth.",
         .build = coincident,
         .counts = {3072, 3, 1, 1024}},
        {.name = "coincident-other-diagonal",
         .hard = "A tilted square is drawn twice, cut along one diagonal and then along the other.",
         .answer = "Every pixel has two fragments of exactly one depth.",
         .build = coincident_other_diagonal,
         .counts = {2048, 2, 1, 1024},
         .is_moved = true},
        {.name = "duplicated-mesh",
         .hard = "A mesh is followed by a copy of itself whose triangles start elsewhere and turn the other way.",
         .answer = "Every pixel has two fragments of exactly one depth.",
         .build = duplicated_mesh,
         .counts = {2048, 2, 1, 1024}},
        {.name = "crossing-along-a-row",
         .hard = "Two planes cross along the centres of a row of pixels.",
         .answer = "The 32 pixels of row 16 have a tie; the tilted plane is in front above them and behind below.",
         .build = crossing_along_a_row,
         .counts = {2048, 2, 2, 32},
         .is_moved = true},
        {.name = "crossing-between-rows",
         .hard = "Two planes cross along the border of two rows of pixels, half a pixel from every centre.",
         .answer = "No pixel has a tie; the tilted plane is in front in the upper half and behind in the lower.",
         .build = crossing_between_rows,
         .counts = {2048, 2, 2, 0},
         .is_moved = true},
        // 32 ties along column 16, 32 along row 16, 16 on the line 2 (x - 16) = y - 16; all three lines share a pixel.
        {.name = "three-through-a-point",
         .hard = "Three planes meet at the centre of pixel (16, 16), two by two along lines of centres.",
         .answer = "78 pixels have a tie, and one of them a tie of all three.",
         .build = three_through_a_point,
         .counts = {3072, 3, 3, 78},
         .is_moved = true},
        {.name = "eight-through-a-line",
         .hard = "Eight planes cross along the centres of one column of pixels.",
         .answer = "The 32 pixels of column 16 have one depth; left of it the order is reversed to that on its right.",
         .build = eight_through_a_line,
         .counts = {8192, 8, 8, 32},
         .is_moved = true},
        {.name = "nearly-edge-on",
         .hard = "Strips 1/16 of a pixel wide run through half of the depth range over the centres of a column.",
         .answer = "Each of the 32 pixels of the column has one fragment, whose depth is exactly 1/2.",
         .build = nearly_edge_on,
         .counts = {32, 1, 1, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
