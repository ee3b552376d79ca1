// Suite Window_clip: <I|E>_x<X>y<Y>_w<W>h<H>-x<X>y<Y>_w<W>h<H>, with a prefix s the second region is set first. Two
// clip regions, drawn inside or outside; both limits of a region are inclusive. Writing a limit of region 0 sets all
// eight regions, so with an s only the first region remains. With a prefix r it is drawn into a target of 256 x 256
// pixels, which is displayed at (192, 112).
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

// Removes `key` and up to six decimal digits from the name: six digits cannot overflow an int.
std::optional<int> take_number(std::string_view& name, std::string_view key) {
    if (!take(name, key)) return std::nullopt;
    int value = 0, digits = 0;
    for (; !name.empty() && name[0] >= '0' && name[0] <= '9' && digits < 6; ++digits, name.remove_prefix(1))
        value = 10 * value + (name[0] - '0');
    return digits > 0 ? std::optional{value} : std::nullopt;
}

constexpr int widest = 4095;  // the registers of the limits have 12 bits [A]

// A region x, y, w, h. Both limits x and x + w are inclusive on the chip; a Rect is half-open, hence the + 1.
std::optional<rasterizer::Rect> take_region(std::string_view& name) {
    const auto x = take_number(name, "x"), y = take_number(name, "y"), w = take_number(name, "_w"),
               h = take_number(name, "h");
    if (!x || !y || !w || !h || *x + *w > widest || *y + *h > widest) return std::nullopt;
    return rasterizer::Rect{*x, *y, *x + *w + 1, *y + *h + 1};
}

}  // namespace

Drawing draw_window_clip(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_off_screen = take(name, "r");
    const bool second_is_overwritten = take(name, "s");
    const bool exclusive = take(name, "E_");
    if (!exclusive && !take(name, "I_")) return unknown_name;
    const auto first = take_region(name);
    const auto second = first && take(name, "-") ? take_region(name) : std::nullopt;
    if (!second || !name.empty()) return unknown_name;

    // The exclusive mode is drawn as its complement: the whole square in one colour, then the
    // regions in the other.
    constexpr Argb below = 0xff337788, above = 0xffff7733;
    const Box square{0, 0, 256, 256};
    const int width = is_off_screen ? 256 : picture_width, height = is_off_screen ? 256 : picture_height;
    pipeline::Surface surface{profile, {.width = width, .height = height}};
    surface.clear_color(unpack(0xfe111213));
    surface.draw({}, box(square, exclusive ? above : below));
    for (const rasterizer::Rect& region : {*first, second_is_overwritten ? *first : *second})
        surface.draw({.window_clip = region}, box(square, exclusive ? below : above));
    if (!is_off_screen) return {SuitePicture{.image = surface.color()}, {}};
    // The target is displayed texel by texel.
    pipeline::Surface window{profile, {}};
    window.clear_color(unpack(0xfe332233));
    const pipeline::Texture target = as_texture(surface.color());
    place(window, target, 192, 112, {});
    return {SuitePicture{.image = window.color()}, {}};
}

}  // namespace strata::hardware_check
