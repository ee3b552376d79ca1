// Suites Fog, Fog_vsh and Fog_inf_coord: AFF-<function>-planar, four white triangles from near to far, whose fog
// coordinate is that of the fixed pipeline, w, or infinity; and Fog_coord_vec4: <writes>-<x>_<y>_<z>_<w>, the same
// triangles with a coordinate that a program writes. pipeline/reference/fog-and-lighting.md 4.1 and 4.2.
#include <limits>

#include "tools/lab/hardware_check/drawing/fogged.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

constexpr std::array<float, 4> white{1, 1, 1, 1};

// World points.
constexpr HostVector triangles[4][3] = {{{-1.5f, -1.5f, 0, 1}, {-2.5f, 0.6f, 0, 1}, {-0.5f, 0.6f, 0, 1}},
                                        {{0, -1.5f, 5, 1}, {-1, 0.75f, 10, 1}, {2, 0.75f, 20, 1}},
                                        {{5, -2, 30, 1}, {3, 2, 40, 1}, {12, 2, 70, 1}},
                                        {{20, -10, 50, 1}, {12, 10, 125, 1}, {80, 10, 200, 1}}};

// The triangles with the fog coordinate of each vertex, over a clear colour.
template <class Coordinate>
pipeline::Image draw_triangles(const pipeline::DeviceProfile& profile, Argb clear, const FogRegisters& registers,
                               const FogCamera& camera, const pipeline::Combiners& combiners,
                               const Coordinate& coordinate) {
    FoggedSoup soup{registers};
    const auto fogged = [&](const HostVector& world) {
        const ClipVertex vertex = camera.vertex(world, white);
        return FoggedVertex{vertex, coordinate(world, vertex)};
    };
    for (const auto& [a, b, c] : triangles) soup.add_triangle(fogged(a), fogged(b), fogged(c));
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(clear));
    soup.draw(surface, combiners);
    return surface.color();
}

enum class Source : std::uint8_t { eye_z, w, infinity };

Drawing draw_planar(std::string_view name, const pipeline::DeviceProfile& profile, Source source) {
    if (!take(name, "AFF-")) return unknown_name;
    const auto function = fog_function(take_until(name, "-"));
    if (!function || name != "planar") return unknown_name;
    const FogRegisters registers =
        usual_registers(*function, {float{0x30} / 255.0f, float{0x20} / 255.0f, float{0x7f} / 255.0f, 1});
    const FogCamera camera{source == Source::eye_z ? FogCamera::Transform::fixed : FogCamera::Transform::program};
    const auto coordinate = [&](const HostVector& world, const ClipVertex& vertex) {
        if (source == Source::infinity) return std::numeric_limits<float>::infinity();
        return source == Source::eye_z ? camera.eye(world)[2] : vertex.w;
    };
    SuitePicture picture{.image = draw_triangles(profile, 0xff303030, registers, camera, mix_with_fog(), coordinate)};
    // A pixel within 2e-7 of a step of the factor (fog-and-lighting.md 4.1).
    if (source != Source::infinity && pipeline::is_linear(*function)) picture.bound = {1, 1};
    return {std::move(picture), {}};
}

// The last write of a program, each in the order x, y, z, w: "W_Z_Y_X" are four writes and "XYZW" is one.
std::optional<std::size_t> component_of(std::string_view writes) {
    const std::string_view last = writes.substr(writes.rfind('_') + 1);
    const std::size_t component = std::string_view{"XYZW"}.find(last.empty() ? ' ' : last.front());
    return component == std::string_view::npos ? std::nullopt : std::optional{component};
}

}  // namespace

Drawing draw_fog(std::string_view name, const pipeline::DeviceProfile& profile) {
    return draw_planar(name, profile, Source::eye_z);
}
Drawing draw_fog_vsh(std::string_view name, const pipeline::DeviceProfile& profile) {
    return draw_planar(name, profile, Source::w);
}
Drawing draw_fog_inf_coord(std::string_view name, const pipeline::DeviceProfile& profile) {
    return draw_planar(name, profile, Source::infinity);
}

// Bias and multiplier 1: the factor is the coordinate.
Drawing draw_fog_coord_vec4(std::string_view name, const pipeline::DeviceProfile& profile) {
    using Reg = pipeline::CombinerRegister;
    const FogRegisters registers{FogFunction::linear, 1.0f, 1.0f, {0, 1, 0, 1}};
    pipeline::Combiners combiners = mix_with_fog();
    combiners.final_stage.c = {.source = Reg::primary_color};
    combiners.final_stage.g = {.source = Reg::zero, .mapping = pipeline::CombinerMapping::unsigned_invert};
    Argb clear = 0xff303030;
    std::optional<float> coordinate;
    if (name == "CoordNotSet") {
        // The program before wrote x = 0.25, and nothing has changed it.
        clear = 0xff341010;
        coordinate = 0.25f;
        combiners.final_stage.b = {.source = Reg::constant_color0};
        combiners.final_stage.constant[0] = {127.0f / 255.0f, 0, 191.0f / 255.0f, 1};
    } else {
        combiners.final_stage.b = {.source = Reg::fog};
        const auto component = component_of(take_until(name, "-"));
        for (std::size_t k = 0; component && k <= *component; ++k) coordinate = to_number(take_until(name, "_"));
    }
    if (!coordinate || !(*coordinate >= 0 && *coordinate <= 1)) return unknown_name;
    const FogCamera camera{FogCamera::Transform::program};
    return {SuitePicture{.image = draw_triangles(profile, clear, registers, camera, combiners,
                                                 [&](const auto&, const auto&) { return *coordinate; })},
            {}};
}

}  // namespace strata::hardware_check
