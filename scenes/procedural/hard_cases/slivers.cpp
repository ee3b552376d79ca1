// scenes/procedural/hard_cases/slivers.cpp - triangles thinner or smaller than a pixel, and edges through pixel
// centres.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

constexpr Tilt half_way{0.5, 0, 0};

void sliver_1_256(CaseScene& scene) {
    add_quad(scene, {16.5, 0, 16.5 + 1.0 / 256, 32}, half_way, color_of(1));
    add_quad(scene, {20.5 + 1.0 / 256, 0, 20.5 + 2.0 / 256, 32}, half_way, color_of(2));
}

void sliver_1_16(CaseScene& scene) {
    add_quad(scene, {16.5, 0, 16.5 + 1.0 / 16, 32}, half_way, color_of(1));
    add_quad(scene, {20.5 + 1.0 / 16, 0, 20.5 + 2.0 / 16, 32}, half_way, color_of(2));
}

void needle_16000(CaseScene& scene) {
    add(scene, {CaseCorner{-8000, 4.5, 0.5}, {8000, 4.5 + 1.0 / 256, 0.5}, {8000, 4.5, 0.5}}, color_of(1));
}

// A square of half side 1/4 round (x, y), as 32 triangles that meet in its middle.
void add_fan(CaseScene& scene, double x, double y, int number) {
    const auto rim = [&](int k) -> CaseCorner {
        const int side = k / 8 % 4;
        const double along = (k % 8) / 16.0 - 0.25;
        const double dx = side == 0 ? along : side == 1 ? 0.25 : side == 2 ? -along : -0.25;
        const double dy = side == 0 ? -0.25 : side == 1 ? along : side == 2 ? 0.25 : -along;
        return {x + dx, y + dy, 0.5};
    };
    for (int k = 0; k < 32; ++k) add(scene, {CaseCorner{x, y, 0.5}, rim(k), rim(k + 1)}, color_of(number + k));
}

// The middle of each fan is at its pixel's centre or up to 1/8 pixel away.
void subpixel_fans(CaseScene& scene) {
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            add_fan(scene, 4 * i + 0.5 + (i % 4 - 2) / 16.0, 4 * j + 0.5 + (j % 4 - 2) / 16.0, i + j);
}

// The middle vertex of two triangles is on the long side of the third, which runs through centres.
void t_junction(CaseScene& scene) {
    const CaseCorner top_left{0, 0}, top_right{32, 0}, bottom_left{0, 32}, bottom_right{32, 32}, middle{16, 16};
    add(scene, {top_left, bottom_left, bottom_right}, color_of(1));
    add(scene, {top_left, middle, top_right}, color_of(2));
    add(scene, {top_right, middle, bottom_right}, color_of(3));
}

void rotated_quad(CaseScene& scene) {
    const CaseCorner top{16.5, 2.5}, right{30.5, 16.5}, bottom{16.5, 30.5}, left{2.5, 16.5};
    add(scene, {top, left, bottom}, color_of(1));
    add(scene, {top, bottom, right}, color_of(2));
}

void corners_on_centres(CaseScene& scene) {
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            add_quad(scene, {4 * i + 0.5, 4 * j + 0.5, 4 * i + 4.5, 4 * j + 4.5}, half_way, color_of(i + j),
                     (i + j) % 2 == 0 ? Diagonal::falling : Diagonal::rising);
}

void zero_area(CaseScene& scene) {
    add(scene, {CaseCorner{0, 0}, {16, 16}, {32, 32}}, color_of(1));
    add(scene, {CaseCorner{8.5, 8.5}, {8.5, 8.5}, {8.5, 8.5}}, color_of(2));
    add(scene, {CaseCorner{8.5, 8.5}, {24.5, 8.5}, {8.5, 8.5}}, color_of(3));
    add_quad(scene, {8, 8, 24, 24}, half_way, color_of(4));
    add(scene, {CaseCorner{0, 20.5}, {32, 20.5}, {16, 20.5}}, color_of(5));
}

