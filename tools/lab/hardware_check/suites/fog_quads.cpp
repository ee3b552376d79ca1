// Suites Fog_param, Fog_gen and Fog_exceptional_value: rows of quads with other fog coordinates or registers each.
// pipeline/reference/fog-and-lighting.md 4.3 to 4.5.
#include <bit>
#include <cmath>

#include "tools/lab/hardware_check/drawing/fogged.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

namespace nv20 = rasterizer::nv20;
using Transform = FogCamera::Transform;

constexpr Rgba red{1, 0, 0, 1};
constexpr std::array<float, 4> blue{0, 0, 1, 1};

// Squares from left to right and downwards, in pixels.
struct Grid {
    float side, left, top, gap_right, gap_down;
    // Calls visit(left, top) for the squares that begin above `bottom`.
    template <class Visit>
    void for_each(float bottom, const Visit& visit) const {
        const float right = picture_width - (left + side);
        for (float y = top; y < bottom; y += side + gap_down)
            for (float x = left; x < right; x += side + gap_right) visit(x, y);
    }
};

// World z of a square's left and right corners.
struct SideDepths {
    float left, right;
};

struct WorldCorner {
    HostVector world;
    ClipVertex vertex;
};

// The corners of a square, upper left first, clockwise.
std::array<WorldCorner, 4> corners(const FogCamera& camera, const Grid& grid, float left, float top,
                                   const SideDepths& z, const std::array<std::array<float, 4>, 4>& color) {
    const float right = left + grid.side, bottom = top + grid.side;
    const auto corner = [&](float x, float y, float depth, std::size_t k) {
        const HostVector world = camera.point(x, y, depth);
        return WorldCorner{world, camera.vertex(world, color[k])};
    };
    return {corner(left, top, z.left, 0), corner(right, top, z.right, 1), corner(right, bottom, z.right, 2),
            corner(left, bottom, z.left, 3)};
}

std::array<FoggedVertex, 4> with_coordinate(const std::array<WorldCorner, 4>& c, float coordinate) {
    return {FoggedVertex{c[0].vertex, coordinate},
            {c[1].vertex, coordinate},
            {c[2].vertex, coordinate},
            {c[3].vertex, coordinate}};
}

std::array<std::array<float, 4>, 4> alike(const std::array<float, 4>& color) { return {color, color, color, color}; }

// The bias of no fog.
float zero_bias(FogFunction function) {
    if (pipeline::is_linear(function)) return 2.0f;
    if (function == FogFunction::exp) return 1.51f;
    return function == FogFunction::exp_abs ? 1.5075f : 1.5f;
}

}  // namespace

// FogParam<multiplier>-<function>: coordinates from -1.4 on in steps of 0.01. FogZeroBias-<function>: coordinate -1,
// multiplier 0, biases from 1 on in steps of 0.005.
Drawing draw_fog_param(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool steps_bias = take(name, "FogZeroBias");
    if (!steps_bias && !take(name, "FogParam")) return unknown_name;
    const std::size_t dash = name.rfind('-');
    if (dash == std::string_view::npos) return unknown_name;
    const auto function = fog_function(name.substr(dash + 1));
    const auto multiplier = steps_bias ? std::optional{0.0f} : to_number(name.substr(0, dash));
    if (!function || !multiplier || !(std::fabs(*multiplier) <= 2) || (steps_bias && dash != 0)) return unknown_name;
    const FogCamera camera{Transform::fixed};
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff231f23));
    const Grid grid = steps_bias ? Grid{24, 48, 46, 2, 1} : Grid{24, 60, 70, 1, 1};
    const SideDepths z = steps_bias ? SideDepths{1, 1} : SideDepths{0, 1};
    const auto color = alike(steps_bias ? std::array{0.0f, 0.5f, 0.5f, 1.0f} : blue);
    float bias = steps_bias ? 1.0f : zero_bias(*function), coordinate = steps_bias ? -1.0f : -1.4f;
    grid.for_each(picture_height - grid.side, [&](float x, float y) {
        FoggedSoup soup{{*function, bias, *multiplier, red}};
        soup.add_quad(with_coordinate(corners(camera, grid, x, y, z, color), coordinate));
        soup.draw(surface, mix_with_fog());
        (steps_bias ? bias : coordinate) += steps_bias ? 0.005f : 0.01f;
    });
    return {SuitePicture{.image = surface.color()}, {}};
}

