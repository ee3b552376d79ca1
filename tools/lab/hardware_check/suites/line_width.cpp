// Suite Line_width: <Line|Fill>_<pixels>.<eighths>, Line_FFFFFFFF: band lines of a width register from 0 to 520, which
// ignores values above 511. rasterizer/reference/lines-and-points.md 2.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/seven_figures.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

constexpr float greatest_width_px = 511.0f / 8.0f;

// The width after a register write; before it the width is 1 pixel.
std::optional<float> width_of(std::string_view name) {
    if (name == "FFFFFFFF") return 1.0f;
    const auto pixels = to_number(take_until(name, ".")), eighths = to_number(name);
    if (!pixels || !eighths || !(*pixels >= 0 && *pixels <= 99) || !(*eighths >= 0 && *eighths <= 7))
        return std::nullopt;
    const float width = *pixels + *eighths / 8.0f;
    return width > greatest_width_px ? 1.0f : width;
}

}  // namespace

Drawing draw_line_width(std::string_view name, const pipeline::DeviceProfile& profile) {
    const PolygonMode mode = name.starts_with("Fill_") ? PolygonMode::fill : PolygonMode::line;
    if (!take(name, "Fill_") && !take(name, "Line_")) return unknown_name;
    const auto width = width_of(name);
    if (!width) return unknown_name;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff202224));
    draw_figures(surface, seven_figures(), 160, 48, mode, {.line_width_px = *width});
    // A pixel of a filled polygon where 256 times a weight is close to an integer, as in Shade_model.
    return {SuitePicture{.image = surface.color(), .bound = mode == PolygonMode::fill ? Bound{2, 1} : Bound{}}, {}};
}

}  // namespace strata::hardware_check
