// Suite Smoothing_control: 0x<value of the register>: six of the seven figures, four times: plain, with smooth lines,
// with smooth polygons, and with both. FFFF0001h: band lines everywhere; FFFF0000h: thin or smooth lines.
// rasterizer/reference/lines-and-points.md 2 to 3.
#include "tools/lab/hardware_check/drawing/seven_figures.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {

Drawing draw_smoothing_control(std::string_view name, const pipeline::DeviceProfile& profile) {
    using rasterizer::LineStyle;
    if (name != "0xFFFF0000" && name != "0xFFFF0001") return unknown_name;
    const bool has_smoothing = name == "0xFFFF0000";
    std::vector<Figure> figures = seven_figures();
    figures.pop_back();
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff32343a));
    for (const float x : {0.0f, 320.0f})
        for (const float y : {0.0f, 240.0f})
            draw_figures(surface, figures, x, y, PolygonMode::fill,
                         {.blend = pipeline::blend_mode::over,
                          .line_style = !has_smoothing ? LineStyle::band
                                        : x > 0        ? LineStyle::smooth
                                                       : LineStyle::thin,
                          .smooth_polygons = has_smoothing && y > 0});
    // A pixel of each quarter where 256 times a weight is close to an integer, as in Shade_model.
    return {SuitePicture{.image = surface.color(), .bound = {4, 1}}, {}};
}

}  // namespace strata::hardware_check
