// Suite Alpha_func: AlphaFunc<function>_<Enabled|Disabled>. Ramps of alpha tested against the reference 7F, blended.
// pipeline/reference/chip-fragment.md 2.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using Color = std::array<float, 4>;

// A quad 512 pixels wide and 64 high. Its colour changes from `left` at x = 64 to `right` at x = 576, so that each code
// of alpha covers about two columns.
TriangleSoup ramp(float top, const Color& left, const Color& right) {
    TriangleSoup soup;
    add_quad(soup,
             {at(64, top, 0, left), at(576, top, 0, right), at(576, top + 64, 0, right), at(64, top + 64, 0, left)});
    return soup;
}

}  // namespace

Drawing draw_alpha_func(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (!take(name, "AlphaFunc")) return unknown_name;
    const bool enabled = take_last(name, "_Enabled");
    if (!enabled && !take_last(name, "_Disabled")) return unknown_name;
    const auto func = compare_func(name);
    if (!func) return unknown_name;

    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff222322));
    const pipeline::DrawState state{.alpha = {.enabled = enabled, .func = *func, .ref = 127.0f / 255.0f},
                                    .blend = pipeline::blend_mode::over};
    // 149.333 is not a multiple of 1/16: the chip truncates it to 149.3125, as the captures show.
    constexpr float top = 149.333f;
    surface.draw(state, ramp(top, {1, 0, 0, 0}, {1, 0, 0, 1}));
    surface.draw(state, ramp(top + 64, {0, 0, 1, 1}, {0, 0, 1, 0}));
    // The narrow range shows that vertex alphas are converted to 8-bit codes before interpolation: 0.495 and 0.505
    // become 126 and 129.
    surface.draw(state, ramp(top + 128, {0, 1, 0, 0.495f}, {0, 1, 0, 0.505f}));
    // Alpha 7F equals the reference: EQUAL, LEQUAL and GEQUAL pass here, LESS and GREATER do not.
    surface.draw(state, box({0, top + 192, 640, top + 224}, 0x7fffffff));
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
