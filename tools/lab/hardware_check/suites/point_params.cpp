// Suite Point_params: points whose size follows from their distance (On) or from the register, with a texture across
// each (SmoothOn) or its first texel. Scale_<A>_<B>_<C>: 192 points of growing distance without a texture. FF: the
// fixed pipeline; VS: a program, whose size counts with On alone. rasterizer/reference/lines-and-points.md 5.1 and 5.2.
#include <optional>

#include "pipeline/geforce3/point_size.h"
#include "tools/lab/hardware_check/drawing/fogged.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::PointSizeRegisters;

// The registers of a row's 13 points.
constexpr std::array<PointSizeRegisters, 13> basic_row{{{{0, 0, 0}, 0, 0, 0},
                                                        {{0, 0, 0}, 0, 0, 16},
                                                        {{0.000001f, 0, 0}, 16, 0, 0},
                                                        {{0.000001f, 0, 0}, 16, 0, 8},
                                                        {{4, 0, 0}, 14, 0, 16},
                                                        {{4, 0, 0}, 36, 0, 4},
                                                        {{256, 0, 0}, 36, 0, 4},
                                                        {{0, 0.25f, 0}, 39, 0, 1},
                                                        {{0, 0, 0.05f}, 39, 0, 1},
                                                        {{4, 0, 0}, 14, -0.5f, 16},
                                                        {{4, 0, 0}, 14, 0.5f, 16},
                                                        {{0, 0, 0}, 15, -100, 1},
                                                        {{0, 0, 0}, 15, 100, 1}}};

constexpr std::array<PointSizeRegisters, 13> detailed_row = [] {
    std::array<PointSizeRegisters, 13> row{};
    constexpr float biases[] = {-1, -0.5f, -0.25f, -0.01f, 0, 0.01f, 0.25f, 0.5f, 1, -0.4f, -0.25f, 0.25f, 0.4f};
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = i < 9 ? PointSizeRegisters{{0, 0.25f, 0}, 39, biases[i], 1}
                       : PointSizeRegisters{{4, 0, 0}, 36, biases[i], 4};
    return row;
}();

// Draws points one by one.
class PointPlotter {
  public:
    PointPlotter(pipeline::Surface& surface, bool by_program, const pipeline::DrawState& state)
        : surface_{surface}, by_program_{by_program}, state_{state} {}

    // z is of the world for the fixed pipeline, of the window for a program. `size` in eighths counts without
    // registers, and with a program.
    void plot(float x, float y, float z, const std::array<float, 4>& color,
              const std::optional<PointSizeRegisters>& registers, int size) {
        ClipVertex vertex = at(x, y, z, color);
        if (!by_program_) {
            const HostVector world = camera_.point(x, y, z);
            const HostVector eye = camera_.eye(world);
            vertex = camera_.vertex(world, color);
            if (registers) size = pipeline::attenuated_size(*registers, {eye[0], eye[1], eye[2]});
        }
        state_.point_size_px = static_cast<float>(size) / 8.0f;
        SplitDraw draw = split_draw(Topology::points, {vertex}, PolygonMode::fill);
        surface_.draw(state_, std::move(draw.soup), draw.primitive);
    }

  private:
    pipeline::Surface& surface_;
    bool by_program_;
    pipeline::DrawState state_;
    FogCamera camera_{FogCamera::Transform::fixed};
};

void plot_rows(PointPlotter& plotter, bool has_params, const std::array<PointSizeRegisters, 13>& row, int size) {
    float z = -5, red = 0.1f;
    for (int y = 100; y < picture_height; y += 48, red += 0.1f, z += 25) {
        float blue = 0.1f;
        std::size_t i = 0;
        for (int x = 20; x < picture_width; x += 48, blue += 0.1f, ++i)
            plotter.plot(static_cast<float>(x), static_cast<float>(y), z, {red, 0.65f, std::min(blue, 1.0f), 1},
                         has_params ? std::optional{row[i % row.size()]} : std::nullopt, size);
    }
}

void plot_scales(PointPlotter& plotter, const PointSizeRegisters& registers, const std::array<float, 4>& color) {
    float x = 32, y = 116;
    for (int z = 0; z < 192; ++z) {
        plotter.plot(x, y, static_cast<float>(z), color, registers, 130);
        x += 32;
        if (x >= picture_width - 32) x = 32, y += 32;
    }
}

// Scale_<0|4>_<0|1>_<0|1>: the factors.
std::optional<PointSizeRegisters> scale_registers(std::string_view name) {
    if (!take(name, "Scale_") || name.size() != 5 || name[1] != '_' || name[3] != '_') return std::nullopt;
    const auto is_one_of = [&](std::size_t i, char other) { return name[i] == '0' || name[i] == other; };
    if (!is_one_of(0, '4') || !is_one_of(2, '1') || !is_one_of(4, '1')) return std::nullopt;
    const auto factor = [&](std::size_t i) { return static_cast<float>(name[i] - '0'); };
    return PointSizeRegisters{{factor(0), factor(2), factor(4)}, 64, 0, 0.5f};
}

}  // namespace

Drawing draw_point_params(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool by_program = take_last(name, "_VS");
    if (!by_program && !take_last(name, "_FF")) return unknown_name;
    pipeline::Surface surface{profile, {}};
    if (const auto registers = scale_registers(name)) {
        surface.clear_color(unpack(0xff242323));
        PointPlotter plotter{surface, by_program, {}};
        plot_scales(plotter, *registers, by_program ? std::array{0.93f, 0.33f, 0.33f, 1.0f} : to_float(0xffee5555));
        return {SuitePicture{.image = surface.color()}, {}};
    }
    const bool is_detailed = name == "Detailed";
    bool is_on = is_detailed, is_sprite = is_detailed;
    int size = 128;
    if (!is_detailed) {
        if (!take(name, "PointParams")) return unknown_name;
        is_on = take(name, "On_");
        if (!is_on && !take(name, "Off_")) return unknown_name;
        is_sprite = take(name, "SmoothOn_");
        if (!is_sprite && !take(name, "SmoothOff_")) return unknown_name;
        if (name != "001" && name != "128") return unknown_name;
        size = name == "001" ? 1 : 128;
        if (by_program && !is_on) size = 8;  // the register, which this test leaves at one pixel
    }
    pipeline::Texture texture = checker(32, 2, 0xffffffff, 0xff333333);
    texture.target = pipeline::TextureTarget::two_d;
    surface.clear_color(unpack(is_detailed ? 0xff222324 : 0xff222323));
    PointPlotter plotter{surface, by_program, {.point_sprites = is_sprite, .texture = &texture}};
    plot_rows(plotter, is_on, is_detailed ? detailed_row : basic_row, size);
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
