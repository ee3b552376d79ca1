// Suite Clear: C<write mask>_Depth_<y|n>[_ZB], and S?C_<format>: clear words as surfaces of every format store them.
// pipeline/reference/chip-fragment.md 5: the chip's clear command ignores the write masks, which glClear obeys.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

// The words of the clear command, one per tile. All bytes of all words differ, so that an exchanged channel is
// detected.
constexpr Argb clear_words[] = {0x00dacaba, 0x011b2b3b, 0x7f3c2c1c, 0x804d5d6d, 0xfe0ece3e, 0xff8f9faf};
constexpr int side = 128;

// A surface's unused bits, and the value written to them.
struct ClearedLayout {
    std::string_view name;
    // Bytes per pixel.
    int bytes;
    // `unused`: mask of the unused bits. `value`: what is written there, within that mask.
    Argb unused = 0, value = 0;
};
constexpr ClearedLayout layouts[] = {{"A8R8G8B8", 4},
                                     {"R5G6B5", 2},
                                     {"X1R5G5B5_Z1R5G5B5", 2, 0x8000, 0},
                                     {"X1R5G5B5_O1R5G5B5", 2, 0x8000, 0x8000},
                                     {"X8R8G8B8_Z8R8G8B8", 4, 0xff000000, 0},
                                     {"X8R8G8B8_O8R8G8B8", 4, 0xff000000, 0xff000000},
                                     {"X1A7R8G8B8_Z1A7R8G8B8", 4, 0x80000000, 0},
                                     {"X1A7R8G8B8_O1A7R8G8B8", 4, 0x80000000, 0x80000000}};

// The surface's contents after a clear with `word`: a 16-bit surface takes the low half without any conversion.
[[nodiscard]] Argb stored(const ClearedLayout& layout, Argb word) {
    const Argb kept = layout.bytes == 2 ? word & 0xffff : word;
    return (kept & ~layout.unused) | layout.value;
}

// The texel (x, y) that a 32-bit lookup returns for a surface of any format, r in the lowest byte. Two 16-bit pixels
// are one texel. `mark` is the word of the 4 x 4 square in the middle.
pipeline::PixelCode texel(const ClearedLayout& layout, Argb word, Argb mark, int x, int y) {
    const auto pixel = [&](int column, int row) {
        const bool in_mark = column >= 62 && column < 66 && row >= 62 && row < 66;
        return stored(layout, in_mark ? mark : word);
    };
    Argb bytes = 0;
    if (layout.bytes == 4) {
        bytes = pixel(x, y);
    } else {
        // A row of 128 texels is 256 pixels of 16 bits: two rows of the surface.
        const int first = 2 * (y * side + x);
        bytes = pixel(first % side, first / side) | pixel((first + 1) % side, (first + 1) / side) << 16;
    }
    const auto byte = [bytes](int shift) { return static_cast<std::uint8_t>(bytes >> shift & 0xff); };
    return {byte(0), byte(8), byte(16), byte(24)};
}

// Six targets, one per clear word, displayed texel by texel, four per row. A 16-bit surface fills half of the rows.
SuitePicture surface_picture(const pipeline::DeviceProfile& profile, const ClearedLayout& layout) {
    pipeline::Surface window{profile, {}};
    window.clear_color(unpack(0xff220022));
    // Opaque black. The 16-bit pixels are 0; `stored` adds the value of the unused bit.
    const Argb mark = layout.bytes == 2 ? 0x00000000 : 0xff000000;
    for (int k = 0; k < 6; ++k) {
        pipeline::Texture texture;
        texture.target = pipeline::TextureTarget::rectangle;
        texture.filter = pipeline::TextureFilter::nearest;
        texture.wrap_s = texture.wrap_t = pipeline::TextureWrap::clamp_to_edge;
        texture.width = side;
        texture.height = side * layout.bytes / 4;
        for (int y = 0; y < texture.height; ++y)
            for (int x = 0; x < side; ++x) {
                const pipeline::PixelCode t = texel(layout, clear_words[k], mark, x, y);
                texture.texels.insert(texture.texels.end(), t.begin(), t.end());
            }
        place(window, texture, 48.0f + 144.0f * static_cast<float>(k % 4), 128.0f + 144.0f * static_cast<float>(k / 4),
              {});
    }
    return {.image = window.color()};
}

// The chip's clear command ignores the write masks: after drawing under any mask, one clear colour and one clear depth
// remain.
SuitePicture mask_picture(const pipeline::DeviceProfile& profile, bool shows_depth) {
    pipeline::Surface window{profile, {.depth = pipeline::DepthFormat::d16}};
    window.clear_depth(0xffff);
    window.clear_color(unpack(0x7f7f7f7f));
    if (shows_depth) return {.reading = CaptureFormat::depth16, .image = window.depth()};
    return {.image = window.color()};
}

}  // namespace

Drawing draw_clear(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (take(name, "SCF_") || take(name, "SFC_")) {
        for (const ClearedLayout& layout : layouts)
            if (layout.name == name) return {surface_picture(profile, layout), {}};
        return unknown_name;
    }
    const bool shows_depth = take_last(name, "_ZB");
    const bool depth_mask_named = take_last(name, "_Depth_n") || take_last(name, "_Depth_y");
    const auto mask = depth_mask_named && take(name, "C") ? to_hexadecimal(name) : std::nullopt;
    // The mask has one bit per byte, the lowest: a digit other than 0 or 1 is not a name of this suite.
    if (!mask || (*mask & ~0x01010101u) != 0) return unknown_name;
    return {mask_picture(profile, shows_depth), {}};
}

}  // namespace strata::hardware_check
