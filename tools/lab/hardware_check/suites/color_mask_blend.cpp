// Suite Color_mask_blend: C<mask>_O<equation>_S<factor>_D<factor> in the chip's register words. One picture is known:
// only colours are written, times destination alpha. pipeline/reference/chip-fragment.md 3.3.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using Color = std::array<float, 4>;

// A quad of 71 x 120 pixels with four colours, as the triangles (UL, UR, LR) and (UL, LR, LL). `fade` scales its
// alphas, which are not written: the quads multiply colours by the stored alpha.
TriangleSoup ramp(float left, float fade) {
    const float right = left + 71, top = 180, bottom = 300;
    TriangleSoup soup;
    add_quad(soup,
             {at(left, top, 0, Color{1, 0, 0, 0.5f * fade}), at(right, top, 0, Color{0.5f, 0.5f, 0.5f, fade}),
              at(right, bottom, 0, Color{0, 0, 1, 0.9f * fade}), at(left, bottom, 0, Color{0, 1, 0, 0.75f * fade})});
    return soup;
}

}  // namespace

Drawing draw_color_mask_blend(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name != "C00010101_O32774_S772_D0") return unknown_name;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0x30222222));
    const pipeline::DrawState over{.blend = pipeline::blend_mode::over};
    // Three rectangles that produce different destination alphas below the four quads.
    surface.draw(over, box({20, 120, 320, 360}, 0xccffffff));
    surface.draw(over, box({180, 130, 310, 350}, 0xff000000));
    surface.draw(over, box({330, 130, 470, 350}, 0x22ff9977));
    // Source times destination alpha, without the destination's colour.
    const pipeline::BlendTerm times_alpha{pipeline::BlendEquation::add, pipeline::BlendFactor::dst_alpha,
                                          pipeline::BlendFactor::zero};
    float fade = 1;
    for (const float left : {71.0f, 213.0f, 355.0f, 497.0f}) {
        // Mask 7 writes r, g and b, so destination alpha stays that of the rectangles.
        surface.draw({.blend = {true, times_alpha, times_alpha}, .color_mask = 7}, ramp(left, fade));
        fade *= 0.75f;
    }
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
