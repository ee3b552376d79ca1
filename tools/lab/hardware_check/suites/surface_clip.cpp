// Suite Surface_clip: x<X>y<Y>_w<W>h<H>[_A8R8G8B8|_B8|_G8B8]: a surface's clip rectangle, over memory that is displayed
// as A8R8G8B8 whatever the surface's own format. rasterizer/reference/chip-geometry.md 5.7.
#include <charconv>

#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using Bytes = std::array<std::uint8_t, 4>;

// A surface's format: its bytes per pixel, lowest first, from the stored codes r g b a.
struct ClipLayout {
    std::string_view suffix;
    std::size_t bytes;
    Bytes (*pack)(const pipeline::PixelCode&);
};
constexpr ClipLayout layouts[] = {
    {"_A8R8G8B8", 4,
     [](const pipeline::PixelCode& c) {
         return Bytes{c[2], c[1], c[0], c[3]};
     }},
    {"_G8B8", 2,
     [](const pipeline::PixelCode& c) {
         return Bytes{c[2], c[1]};
     }},
    {"_B8", 1, [](const pipeline::PixelCode& c) { return Bytes{c[2]}; }},
    {"", 2, [](const pipeline::PixelCode& c) {  // R5G6B5, which keeps the upper bits
         const unsigned word = (c[0] >> 3u) << 11u | (c[1] >> 2u) << 5u | c[2] >> 3u;
         return Bytes{static_cast<std::uint8_t>(word & 0xff), static_cast<std::uint8_t>(word >> 8)};
     }}};

// Removes `key` and the digits after it. Empty if they are absent.
std::optional<int> take_count(std::string_view& name, std::string_view key) {
    if (!take(name, key)) return std::nullopt;
    int value = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), value);
    if (error != std::errc{} || value < 0 || value > picture_width) return std::nullopt;
    name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    return value;
}

// A frame whose four sides, each four pixels thick, are inside `box`.
void add_frame(TriangleSoup& soup, const Box& box, const std::array<float, 4>& color) {
    constexpr float thick = 4;
    const auto add = [&](const Box& b) {
        add_quad(soup, {at(b.left, b.top, 0, color), at(b.right, b.top, 0, color), at(b.right, b.bottom, 0, color),
                        at(b.left, b.bottom, 0, color)});
    };
    add({box.left, box.top, box.right, box.top + thick});
    add({box.left, box.bottom - thick, box.right, box.bottom});
    add({box.left, box.top, box.left + thick, box.bottom});
    add({box.right - thick, box.top, box.right, box.bottom});
}

// Red just outside the clip rectangle, dark green over it and a pixel beyond, light green along its inner edges.
pipeline::Image drawn_in(const pipeline::DeviceProfile& profile, const rasterizer::Rect& clip) {
    const auto grown = [&](float by) {
        return Box{static_cast<float>(clip.x0) - by, static_cast<float>(clip.y0) - by, static_cast<float>(clip.x1) + by,
                   static_cast<float>(clip.y1) + by};
    };
    TriangleSoup soup;
    add_frame(soup, grown(4), {1, 0, 0, 1});
    const Box middle = grown(1);
    constexpr std::array<float, 4> dark{0.1f, 0.6f, 0.1f, 1};
    add_quad(soup, {at(middle.left, middle.top, 0, dark), at(middle.right, middle.top, 0, dark),
                    at(middle.right, middle.bottom, 0, dark), at(middle.left, middle.bottom, 0, dark)});
    add_frame(soup, grown(0), {0, 1, 0, 1});
    pipeline::Surface surface{profile, {}};
    surface.draw({.window_clip = clip}, std::move(soup));
    return surface.color();
}

// The memory of a surface with 2560 bytes per row, cleared as A8R8G8B8 before the surface got its format and clip
// rectangle.
pipeline::Image shown(const pipeline::Image& drawn, const ClipLayout& layout, const rasterizer::Rect& clip) {
    pipeline::Image memory{pipeline::Format::rgba8, picture_width, picture_height};
    const pipeline::PixelCode cleared = unpack(0xfc111155);
    for (std::size_t i = 0; i < memory.codes.size(); ++i) memory.codes[i] = cleared[i % 4];
    // Byte 0 of a pixel is displayed as blue, 1 as green, 2 as red, 3 as alpha.
    constexpr int channel_of[4] = {2, 1, 0, 3};
    for (int y = clip.y0; y < clip.y1; ++y)
        for (int x = clip.x0; x < clip.x1; ++x) {
            pipeline::PixelCode code{};
            for (int c = 0; c < 4; ++c)
                code[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(drawn.codes[drawn.index(x, y, c)]);
            const Bytes bytes = layout.pack(code);
            for (std::size_t k = 0; k < layout.bytes; ++k) {
                const int at_byte = x * static_cast<int>(layout.bytes) + static_cast<int>(k);
                memory.codes[memory.index(at_byte / 4, y, channel_of[at_byte % 4])] = bytes[k];
            }
        }
    return memory;
}

}  // namespace

Drawing draw_surface_clip(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name == "XemuBug420" || name == "DebugTextShouldClip") return {std::nullopt, "it shows no drawn shape"};
    if (name.starts_with("rt_")) return {std::nullopt, "the memory of its texture target is not described"};
    for (const ClipLayout& layout : layouts) {
        std::string_view rest = name;
        if (!take_last(rest, layout.suffix)) continue;
        const auto x = take_count(rest, "x"), y = take_count(rest, "y"), w = take_count(rest, "_w"),
                   h = take_count(rest, "h");
        if (!h || !w || !x || !y || !rest.empty()) continue;
        if (*x + *w > picture_width || *y + *h > picture_height) continue;
        if (*w == 0 || *h == 0) return {std::nullopt, "what a clip without area lets through is not known"};
        const rasterizer::Rect clip{*x, *y, *x + *w, *y + *h};
        return {SuitePicture{.image = shown(drawn_in(profile, clip), layout, clip)}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
