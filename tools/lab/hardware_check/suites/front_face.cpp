// Suite Front_face: FrontFace_[FM_|LM_]<CW|CCW|0x00|0x63>_CF_<F|B|FaB>, polygons filled or (LM) as lines. The left quad
// is counterclockwise in the window, the right one clockwise; a word that is not a direction leaves CW in effect. As
// lines the quads are two triangles each, in colours, beside a triangle without area.
// rasterizer/reference/chip-geometry.md 5.2, lines-and-points.md 1.
#include <algorithm>
#include <limits>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

void draw_filled(pipeline::Surface& surface, const pipeline::DrawState& state) {
    constexpr Argb color = 0xffffffff;
    // Upper left, lower left, lower right, upper right: counterclockwise in the window; then clockwise.
    const std::vector<ClipVertex> corners{at(138, 44, color),  at(138, 430, color), at(310, 430, color),
                                          at(310, 44, color),  at(330, 44, color),  at(502, 44, color),
                                          at(502, 430, color), at(330, 430, color)};
    SplitDraw draw = split_draw(Topology::quads, corners, PolygonMode::fill);
    surface.draw(state, std::move(draw.soup), draw.primitive);
}

void draw_outlined(pipeline::Surface& surface, const pipeline::DrawState& state) {
    constexpr Argb red = 0xffff0000, green = 0xff00ff00, blue = 0xff0000ff, gray = 0xff808080;
    // In the left quad's second triangle 1/w is 0 but at the upper right corner, whose colour its sides have. It is
    // listed first, because the captures have the diagonal of the other triangle above its own.
    constexpr float far_away = std::numeric_limits<float>::infinity();
    const auto distant = [](float x, float y, Argb color) { return at(x, y, 0, to_float(color), far_away); };
    const std::vector<ClipVertex> corners{
        distant(138, 44, red), distant(310, 430, blue), at(310, 44, gray),    //
        at(138, 44, red),      at(138, 430, green),     at(310, 430, blue),   // left quad
        at(330, 44, blue),     at(502, 44, green),      at(502, 430, red),    // right quad
        at(330, 44, blue),     at(502, 430, red),       at(330, 430, gray),   //
        at(133, 44, red),      at(133, 237, blue),      at(133, 430, green),  // without area
        at(507, 44, blue),     at(507, 430, gray),      at(507, 237, red)};
    SplitDraw draw = split_draw(Topology::triangles, corners, PolygonMode::line);
    surface.draw(state, std::move(draw.soup), draw.primitive);
}

}  // namespace

Drawing draw_front_face(std::string_view name, const pipeline::DeviceProfile& profile) {
    using rasterizer::CullFace;
    using rasterizer::FrontFace;
    if (!take(name, "FrontFace_")) return unknown_name;
    const bool as_lines = take(name, "LM_");
    // A name without either prefix means FM_: filled polygons.
    if (!as_lines) take(name, "FM_");
    const std::string_view winding = take_until(name, "_CF_");
    // The numbers are words that are not a direction, as spelled in file names.
    constexpr std::string_view windings[] = {"CW", "CCW", "0x00", "0x63", "0", "63"};
    if (std::find(std::begin(windings), std::end(windings), winding) == std::end(windings)) return unknown_name;
    if (name != "F" && name != "B" && name != "FaB") return unknown_name;
    // Anything except CCW leaves the previous direction: CW.
    pipeline::DrawState state;
    state.front_face = winding == "CCW" ? FrontFace::counter_clockwise : FrontFace::clockwise;
    state.cull = name == "F" ? CullFace::front : name == "B" ? CullFace::back : CullFace::front_and_back;

    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff000000));
    if (as_lines)
        draw_outlined(surface, state);
    else
        draw_filled(surface, state);
    const auto reading = as_lines ? CaptureFormat::color : CaptureFormat::drawn;
    return {SuitePicture{.reading = reading, .image = surface.color(), .background = unpack(0xff000000)}, {}};
}

}  // namespace strata::hardware_check
