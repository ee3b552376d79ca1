#include "tools/lab/hardware_check/drawing/textured.h"

#include "tools/lab/hardware_check/drawing/picture.h"

namespace strata::hardware_check {

TriangleSoup textured_quad(const std::array<TexturedCorner, 4>& corner, Argb color) {
    TriangleSoup soup;
    // Four floats per unit, for all units, whether a test uses them or not.
    soup.extras.stride = 4 * rasterizer::texture_units;
    soup.extras.has_units = true;
    const auto add = [&](std::size_t k) {
        for (const Coordinate& unit : corner[k].unit)
            soup.extras.values.insert(soup.extras.values.end(), unit.begin(), unit.end());
        return at(corner[k].x, corner[k].y, color);
    };
    // Values are appended vertex by vertex and must be in the order in which add_triangle() numbers the vertices.
    for (const std::array<std::size_t, 3>& triangle : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        const ClipVertex a = add(triangle[0]), b = add(triangle[1]), c = add(triangle[2]);
        add_triangle(soup, a, b, c);
    }
    return soup;
}

pipeline::Combiners show(pipeline::CombinerRegister color, pipeline::CombinerRegister alpha) {
    using pipeline::CombinerMapping;
    // The alpha of `zero` would be 0; inverted it is 1.
    const bool is_one = alpha == pipeline::CombinerRegister::zero;
    pipeline::Combiners combiners;
    combiners.final_stage.d = {.source = color};
    combiners.final_stage.g = {
        .source = alpha, .mapping = is_one ? CombinerMapping::unsigned_invert : CombinerMapping::unsigned_identity};
    return combiners;
}

pipeline::Texture checker(int texels, int cell, Argb first, Argb second) {
    pipeline::Image image{pipeline::Format::rgba8, texels, texels};
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const pipeline::PixelCode code = unpack((x / cell + y / cell) % 2 == 0 ? first : second);
            for (int c = 0; c < 4; ++c) image.codes[image.index(x, y, c)] = code[static_cast<std::size_t>(c)];
        }
    return as_texture(image);
}

void draw_checkerboard(pipeline::Surface& surface, int cell, Argb first, Argb second, float offset) {
    constexpr int texels = 256;
    pipeline::Texture board = checker(texels, cell, first, second);
    TriangleSoup soup = box({offset, offset, offset + picture_width, offset + picture_height}, 0xffffffff);
    // The offset moves the corners, so the comparison with 1 distinguishes the left and upper sides from the others.
    for (ClipVertex& v : soup.vertices) v.texcoord = {v.x < 1 ? 0.0f : float{texels}, v.y < 1 ? 0.0f : float{texels}};
    pipeline::DrawState state{.blend = pipeline::blend_mode::over};
    state.texture = &board;
    surface.draw(state, std::move(soup));
}

pipeline::ShaderStage rectangle_lookup(const pipeline::BoundTexture& texture) {
    pipeline::ShaderStage stage;
    stage.op = pipeline::ShaderOp::texture_rectangle;
    stage.texture = texture;
    return stage;
}

}  // namespace strata::hardware_check