namespace {

// How the fixed pipeline generates a fog coordinate.
enum class FogSource : std::uint8_t { specular_alpha, radial, planar, abs_planar, fog_x };

std::optional<FogSource> fog_source(std::string_view word) {
    using enum FogSource;
    constexpr std::pair<std::string_view, FogSource> all[] = {{"spec_alpha", specular_alpha},
                                                              {"radial", radial},
                                                              {"planar", planar},
                                                              {"abs_planar", abs_planar},
                                                              {"fog_x", fog_x}};
    for (const auto& [name, source] : all)
        if (word == name) return source;
    return std::nullopt;
}

// FOG_PLANE is (0, 0, 2, 0).
float generated(FogSource source, const HostVector& eye, float specular_alpha, float fog_x) {
    const float planar = nv20::multiply(2.0f, eye[2]);
    switch (source) {
        case FogSource::specular_alpha: return specular_alpha;
        case FogSource::radial: {
            const auto square = [](float v) { return nv20::multiply(v, v); };
            const float squared = nv20::sum<3>({square(eye[0]), square(eye[1]), square(eye[2])});
            return nv20::multiply(squared, pipeline::float22::wide_rsq(squared));
        }
        case FogSource::planar: return planar;
        case FogSource::abs_planar: return std::fabs(planar);
        case FogSource::fog_x: break;
    }
    return fog_x;
}

// The specular alpha is in 0..1, so that its registers differ.
FogRegisters gen_registers(FogFunction function, bool is_alpha) {
    FogRegisters registers = usual_registers(function, red);
    if (pipeline::is_linear(function)) {
        registers.multiplier = is_alpha ? 2.0f : -1.0f / 200.0f;
        registers.bias = is_alpha ? 0.0f : 1.0f + -200.0f * registers.multiplier;
    } else if (is_alpha) {
        const bool is_square = function == FogFunction::exp2 || function == FogFunction::exp2_abs;
        registers.bias = 0.5f;
        registers.multiplier = is_square ? std::sqrt(1.0f / 32.0f) : 1.0f / 16.0f;
    }
    return registers;
}

}  // namespace

// FogGen_<FF|VS>-<function>-<source>: z from -6 on in steps of 0.5, fog x from 50 down in steps of 0.2. With a program
// the coordinate is fog x, whatever the source.
Drawing draw_fog_gen(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (!take(name, "FogGen_")) return unknown_name;
    const bool is_fixed = take(name, "FF-");
    if (!is_fixed && !take(name, "VS-")) return unknown_name;
    const auto function = fog_function(take_until(name, "-"));
    const auto source = fog_source(name);
    if (!function || !source) return unknown_name;
    if (!is_fixed && *source == FogSource::radial)
        return {std::nullopt, "a program makes no distance, and what the chip takes for it is not known"};
    // Its matrix is that of a buffer of 16 bits: by the world points that the host un-projects with it, 1 pixel of
    // radial fog is off instead of 34.
    const FogCamera camera{is_fixed ? Transform::fixed : Transform::program, 65535.0f};
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff232623));
    const Grid grid{22, 48, 70, 2, 2};
    constexpr float alphas[] = {0.0f, 1.0f, 0.75f, 0.25f};  // of the corners' specular colours
    FoggedSoup soup{gen_registers(*function, is_fixed && *source == FogSource::specular_alpha)};
    float z = -6.0f, fog_x = 50.0f;
    grid.for_each(picture_height - grid.side, [&](float x, float y) {
        const std::array<WorldCorner, 4> corner = corners(camera, grid, x, y, {z, z + 1.0f}, alike(blue));
        std::array<FoggedVertex, 4> fogged;
        for (std::size_t k = 0; k < 4; ++k)
            fogged[k] = {corner[k].vertex,
                         is_fixed ? generated(*source, camera.eye(corner[k].world), alphas[k], fog_x) : fog_x};
        soup.add_quad(fogged);
        z += 0.5f;
        fog_x -= 0.2f;
    });
    soup.draw(surface, mix_with_fog());
    SuitePicture picture{.image = surface.color()};
    // Pixels within 2e-7 of a step of the factor (fog-and-lighting.md 4.4).
    if (is_fixed) picture.bound = {22, 1};
    return {std::move(picture), {}};
}