// 32 wedges round the middle of the frame, from the centre of pixel (16, 16) to beyond the border.
void pinwheel(CaseScene& scene) {
    const auto rim = [](int k) -> CaseCorner {
        const int side = k / 8 % 4;
        const double along = (k % 8) * 16.0 - 64;
        return {16.5 + (side == 0   ? along
                        : side == 1 ? 64
                        : side == 2 ? -along
                                    : -64),
                16.5 + (side == 0   ? -64
                        : side == 1 ? along
                        : side == 2 ? 64
                                    : -along),
                0.5};
    };
    for (int k = 0; k < 32; ++k) add(scene, {CaseCorner{16.5, 16.5, 0.5}, rim(k), rim(k + 1)}, color_of(k));
}

// 64 sheets of 128 x 64 cells, each cell 1/256 pixel wide and high, round the centre of the only pixel.
void million(CaseScene& scene) {
    constexpr int columns = 128, rows = 64, sheets = 64;
    pipeline::Mesh& mesh = scene.transparent;
    for (int s = 0; s < sheets; ++s) {
        const double depth = (s * 29 % sheets + 0.5) / sheets;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int y = 0; y <= rows; ++y)
            for (int x = 0; x <= columns; ++x) {
                mesh.positions.push_back(position(scene, {(x + 64) / 256.0, (y + 96) / 256.0, depth}));
                mesh.colors.push_back(color_of(s, 0.0625f));
            }
        for (std::uint32_t y = 0; y < rows; ++y)
            for (std::uint32_t x = 0; x < columns; ++x) {
                const std::uint32_t a = first + y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
                mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
            }
    }
}

}  // namespace

std::span<const HardCase> sliver_cases() {
    static const HardCase cases[]{
        // The left edge is on the centres and owns them; the second strip begins to the right of them.
        {.name = "sliver-1-256",
         .hard = "Two strips 1/256 of a pixel wide lie on and next to the centres of a column.",
         .answer = "The first strip covers the 32 pixels of column 16, the second one nothing.",
         .build = sliver_1_256,
         .counts = {32, 1, 1, 0}},
        {.name = "sliver-1-16",
         .hard = "Two strips 1/16 of a pixel wide lie on and next to the centres of a column.",
         .answer = "The first strip covers the 32 pixels of column 16, the second one nothing.",
         .build = sliver_1_16,
         .counts = {32, 1, 1, 0},
         .is_moved = true},
        // The upper edge is horizontal, on the centres of row 4, and owns them.
        {.name = "needle-16000",
         .hard = "A needle is 16,000 pixels long and 1/256 of a pixel wide at its thick end.",
         .answer = "It covers the 64 pixels of row 4.",
         .width = 64,
         .height = 8,
         .build = needle_16000,
         .counts = {64, 1, 1, 0}},
        // A fan is a partition of its square, which contains exactly one centre.
        {.name = "subpixel-fans",
         .hard = "64 fans of 32 triangles are each half a pixel wide, with sides and corners on pixel centres.",
         .answer = "Each fan covers one pixel exactly once.",
         .build = subpixel_fans,
         .counts = {64, 1, 1, 0}},
        {.name = "t-junction",
         .hard = "Two triangles end in the middle of a third one's side, which runs through pixel centres.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = t_junction,
         .counts = {1024, 1, 1, 0},
         .is_moved = true},
        // A square tiles the plane, so by the fill rule it owns as many centres as its area: 14 * 14 * 2.
        {.name = "rotated-quad",
         .hard = "A square stands on its corner; its corners, sides and diagonal run through pixel centres.",
         .answer = "It covers 392 pixels, each exactly once.",
         .build = rotated_quad,
         .counts = {392, 1, 1, 0},
         .is_moved = true},
        {.name = "corners-on-centres",
         .hard = "A grid of squares has all its corners on pixel centres, and its diagonals run through others.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = corners_on_centres,
         .counts = {1024, 1, 1, 0},
         .is_moved = true},
        {.name = "zero-area",
         .hard = "Triangles without area run through pixel centres, before and behind a square.",
         .answer = "The square covers 256 pixels once; the others cover nothing.",
         .build = zero_area,
         .counts = {256, 1, 1, 0}},
        {.name = "pinwheel",
         .hard = "32 wedges meet at the centre of a pixel, and many of their sides run through others.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = pinwheel,
         .counts = {1024, 1, 1, 0}},
        {.name = "million-in-a-pixel",
         .hard = "1,048,576 triangles of 1/256 pixel lie around the centre of the only pixel, at 64 depths.",
         .answer = "At each of the 64 depths exactly one triangle covers the pixel.",
         .width = 1,
         .height = 1,
         .build = million,
         .counts = {64, 64, 64, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
