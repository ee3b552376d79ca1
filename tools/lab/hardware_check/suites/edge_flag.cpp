// Suite Edge_flag: Enabled: the seven figures and three more as lines, with all edge flags set. Disabled: which sides a
// cleared flag hides is not described. rasterizer/reference/lines-and-points.md 1.
#include "tools/lab/hardware_check/drawing/seven_figures.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {

Drawing draw_edge_flag(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name == "Disabled") return {std::nullopt, "the sides that a cleared edge flag hides are not described"};
    if (name != "Enabled") return unknown_name;
    std::vector<Figure> figures = seven_figures();
    figures.push_back({Topology::triangles,
                       {{365.185925f, 35}, {349.778838f, 22.523717f}, {410, 19}, {344, 48}, {404, 37}, {332, 103}}});
    figures.push_back({Topology::polygon, {{320, 232}, {340, 142.1f}, {361, 120}, {405, 169.3f}, {419, 230.5f}}});
    figures.push_back({Topology::quads, {{100, 350}, {160, 340}, {158.5f, 425.4f}, {112.75f, 407.5f}}});
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff303234));
    draw_figures(surface, figures, 160, 48, PolygonMode::line, {});
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
