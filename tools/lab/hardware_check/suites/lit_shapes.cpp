// Suites Lighting_normals: Nz_<100 z>, NoNormal; Material_alpha: MatA_S<source>_A<alpha in hexadecimal>; and Specular:
// NonUnitNormal_<length>, ControlFlagsLightDisable. pipeline/reference/fog-and-lighting.md 6.3 to 6.5.
#include <bit>
#include <cmath>
#include <vector>

#include "tools/lab/hardware_check/drawing/lit.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::Three;

// An infinite light from behind the camera's back, without half vector.
LightingRegisters lit_from_front(const Three& diffuse) {
    LightingRegisters r;
    r.is_enabled = r.has_specular = r.separates_specular = r.has_local_eye = true;
    r.light[0].kind = pipeline::LightKind::infinite;
    r.light[0].direction = {0, 0, 1};
    r.light[0].diffuse = diffuse;
    return r;
}

// The normal of the last vertex before, which the second triangle keeps.
std::optional<Three> kept_normal(std::string_view name) {
    constexpr std::pair<std::string_view, Three> all[] = {{"NoNormal", {}},
                                                          {"Nz_100", {0, 0, 1}},
                                                          {"Nz_-100", {0, 0, -1}},
                                                          {"Nz_0", {1, 0, 0}},
                                                          {"Nz_70", {0.7071067811865475f, 0, 0.7071067811865475f}},
                                                          {"Nz_31", {0.9486832980505138f, 0, 0.31622776601683794f}},
                                                          {"Nz_97", {0.24253562503633297f, 0, 0.9701425001453319f}}};
    for (const auto& [word, normal] : all)
        if (name == word) return normal;
    return std::nullopt;
}

}  // namespace

// A triangle whose third vertex has the normal, then one without normals, by four commands that draw alike.
Drawing draw_lighting_normals(std::string_view name, const pipeline::DeviceProfile& profile) {
    for (const std::string_view command : {"-inlinebuf", "-inlinearrays", "-inlineelements"})
        if (take_last(name, command)) break;
    const auto normal = kept_normal(name);
    if (!normal) return unknown_name;
    const LightingRegisters r = lit_from_front({0, 1, 0.7f});
    constexpr float right = 2.75f, top = 1.75f;
    const LitCamera camera;
    pipeline::Surface surface = cleared_to(profile, 0xff303030);
    const std::vector<WorldVertex> before{{{-right, top, 3, 1}}, {{0, top, 3, 1}}, {{-right / 2, -top, 3, 1}, *normal}};
    const std::vector<WorldVertex> after{
        {{0, top, 1, 1}, *normal}, {{right, top, 1, 1}, *normal}, {{right / 2, -top, 1, 1}, *normal}};
    if (name != "NoNormal") draw_lit(surface, show_lit(Shown::primary), camera.lit(r, before));
    draw_lit(surface, show_lit(Shown::primary), camera.lit(r, after));
    return {SuitePicture{.image = surface.color()}, {}};
}

namespace {

struct ColoredCorner {
    float x, y;
    std::array<float, 4> diffuse, specular;
};

// Two triangles in window pixels about the middle: (upper left, lower right, upper right) and (upper left, lower left,
// lower right).
std::vector<WorldVertex> two_triangles(const std::array<ColoredCorner, 4>& c, float first_normal, float z) {
    std::vector<WorldVertex> vertices;
    for (const std::size_t k : {0, 2, 1, 0, 3, 2})
        vertices.push_back({{320 + c[k].x, 240 + c[k].y, z, 1},
                            {0, 0, vertices.size() < 3 ? first_normal : 1.0f},
                            c[k].diffuse,
                            c[k].specular});
    return vertices;
}

}  // namespace

