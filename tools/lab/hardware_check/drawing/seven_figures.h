// tools/lab/hardware_check/drawing/seven_figures.h - the scene that Line_width, Edge_flag and Smoothing_control
// share: points, a line loop and five kinds of polygons in eight colours, by a pass-through program.
// rasterizer/reference/lines-and-points.md 2.
#pragma once
#include "tools/lab/hardware_check/drawing/splits.h"

namespace strata::hardware_check {

struct Figure {
    Topology topology;
    std::vector<std::array<float, 2>> points;  // pixels from the scene's corner
};

[[nodiscard]] const std::vector<Figure>& seven_figures();

// Draws figures in their order; the scene's corner is at (x, y).
void draw_figures(pipeline::Surface& surface, const std::vector<Figure>& figures, float x, float y, PolygonMode mode,
                  const pipeline::DrawState& state);

}  // namespace strata::hardware_check
