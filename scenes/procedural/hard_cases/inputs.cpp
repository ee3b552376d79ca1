// scenes/procedural/hard_cases/inputs.cpp - numbers that no scene should contain: infinite, NaN, or far out of range.
#include <limits>

#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

void sound_quad(CaseScene& scene) { add_quad(scene, whole(scene), {0.5, 0, 0}, color_of(1)); }

// One corner of a triangle in front of the valid square has this coordinate.
void bad_corner(CaseScene& scene, float value) {
    sound_quad(scene);
    add(scene.transparent, {pipeline::Vec3{-1, -1, -0.5f}, {1, -1, -0.5f}, {0, value, -0.5f}}, color_of(2));
    add(scene.transparent, {pipeline::Vec3{-1, -1, -0.5f}, {value, -1, -0.5f}, {0, 1, -0.5f}}, color_of(3));
    add(scene.transparent, {pipeline::Vec3{-1, -1, value}, {1, -1, -0.5f}, {0, 1, -0.5f}}, color_of(4));
}

void nan_vertices(CaseScene& scene) { bad_corner(scene, not_a_number); }
void infinite_vertices(CaseScene& scene) {
    bad_corner(scene, infinity);
    bad_corner(scene, -infinity);
}

void nan_color(CaseScene& scene) {
    sound_quad(scene);
    add_quad(scene, whole(scene), {0.25, 0, 0}, {not_a_number, 0.5f, 0.5f, 0.5f});
    add_quad(scene, whole(scene), {0.125, 0, 0}, {0.5f, 0.5f, 0.5f, infinity});
}

// Four squares meet at the origin of clip space, each with different signs of zero.
void minus_zero(CaseScene& scene) {
    const auto quad = [&](float x, float y, float zero_x, float zero_y) {
        const pipeline::Vec3 corner{x, y, -0.0f}, side{zero_x, y, 0.0f}, other{x, zero_y, -0.0f},
            origin{zero_x, zero_y, 0.0f};
        add(scene.transparent, {corner, side, origin}, color_of(1));
        add(scene.transparent, {corner, origin, other}, color_of(2));
    };
    quad(-1, 1, 0.0f, -0.0f);
    quad(1, 1, -0.0f, 0.0f);
    quad(-1, -1, -0.0f, -0.0f);
    quad(1, -1, 0.0f, 0.0f);
}

void checkered(CaseScene& scene) {
    scene.textures = {{.name = "checkered",
                       .width = 2,
                       .height = 2,
                       .texels = {255, 255, 255, 255, 0, 64, 128, 255, 128, 64, 0, 255, 255, 255, 255, 128}}};
}

// Texture coordinates by corner; a quad has six.
void add_textured_quad(CaseScene& scene, double depth, const std::array<pipeline::Vec2, 6>& coordinates) {
    add_quad(scene, whole(scene), {depth, 0, 0}, color_of(1));
    scene.transparent.texcoords.insert(scene.transparent.texcoords.end(), coordinates.begin(), coordinates.end());
}

void huge_texture_coordinates(CaseScene& scene) {
    checkered(scene);
    constexpr float huge = 1e30f;
    add_textured_quad(scene, 0.5,
                      {{{-huge, -huge}, {-huge, huge}, {huge, huge}, {-huge, -huge}, {huge, huge}, {huge, -huge}}});
    add_textured_quad(scene, 0.25, {{{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}});
    add_textured_quad(scene, 0.125, {{{0x1p24f, 0}, {0x1p24f, 1}, {0x1p24f, 1}, {0, 0}, {1, 1}, {-0x1p31f, 0}}});
}

void non_finite_texture_coordinates(CaseScene& scene) {
    checkered(scene);
    add_textured_quad(scene, 0.5, {{{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}});
    add_textured_quad(scene, 0.25, {{{0, not_a_number}, {0, 1}, {1, 1}, {0, 0}, {1, infinity}, {1, 0}}});
}

void nothing(CaseScene&) {}

}  // namespace

std::span<const HardCase> input_cases() {
    static const HardCase cases[]{
        {.name = "nan-vertices",
         .hard = "Three triangles have a corner that is not a number, each in another coordinate.",
         .answer = "They are dropped and counted; the square behind them is whole.",
         .build = nan_vertices,
         .counts = {1024, 1, 1, 0},
         .is_non_finite = true},
        {.name = "infinite-vertices",
         .hard = "Six triangles have a corner at infinity, and a square is drawn twice.",
         .answer = "They are dropped and counted; both squares are whole, at one depth.",
         .build = infinite_vertices,
         .counts = {2048, 2, 1, 1024},
         .is_non_finite = true},
        {.name = "nan-colour",
         .hard = "Two squares have colours that are not finite.",
         .answer = "They are dropped and counted; the square behind them is whole.",
         .build = nan_color,
         .counts = {1024, 1, 1, 0},
         .is_non_finite = true},
        {.name = "minus-zero",
         .hard = "Corners at the origin have zeros of either sign, in position and depth.",
         .answer = "Every pixel of the frame is covered exactly once.",
         .build = minus_zero,
         .counts = {1024, 1, 1, 0}},
        {.name = "texture-coordinates-huge",
         .hard = "Texture coordinates run from -10^30 to 10^30 over the frame, and from 2^24 to -2^31.",
         .answer = "Three layers, whatever texel they show.",
         .build = huge_texture_coordinates,
         .counts = {3072, 3, 3, 0}},
        {.name = "texture-coordinates-non-finite",
         .hard = "Two triangles have texture coordinates that are not finite.",
         .answer = "They are dropped and counted; the square behind them is whole.",
         .build = non_finite_texture_coordinates,
         .counts = {1024, 1, 1, 0},
         .is_non_finite = true},
        {.name = "nothing",
         .hard = "There is no triangle.",
         .answer = "No fragment.",
         .build = nothing,
         .counts = {0, 0, 0, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
