// Suite Front_face: FrontFace_[FM_|LM_]<CW|CCW|0x00|0x63>_CF_<F|B|FaB>, polygons filled or (LM) as lines. The left quad
// is counterclockwise in the window, the right one clockwise; a word that is not a direction leaves CW in effect.
// rasterizer/reference/chip-geometry.md 5.2.
#include <algorithm>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {

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
    if (as_lines) return {std::nullopt, "the lines of this suite are not explained"};
    // Anything except CCW leaves the previous direction: CW.
    pipeline::DrawState state;
    state.front_face = winding == "CCW" ? FrontFace::counter_clockwise : FrontFace::clockwise;
    state.cull = name == "F" ? CullFace::front : name == "B" ? CullFace::back : CullFace::front_and_back;

    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff000000));
    constexpr Argb color = 0xffffffff;
    // Upper left, lower left, lower right, upper right: counterclockwise in the window; then clockwise.
    const std::vector<ClipVertex> corners{at(138, 44, color),  at(138, 430, color), at(310, 430, color),
                                          at(310, 44, color),  at(330, 44, color),  at(502, 44, color),
                                          at(502, 430, color), at(330, 430, color)};
    SplitDraw draw = split_draw(Topology::quads, corners, PolygonMode::fill);
    surface.draw(state, std::move(draw.soup), draw.primitive);
    return {SuitePicture{.reading = CaptureFormat::drawn, .image = surface.color(), .background = unpack(0xff000000)},
            {}};
}

}  // namespace strata::hardware_check