// Two rectangles with the material's alpha. With that of the vertices' colours they are shaded.
Drawing draw_material_alpha(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (!take(name, "MatA_S")) return unknown_name;
    const std::string_view word = take_until(name, "_A");
    const auto alpha = to_hexadecimal(name);
    const bool is_known = word == "Mat" || word == "VDiffuse" || word == "VSpec";
    if (!is_known || !alpha || !(std::fabs(std::bit_cast<float>(*alpha)) <= 2)) return unknown_name;
    if (word != "Mat") return {std::nullopt, "where the corners of its shaded rectangles lie is not known"};
    LightingRegisters r = lit_from_front({0x1.dddddep-1f, 0x1.777778p-1f, 0x1.555556p-1f});
    r.scene_ambient = {0, std::bit_cast<float>(0x3c6ddacau), 0};
    r.material_alpha = std::bit_cast<float>(*alpha);
    // Corners clockwise from the upper left.
    const std::array<ColoredCorner, 4> left{{{-150, -156, {0.4f, 0.1f, 0.1f, 0.25f}, {0, 1, 0, 0.5f}},
                                             {10, -156, {0.5f, 0.5f, 0.5f, 1}, {0, 1, 1, 0.75f}},
                                             {10, 150, {0, 0, 1, 1}, {1, 1, 0, 0.5f}},
                                             {-150, 150, {0, 1, 0, 1}, {1, 0, 0, 0.1f}}}};
    const std::array<ColoredCorner, 4> right{{{-10, -156, {1, 1, 0, 1}, {1, 0, 0, 0.25f}},
                                              {150, -156, {0, 0.3f, 0.8f, 0.15f}, {0.9f, 0.9f, 0.4f, 0.33f}},
                                              {150, 150, {1, 0, 0, 0.75f}, {0.95f, 0.5f, 0.8f, 0.05f}},
                                              {-10, 150, {0.5f, 0.5f, 0.5f, 1}, {0.3f, 0.3f, 1, 1}}}};
    pipeline::Surface surface = cleared_to(profile, 0xff303030);
    draw_lit(surface, show_lit(Shown::primary), lit_in_window(r, two_triangles(left, -1, 10)));
    draw_lit(surface, show_lit(Shown::primary), lit_in_window(r, two_triangles(right, 1, 9.75f)));
    return {SuitePicture{.image = surface.color()}, {}};
}

namespace {

// A fan of 64 triangles around the window's middle, whose normals of some length lean outward.
SuitePicture fan_of_normals(const pipeline::DeviceProfile& profile, float length) {
    LightingRegisters r;
    r.is_enabled = r.has_specular = r.separates_specular = r.has_local_eye = r.has_specular_alpha = true;
    r.specular_params = power_125;
    r.light[0] = infinite_light({0, 0, 1});
    r.light[0].diffuse = r.light[0].specular = {1, 1, 1};
    const LitCamera camera;
    const WorldVertex middle{camera.point(320, 240, 0), {0, 0, -length}};
    const auto rim = [&](int k) {
        constexpr float step = 2.0f * 3.14159265f / 64.0f;
        const float angle = static_cast<float>(k % 64) * step;
        const HostVector p = camera.point(320 + 128 * std::cos(angle), 240 + 128 * std::sin(angle), 0);
        const float inverse = 1.0f / std::sqrt((p[0] * p[0] + p[1] * p[1]) + 9.0f);
        return WorldVertex{p, {-p[0] * inverse * length, -p[1] * inverse * length, -3.0f * inverse * length}};
    };
    std::vector<WorldVertex> vertices;
    for (int k = 0; k < 64; ++k) vertices.insert(vertices.end(), {middle, rim(k), rim(k + 1)});
    pipeline::Surface surface = cleared_to(profile, 0xfe323232);
    draw_checkerboard(surface, 14, 0xff202020, 0xff909090);
    draw_lit(surface, show_lit(Shown::secondary, ShownAlpha::one), camera.lit(r, vertices));
    return {.image = surface.color()};
}

}  // namespace

Drawing draw_specular(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (take(name, "NonUnitNormal_")) {
        const auto length = to_number(name);
        if (!length || !(*length > 0.9f && *length < 1.1f)) return unknown_name;
        return {fan_of_normals(profile, *length), {}};
    }
    if (name.starts_with("SpecParams_")) return {std::nullopt, "the test program's meshes are not in this repository"};
    if (name.starts_with("ControlFlags"))
        return {std::nullopt, "the program that approximates lighting is not described"};
    return unknown_name;
}

}  // namespace strata::hardware_check
