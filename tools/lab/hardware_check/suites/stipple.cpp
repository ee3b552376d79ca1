// Suite Stipple_tests: <pattern>_<On|Off>: the seven figures and a square of 64 pixels, with a polygon stipple.
// rasterizer/reference/lines-and-points.md 6.
#include <map>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/seven_figures.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using Words = std::array<std::uint32_t, 32>;  // of the registers SET_STIPPLE_PATTERN

Words words_of(std::string_view pattern) {
    Words words{};
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (pattern == "Border" && i != 0 && i != 31) words[i] = 0x7ffffffe;
        if (pattern == "Alternating") words[i] = 0xaaaaaaaa;
        if (pattern == "Checkered") words[i] = i / 4 % 2 == 0 ? 0x0f0f0f0f : 0xf0f0f0f0;
    }
    return words;
}

// Word r is row (479 - r) mod 32, and its bit (x mod 32) ^ 7 is column x.
rasterizer::PolygonStipple stipple_of(const Words& words) {
    rasterizer::PolygonStipple rows{};
    for (std::size_t r = 0; r < words.size(); ++r)
        for (unsigned x = 0; x < 32; ++x)
            if ((words[r] >> (x ^ 7u) & 1u) != 0) rows[(picture_height - 1 - r) % 32] |= 0x80000000u >> x;
    return rows;
}

}  // namespace

Drawing draw_stipple(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_on = take_last(name, "_On");
    if (!is_on && !take_last(name, "_Off")) return unknown_name;
    if (name != "Zero" && name != "Border" && name != "Alternating" && name != "Checkered") return unknown_name;
    pipeline::DrawState state{.blend = pipeline::blend_mode::over};
    if (is_on) state.polygon_stipple = stipple_of(words_of(name));
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff202224));
    draw_figures(surface, seven_figures(), 160, 48, PolygonMode::fill, state);
    surface.draw(state, box({288, 384, 352, 448}, 0xffffffff));
    // The pixel of Smoothing_control's first quarter.
    return {SuitePicture{.image = surface.color(), .bound = {1, 1}}, {}};
}

}  // namespace strata::hardware_check