namespace {

constexpr std::uint32_t exceptional[] = {0,          0x3f800000, 0x41200000, 0x42c80000, 0x447a0000, 0xbf9eb852,
                                         0xc12c0000, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00000, 0x7f800001,
                                         0xff800001, 0x7f7fffff, 0xff7fffff, 0x00800000, 0x80800000, 0x007fffff,
                                         0x807fffff, 0x00000001, 0x80000001};

// Draws one square, whose corners have four colours.
void draw_square(pipeline::Surface& surface, const FogCamera& camera, const Grid& grid, float x, float y,
                 const FogRegisters& registers, float coordinate) {
    constexpr std::array<std::array<float, 4>, 4> colors{
        {{0.25f, 0.5f, 0.5f, 1}, {0.25f, 0.25f, 0.75f, 1}, {0.25f, 0, 1, 1}, {0.25f, 0.75f, 0.25f, 1}}};
    FoggedSoup soup{registers};
    soup.add_quad(with_coordinate(corners(camera, grid, x, y, {0, 2}, colors), coordinate));
    soup.draw(surface, mix_with_fog());
}

// The registers of the 24 squares with one coordinate: four biases, six multipliers each.
std::vector<FogRegisters> register_table(FogFunction function) {
    std::vector<FogRegisters> all;
    for (const float bias : {-1.0f, 1.0f, 1.5f, 1000.0f})
        for (const float multiplier :
             {usual_registers(FogFunction::linear, red).multiplier, usual_registers(FogFunction::exp, red).multiplier,
              usual_registers(FogFunction::exp2, red).multiplier, 1.0f, 0.0f, -1000.0f})
            all.push_back({function, bias, multiplier, red});
    return all;
}

}  // namespace

// [RCP-]FogExc-<function>-<source>: 21 coordinates, or their reciprocals. INF-, NaN-: one coordinate, 24 registers.
Drawing draw_fog_exceptional_value(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_infinite = take(name, "INF-"), is_nan = !is_infinite && take(name, "NaN-");
    const bool is_reciprocal = !is_infinite && !is_nan && take(name, "RCP-");
    if (!take(name, "FogExc-")) return unknown_name;
    const auto function = fog_function(take_until(name, "-"));
    const auto source = fog_source(name);
    if (!function || !source || *source == FogSource::radial) return unknown_name;
    const FogCamera camera{Transform::program};
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff232623));
    const Grid grid{64, 48, 70, 24, 38};
    const std::vector<FogRegisters> table = register_table(*function);
    const std::size_t count = is_infinite || is_nan ? table.size() : std::size(exceptional);
    std::size_t next = 0;
    grid.for_each(picture_height, [&](float x, float y) {
        if (next == count) return;
        const std::size_t k = next++;
        if (is_infinite || is_nan) {
            const float value = std::bit_cast<float>(is_nan ? 0x7fc00000u : 0x7f800000u);
            return draw_square(surface, camera, grid, x, y, table[k], value);
        }
        const auto value = std::bit_cast<float>(exceptional[k]);
        draw_square(surface, camera, grid, x, y, usual_registers(*function, red),
                    is_reciprocal ? nv20::reciprocal(value) : value);
    });
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
