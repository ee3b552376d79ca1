#include "tools/lab/hardware_check/drawing/blend_patterns.h"

namespace strata::hardware_check {
namespace {

// A field of a word as 8 bits: its bits are repeated from the top down, and the last copy is truncated if 8 is not a
// multiple of them.
std::uint8_t widened(std::uint32_t word, const TexelField& field) {
    if (field.bits == 0) return 255;
    std::uint32_t value = word >> field.shift & ((1u << field.bits) - 1), result = 0;
    for (int filled = 0; filled < 8; filled += field.bits) {
        const int up = 8 - filled - field.bits;
        result |= up >= 0 ? value << up : value >> -up;
    }
    return static_cast<std::uint8_t>(result);
}

// A square texture of `side` texels with the words word(x, y).
pipeline::Texture texture_of(const TexelFormat& format, int side, auto&& word) {
    pipeline::Texture texture;
    texture.target = pipeline::TextureTarget::rectangle;
    texture.width = texture.height = side;
    texture.filter = pipeline::TextureFilter::nearest;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const TexelField& field : format.field) texture.texels.push_back(widened(word(x, y), field));
    return texture;
}

// Truncates. The test's patterns are at least 0.
std::uint32_t cut(float v) { return static_cast<std::uint32_t>(v); }

// 1 at the centre, 0 at the corner.
float nearness(float x, float y, float centre) {
    const float dx = x - centre, dy = y - centre;
    return 1.0f - (dx * dx + dy * dy) / (centre * centre + centre * centre);
}

// A 32-bit word: the two ramps repeat in each quarter of the square; alpha, in the top byte, covers the whole.
std::uint32_t wide_word(int x, int y, int side) {
    const int half = side / 2;
    const auto ramp = [half](int v) { return cut(static_cast<float>(v % half) * 255.0f / static_cast<float>(half)); };
    const float near = nearness(static_cast<float>(x), static_cast<float>(y), static_cast<float>(half));
    return ramp(y) | ramp(x) << 8 | (255 - ramp(y)) << 16 | cut(255.0f * near) << 24;
}

// A 16-bit word of four nibbles, independent of the format: the test fills all 16-bit formats alike.
std::uint32_t narrow_word(int x, int y, int side) {
    const float last = static_cast<float>(side - 1), fx = static_cast<float>(x) / last,
                fy = static_cast<float>(y) / last;
    const float near = nearness(static_cast<float>(x), static_cast<float>(y), last / 2.0f);
    const float rising = 15.0f * fx, falling = 15.0f * (1.0f - fx);
    const std::uint32_t middle = cut(rising * (1.0f - fy) + falling * fy);
    return cut(15.0f * near) << 12 | cut(15.0f * fy) << 8 | middle << 4 | cut(falling);
}

}  // namespace

pipeline::Texture radial_pattern(const TexelFormat& format, int side) {
    return texture_of(format, side,
                      [&](int x, int y) { return format.is_wide ? wide_word(x, y, side) : narrow_word(x, y, side); });
}

pipeline::Texture flat_pattern(const TexelFormat& format, int side, std::uint32_t word) {
    return texture_of(format, side, [word](int, int) { return word; });
}

}  // namespace strata::hardware_check
