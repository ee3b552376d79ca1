// Suite Antialiasing_tests: surfaces of one, two and four samples per pixel, and what the CPU, a texture unit and the
// display make of their bytes; nothing is resolved. pipeline/reference/fragment-stages.md 13.1.
#include <array>

#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

constexpr Argb background = 0xff050505, grey = 0xff808080, blue = 0xff3333c0;
constexpr int cell = 8;      // pixels or texels per side of a checkerboard's cell
constexpr int texels = 128;  // per side of the texture

// The shape of all pictures, moved to the right and down: the diamond whose corners are 64 pixels from the window's
// sides, with the texture's corners at its own.
TriangleSoup diamond(float shift, const std::array<float, 4>& color) {
    constexpr float inset = 64, width = picture_width, height = picture_height, side = texels;
    const auto corner = [&](float x, float y, float s, float t) {
        ClipVertex v = at(x + shift, y + shift, 0, color);
        v.texcoord = {s, t};
        return v;
    };
    TriangleSoup soup;
    add_quad(soup, {corner(inset, height / 2, 0, 0), corner(width / 2, inset, side, 0),
                    corner(width - inset, height / 2, side, side), corner(width / 2, height - inset, 0, side)});
    return soup;
}

// The CPU writes the whole window, whatever surface was there before.
SuitePicture written(const pipeline::DeviceProfile& profile, Argb first, Argb second) {
    pipeline::Surface window{profile, {}};
    window.fill([&](int x, int y) { return unpack((x / cell + y / cell) % 2 == 0 ? first : second); });
    return {.image = window.color()};
}

// The CPU wrote the texture; then a surface of some number of samples was there, into which an empty triangle was
// drawn.
SuitePicture textured(const pipeline::DeviceProfile& profile, const pipeline::Texture& texture) {
    pipeline::Surface window{profile, {}};
    window.clear_color(unpack(background));
    window.draw({.texture = &texture}, diamond(0, {1, 1, 1, 1}));
    return {.image = window.color()};
}

// A checkerboard of grey and blue within a border of two texels.
pipeline::Texture bordered() {
    constexpr int border = 2;
    const pipeline::Texture inner = checker(texels - 2 * border, cell, grey, blue);
    pipeline::Texture texture = checker(texels, texels, 0xffcccccc, 0xffcccccc);
    for (int y = 0; y < inner.height; ++y)
        for (int x = 0; x < inner.width * 4; ++x)
            texture.texels[static_cast<std::size_t>((y + border) * texels * 4 + border * 4 + x)] =
                inner.texels[static_cast<std::size_t>(y * inner.width * 4 + x)];
    return texture;
}

constexpr std::array<float, 4> drawn_color{0.25f, 0.95f, 0.75f, 1};

pipeline::Image drawn(const pipeline::DeviceProfile& profile, float shift) {
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(background));
    surface.draw({}, diamond(shift, drawn_color));
    return surface.color();
}

// Two samples per pixel: a row of the surface is twice as long as one of the window, and has the corner and the centre
// of every pixel alternately. The display shows these bytes as rows of the window.
SuitePicture drawn_with_two_samples(const pipeline::DeviceProfile& profile) {
    const pipeline::Image corners = drawn(profile, 0.5f), centres = drawn(profile, 0);
    SuitePicture picture{.image = pipeline::Image{pipeline::Format::rgba8, picture_width, picture_height}};
    for (int y = 0; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) {
            const int sample = y % 2 * picture_width + x;  // in its row of the surface
            const pipeline::Image& samples = sample % 2 == 0 ? corners : centres;
            for (int c = 0; c < 4; ++c)
                picture.image.codes[picture.image.index(x, y, c)] = samples.codes[samples.index(sample / 2, y / 2, c)];
        }
    return picture;
}

}  // namespace

Drawing draw_antialiasing(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name == "AAOnThenOffCPUWrite") return {written(profile, grey, 0xff5555ff), {}};
    if (name == "FramebufferNotModifiedBySurfaceState") return {written(profile, 0xff222222, 0xff88aa00), {}};
    if (name == "SurfaceStatesAreIndependent") return {written(profile, 0xff008080, blue), {}};
    if (name == "CPUWriteIgnoresSurfaceConfig") return {textured(profile, checker(texels, cell, 0xffcc3333, blue)), {}};
    if (name == "NonAACPURoundTrip") return {textured(profile, checker(texels, cell, 0xff336666, 0xff33ff33)), {}};
    if (name.starts_with("CreateSurfaceWith")) {
        name.remove_prefix(std::string_view{"CreateSurfaceWith"}.size());
        if (name == "Center1" || name == "CenterCorner2" || name == "SquareOffset4")
            return {textured(profile, bordered()), {}};
    }
    if (name == "FBSurfaceWithCenter1") return {SuitePicture{.image = drawn(profile, 0)}, {}};
    if (name == "FBSurfaceWithCenterCorner2") return {drawn_with_two_samples(profile), {}};
    if (name == "GPUAAWriteAfterCPUWrite")
        return {std::nullopt, "the samples of a surface of four, whose positions no capture shows"};
    return unknown_name;
}

}  // namespace strata::hardware_check
