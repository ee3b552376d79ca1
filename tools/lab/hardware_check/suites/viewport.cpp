// Suite Viewport: <x>_<y>-<scale x>_<scale y>: the effect of the viewport's offset and scale on squares drawn by a
// vertex program and by the fixed-function pipeline. rasterizer/reference/chip-geometry.md 5.6.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/squares.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

// The offsets of the test, as spelled in names: three decimals, x and y alike.
struct NamedOffset {
    std::string_view name;
    float offset;
};
constexpr NamedOffset offsets[] = {{"0.000", 0},          {"0.531", 0.53125f},  {"0.562", 0.5625f},
                                   {"-0.531", -0.53125f}, {"-0.438", -0.4375f}, {"-0.437", -0.4375f},
                                   {"1.000", 1},          {"-1.000", -1}};

}  // namespace

Drawing draw_viewport(std::string_view name, const pipeline::DeviceProfile& profile) {
    for (const NamedOffset& named : offsets) {
        std::string_view rest = name;
        // The scale is only an input to the vertex program, which does not use it; the fixed-function pipeline has it
        // in its matrix.
        if (!take(rest, named.name) || !take(rest, "_") || !take(rest, named.name)) continue;
        if (rest != "-0.000_0.000" && rest != "-2.000_0.000") continue;
        pipeline::Surface surface{profile, {}};
        surface.clear_color(unpack(0xfe404040));
        draw_mixed_squares(surface, {0, named.offset, 0xff991100, 0xffbb3300});
        return {SuitePicture{.image = surface.color()}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
