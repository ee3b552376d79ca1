// Suites Material_color: <colours of scene, material and light>, and Material_color_source: From<source>, Emissive:
// flat shapes under an infinite light. pipeline/reference/fog-and-lighting.md 6.1 and 6.2.
#include <vector>

#include "tools/lab/hardware_check/drawing/lit.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::MaterialSource;
using pipeline::Three;

// The registers that all of these suites set.
LightingRegisters usual_lighting() {
    LightingRegisters r;
    r.is_enabled = r.has_specular = r.separates_specular = true;
    r.specular_params = power_125;
    return r;
}

// A colour by its letter: full or half red, green or blue, or a grey.
std::optional<Three> color_of(char letter) {
    switch (letter) {
        case 'R': return Three{1, 0, 0};
        case 'r': return Three{0.5f, 0, 0};
        case 'G': return Three{0, 1, 0};
        case 'g': return Three{0, 0.5f, 0};
        case 'B': return Three{0, 0, 1};
        case 'b': return Three{0, 0, 0.5f};
        case '0': return Three{};
        case '1': return Three{1, 1, 1};
        case '2': return Three{0.25f, 0.25f, 0.25f};
        case '3': return Three{0.33f, 0.33f, 0.33f};
        case '5': return Three{0.5f, 0.5f, 0.5f};
        case '6': return Three{0.66f, 0.66f, 0.66f};
        case '7': return Three{0.75f, 0.75f, 0.75f};
        default: return std::nullopt;
    }
}
Three product_of(const Three& a, const Three& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
Three sum_of(const Three& a, const Three& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

// Scene, material and light ambient, then diffuse, specular and emission of the material, then diffuse and specular of
// the light. The upper triangle's normals point away from the camera.
Drawing draw_material_color(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name.size() != 10 || name[3] != '_' || name[7] != '_') return unknown_name;
    std::array<Three, 8> c;
    for (std::size_t k = 0, at = 0; at < name.size(); ++at) {
        if (name[at] == '_') continue;
        const auto color = color_of(name[at]);
        if (!color) return unknown_name;
        c[k++] = *color;
    }
    LightingRegisters r = usual_lighting();
    r.has_local_eye = true;
    r.scene_ambient = sum_of(product_of(c[0], c[1]), c[5]);
    r.light[0].kind = pipeline::LightKind::infinite;
    r.light[0].direction = {0, 0, 1};
    r.light[0].ambient = product_of(c[0], c[2]);
    r.light[0].diffuse = product_of(c[3], c[6]);
    r.light[0].specular = product_of(c[4], c[7]);
    constexpr float right = 2.75f, top = 1.75f;
    constexpr Three toward{0, 0, 1}, away{0, 0, -1};
    const auto vertex = [](float x, float y, const Three& normal) { return WorldVertex{{x, y, 0, 1}, normal}; };
    const std::vector<WorldVertex> vertices{vertex(-right, top, away),    vertex(right, -top, away),
                                            vertex(right, top, away),     vertex(-right, top, toward),
                                            vertex(-right, -top, toward), vertex(right, -top, toward)};
    pipeline::Surface surface = cleared_to(profile, 0xff303030);
    draw_lit(surface, show_lit(Shown::primary), LitCamera{}.lit(r, vertices));
    return {SuitePicture{.image = surface.color()}, {}};
}

namespace {

constexpr std::array<float, 4> vertex_diffuse{0.1f, 0.4f, 0.1f, 0.25f}, vertex_specular{0.4f, 0.1f, 0.1f, 0.25f};

// A rectangle at z = 0, in pixels.
std::vector<WorldVertex> flat(const LitCamera& camera, const Box& b, const std::array<float, 4>& diffuse) {
    const auto vertex = [&](float x, float y) {
        return WorldVertex{camera.point(x, y, 0), {0, 0, -1}, diffuse, vertex_specular};
    };
    const WorldVertex ul = vertex(b.left, b.top), ur = vertex(b.right, b.top), lr = vertex(b.right, b.bottom),
                      ll = vertex(b.left, b.bottom);
    return {ul, ur, lr, ul, lr, ll};
}

struct ColorSources {
    MaterialSource emission{}, ambient{}, diffuse{}, specular{};
};

// A square of 128 x 96: rows primary, secondary and both, columns with the material's alpha and with 1.
void draw_square(pipeline::Surface& surface, const LitCamera& camera, const LightingRegisters& lighting,
                 const ColorSources& sources, float left, float top) {
    LightingRegisters r = lighting;
    r.emission = sources.emission;
    r.ambient = sources.ambient;
    r.diffuse = sources.diffuse;
    r.specular = sources.specular;
    for (const Shown shown : {Shown::primary, Shown::secondary, Shown::both}) {
        for (const ShownAlpha alpha : {ShownAlpha::own, ShownAlpha::one}) {
            const float x = alpha == ShownAlpha::own ? left : left + 64;
            draw_lit(surface, show_lit(shown, alpha),
                     camera.lit(r, flat(camera, {x, top, x + 64, top + 32}, vertex_diffuse)));
        }
        top += 32;
    }
}

constexpr Three scene_ambient{0.2f, 0.2f, 0.2f}, material_emissive{0, 0, 0.4f}, material_ambient{0.1f, 0.1f, 0.1f},
    material_diffuse{0, 0.4f, 0}, material_specular{0.4f, 0, 0};

// The legend at the left, without lighting.
void draw_legend(pipeline::Surface& surface, const LitCamera& camera, LightingRegisters r) {
    r.is_enabled = false;
    float top = 120;
    for (const Three& c : {Three{0.1f, 0.4f, 0.1f}, Three{0.4f, 0.1f, 0.1f}, scene_ambient, material_diffuse,
                           material_specular, material_emissive, material_ambient}) {
        draw_lit(surface, show_lit(Shown::primary),
                 camera.lit(r, flat(camera, {16, top, 110, top + 25}, {c[0], c[1], c[2], 1})));
        top += 25;
    }
}

// The emission register after "_me".
std::optional<float> emission_of(std::string_view word) {
    constexpr std::pair<std::string_view, float> all[] = {{"0", 0}, {"0_15", 0.15f}, {"0_5", 0.5f}, {"1_0", 1}};
    for (const auto& [text, value] : all)
        if (word == text) return value;
    return std::nullopt;
}

// Which colours of each square come from the vertex: diffuse, specular, emission, ambient.
constexpr bool from_vertex[9][4] = {
    {true, false, false, false}, {true, true, false, false}, {false, true, false, false},
    {true, false, true, false},  {true, true, true, true},   {false, true, false, true},
    {false, false, true, false}, {false, false, true, true}, {false, false, false, true}};

constexpr auto constant = MaterialSource::constant, by_diffuse = MaterialSource::vertex_diffuse,
               by_specular = MaterialSource::vertex_specular;
// Emission and ambient of each square.
constexpr MaterialSource emissive[9][2] = {
    {by_diffuse, by_diffuse},   {by_specular, by_diffuse}, {by_diffuse, by_specular},
    {by_specular, by_specular}, {constant, by_specular},   {by_specular, constant},
    {constant, by_diffuse},     {by_diffuse, constant},    {constant, constant}};

}  // namespace

Drawing draw_material_color_source(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_emissive = take(name, "Emissive");
    std::optional<MaterialSource> source;
    if (is_emissive)
        source = constant;
    else if (take(name, "FromMaterial"))
        source = constant;
    else if (take(name, "FromVertexDiffuse"))
        source = by_diffuse;
    else if (take(name, "FromVertexSpecular"))
        source = by_specular;
    const bool has_two_lights = !is_emissive && take_last(name, "_2light");
    const auto emission = name.empty() ? std::optional{0.0f} : take(name, "_me") ? emission_of(name) : std::nullopt;
    if (!source || !emission) return unknown_name;

    LightingRegisters r = usual_lighting();
    r.has_specular_alpha = true;
    r.material_alpha = 0.75f;
    r.scene_ambient = is_emissive ? scene_ambient : sum_of(scene_ambient, material_emissive);
    r.material_emission = {*emission, *emission, *emission};
    r.light[0] = infinite_light({0, 0, 1});
    r.light[0].ambient = material_ambient;
    r.light[0].diffuse = material_diffuse;
    r.light[0].specular = material_specular;
    if (has_two_lights) {
        r.light[1] = infinite_light({0, 0, 1});
        r.light[1].ambient = r.light[1].diffuse = r.light[1].specular = {0.25f, 0.25f, 0.25f};
    }
    const LitCamera camera;
    pipeline::Surface surface = cleared_to(profile, 0xff303030);
    draw_checkerboard(surface, 20, 0xff202020, 0xff909090);
    for (std::size_t k = 0; k < 9; ++k) {
        const auto of = [&](std::size_t which) { return from_vertex[k][which] ? *source : constant; };
        const ColorSources sources = is_emissive ? ColorSources{emissive[k][0], emissive[k][1], constant, constant}
                                                 : ColorSources{of(2), of(3), of(0), of(1)};
        draw_square(surface, camera, r, sources, 126 + 132 * static_cast<float>(k % 3),
                    100 + 100 * static_cast<float>(k / 3));
    }
    draw_legend(surface, camera, r);
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
