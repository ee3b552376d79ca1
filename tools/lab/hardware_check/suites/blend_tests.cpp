// Suite Blend_tests: <source factor>_<equation>_<destination factor>, and #spot_<source factor>_<equation> with all
// destination factors in one picture. pipeline/reference/chip-fragment.md 1.1.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::Blend;
using pipeline::BlendEquation;
using pipeline::BlendFactor;
using pipeline::DeviceProfile;
using pipeline::Surface;

constexpr Argb pale = 0x33333333, black = 0xff000000;
constexpr std::uint8_t colors = 7, alpha = 8;

constexpr std::string_view spot_factors[] = {"0",       "1",    "srcRGB", "1-srcRGB", "srcA",
                                             "1-srcA",  "dstA", "1-dstA", "dstRGB",   "1-dstRGB",
                                             "srcAsat", "cRGB", "1-cRGB", "cA",       "1-cA"};

struct Square {
    float x, y, side;
    [[nodiscard]] Box box() const { return {x, y, x + side, y + side}; }
};

// Nested squares: colours are replaced, then alpha is blended, which reads the colours just written.
void alpha_stack(Surface& target, Square s, float inset, const Blend& state) {
    for (const Argb color : {0x7f00cc00u, 0xffcc0000u, 0x800000ffu, 0x00ffffffu}) {
        target.draw({.color_mask = colors}, box(s.box(), color));
        target.draw({.blend = state, .color_mask = alpha}, box(s.box(), color));
        s = {s.x + inset, s.y + inset, s.side - 2 * inset};
    }
}

// Squares from top to bottom: colours are blended, then alpha is replaced.
void color_stack(Surface& target, Square s, const Blend& state) {
    for (const Argb color : {0xdd00dd00u, 0xdddd0000u, 0xdd0000ddu, 0xddffffffu}) {
        target.draw({.blend = state, .color_mask = colors}, box(s.box(), color));
        target.draw({.color_mask = alpha}, box(s.box(), color));
        s.y += s.side;
    }
}

void full_stack(Surface& target, Square s, const Blend& state) {
    for (const Argb color : {0xddffffffu, 0xdd0000ddu, 0xdddd0000u, 0xdd00dd00u}) {
        target.draw({.blend = state}, box(s.box(), color));
        s.y += s.side;
    }
}

Blend tested(BlendEquation equation, BlendFactor source, BlendFactor destination) {
    const pipeline::BlendTerm term{equation, source, destination};
    constexpr float constant = 0x55 / 255.0f;
    return {true, term, term, {constant, constant, constant, constant}};
}

Surface target(const DeviceProfile& profile, int width, int height, int cell) {
    Surface surface{profile, {.width = width, .height = height}};
    surface.fill([cell](int x, int y) { return unpack((x / cell + y / cell) % 2 == 0 ? pale : black); });
    return surface;
}

// A texture of 256 x 256 texels, nearest, over the whole window.
Surface background(const DeviceProfile& profile, int cell) {
    Surface window{profile, {}};
    window.fill([cell](int x, int y) {
        const int column = (2 * x + 1) * 256 / (2 * picture_width), row = (2 * y + 1) * 256 / (2 * picture_height);
        return unpack((column / cell + row / cell) % 2 == 0 ? 0xff202020 : 0xff000000);
    });
    return window;
}

void show(Surface& window, const Surface& target, float x, float y) {
    place(window, as_texture(target.color()), x, y, {.blend = pipeline::blend_mode::over});
}

pipeline::Image spot_picture(const DeviceProfile& profile, BlendEquation equation, BlendFactor source) {
    Surface spots = target(profile, 512, 512, 8);
    for (int i = 0; i < 15; ++i) {
        const Blend state = tested(equation, source, *blend_factor(spot_factors[i]));
        const float x = 103.0f * static_cast<float>(i % 5), y = 136.0f * static_cast<float>(i / 5);
        color_stack(spots, {x, y, 24}, state);
        full_stack(spots, {x + 24, y, 24}, state);
        alpha_stack(spots, {x + 48, y, 51}, 4, state);
    }
    Surface window = background(profile, 16);
    show(window, spots, 64, 64);
    return window.color();
}

pipeline::Image detailed_picture(const DeviceProfile& profile, const Blend& state) {
    Surface large = target(profile, 256, 256, 16), left = target(profile, 64, 256, 16),
            right = target(profile, 64, 256, 16);
    alpha_stack(large, {0, 0, 256}, 24, state);
    color_stack(left, {0, 0, 64}, state);
    full_stack(right, {0, 0, 64}, state);
    Surface window = background(profile, 24);
    show(window, large, 192, 112);
    show(window, left, 16, 112);
    show(window, right, 560, 112);
    return window.color();
}

}  // namespace

Drawing draw_blend_tests(std::string_view name, const DeviceProfile& profile) {
    const bool is_spot = take(name, "#spot_");
    const auto source = blend_factor(take_until(name, "_"));
    const auto equation = blend_equation(take_until(name, "_"));
    const auto destination = is_spot ? BlendFactor::zero : blend_factor(name);
    if (!source || !equation || !destination || (is_spot && !name.empty())) return unknown_name;
    if (is_spot) return {SuitePicture{.image = spot_picture(profile, *equation, *source)}, {}};
    return {SuitePicture{.image = detailed_picture(profile, tested(*equation, *source, *destination))}, {}};
}

}  // namespace strata::hardware_check
