// Suite Depth_function: DepthFunc[_ZB]. Every comparison function behind, at and in front of a stored depth.
// pipeline/reference/chip-fragment.md 4.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::CompareFunc;

// The functions in the order of the picture's columns, left to right.
constexpr CompareFunc columns[] = {CompareFunc::always,   CompareFunc::never,  CompareFunc::less,
                                   CompareFunc::equal,    CompareFunc::lequal, CompareFunc::greater,
                                   CompareFunc::notequal, CompareFunc::gequal};
// Codes of the 16-bit buffer.
constexpr float backdrop = 0xdc87, behind = 0xe11f, front = 0xd666;

// Every draw writes depth: a square that passes changes the stored depth, which _ZB shows.
pipeline::DrawState with(CompareFunc func) { return {.depth = {.enabled = true, .func = func, .write = true}}; }

// A backdrop whose comparison always passes, and over it three squares behind, at and in front of
// its depth.
void draw_column(pipeline::Surface& surface, float x, float top, CompareFunc func) {
    surface.draw(with(CompareFunc::always), box({x + 4, top, x + 32, top + 96}, 0xffaaaaaa, backdrop));
    surface.draw(with(func), box({x, top + 4, x + 24, top + 24}, 0xffff3333, behind));
    surface.draw(with(func), box({x, top + 36, x + 24, top + 60}, 0xff3333ff, backdrop));
    surface.draw(with(func), box({x, top + 68, x + 24, top + 92}, 0xff33ff33, front));
}

}  // namespace

Drawing draw_depth_function(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool shows_depth = take_last(name, "_ZB");
    if (name != "DepthFunc") return unknown_name;
    pipeline::Surface surface{profile, {.depth = pipeline::DepthFormat::d16}};
    surface.clear_color(unpack(0xff000000));
    surface.clear_depth(0xffff);
    // The last row's words are not functions, so the current one stays: ALWAYS, from the backdrop.
    for (const float top : {64.0f, 200.0f, 320.0f})
        for (std::size_t k = 0; k < std::size(columns); ++k)
            draw_column(surface, 32.0f + 40.0f * static_cast<float>(k), top,
                        top == 320 ? CompareFunc::always : columns[k]);
    if (shows_depth) return {SuitePicture{.reading = CaptureFormat::depth16, .image = surface.depth()}, {}};
    return {SuitePicture{.image = surface.color()}, {}};
}

}  // namespace strata::hardware_check
