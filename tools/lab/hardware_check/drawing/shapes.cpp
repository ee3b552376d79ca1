#include "tools/lab/hardware_check/drawing/shapes.h"

#include <bit>
#include <cmath>

namespace strata::hardware_check {

// AARRGGBB to r g b a.
pipeline::PixelCode unpack(Argb c) {
    const auto byte = [c](int shift) { return static_cast<std::uint8_t>(c >> shift & 0xff); };
    return {byte(16), byte(8), byte(0), byte(24)};
}

std::array<float, 4> to_float(Argb color) {
    std::array<float, 4> result{};
    const pipeline::PixelCode codes = unpack(color);
    for (std::size_t c = 0; c < 4; ++c) result[c] = static_cast<float>(codes[c]) / 255.0f;
    return result;
}

ClipVertex at(float x, float y, float z, const std::array<float, 4>& color, float w) {
    return {.x = x, .y = y, .z = z, .w = w, .front = color, .back = color};
}

void add_triangle(TriangleSoup& soup, const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c});
    soup.indices.insert(soup.indices.end(), {first, first + 1, first + 2});
}

void add_quad(TriangleSoup& soup, const std::array<ClipVertex, 4>& corner) {
    add_triangle(soup, corner[0], corner[1], corner[2]);
    add_triangle(soup, corner[0], corner[2], corner[3]);
}

void add_box(TriangleSoup& soup, const Box& b, Argb color, float z) {
    const std::array<float, 4> c = to_float(color);
    add_quad(soup, {at(b.left, b.top, z, c), at(b.right, b.top, z, c), at(b.right, b.bottom, z, c),
                    at(b.left, b.bottom, z, c)});
}

TriangleSoup box(const Box& where, Argb color, float z) {
    TriangleSoup soup;
    add_box(soup, where, color, z);
    return soup;
}

pipeline::Texture as_texture(const pipeline::Image& image) {
    pipeline::Texture texture;
    texture.target = pipeline::TextureTarget::rectangle;
    texture.width = image.width;
    texture.height = image.height;
    texture.filter = pipeline::TextureFilter::nearest;
    texture.wrap_s = texture.wrap_t = pipeline::TextureWrap::clamp_to_edge;
    texture.texels.assign(image.codes.begin(), image.codes.end());
    return texture;
}

void place(pipeline::Surface& surface, const pipeline::Texture& image, float x, float y, pipeline::DrawState state) {
    const float width = static_cast<float>(image.width), height = static_cast<float>(image.height);
    TriangleSoup soup = box({x, y, x + width, y + height}, 0xffffffff);
    // Texel (0, 0) is at the rectangle's upper left corner, so every pixel centre is at a texel's centre if x and y are
    // integers.
    for (ClipVertex& v : soup.vertices) v.texcoord = {v.x - x, v.y - y};
    state.texture = &image;
    static_cast<void>(surface.draw(state, std::move(soup)));
}

void limit_depth(pipeline::DrawState& state, double least, double greatest, double units) {
    state.depth_near = static_cast<float>(least / units);
    if (double{state.depth_near} * units > least) state.depth_near = next_below(state.depth_near);
    state.depth_far = static_cast<float>(greatest / units);
    if (double{state.depth_far} * units < greatest) state.depth_far = std::nextafter(state.depth_far, 2.0f);
}

float next_below(float positive) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(positive) - 1); }

}  // namespace strata::hardware_check
