// Suite Pixel_shader: DotZW, DotST, ClipPlane, Passthru: stages of the texture shader.
// rasterizer/reference/chip-depth.md 6, rasterizer/reference/chip-geometry.md 4.
//
// All are equal except DotZW, which differs by at most 1 unit at no more than 0.25 % of its pixels: the last bits of
// its quotient are not understood. DotZW and DotST sample images that the test loads from its own disk.
#include <cmath>
#include <filesystem>

#include "scenes/files/image_io.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::DeviceProfile;
using pipeline::ShaderOp;
using pipeline::Surface;
using pipeline::Texture;

constexpr pipeline::SurfaceLayout screen{.depth = pipeline::DepthFormat::d16};
constexpr Argb background = 0xff222222;

// Texture coordinates of units 0 to 2 at a corner of a square, in the order upper left, upper right, lower right, lower
// left.
using Units = std::array<Coordinate, 3>;

// A square of `side` pixels at window x, y, to which the fixed-function pipeline adds its offset, with the coordinates
// of three units.
TriangleSoup square(float x, float y, float side, const std::array<Units, 4>& unit, Argb color = 0xffffffff) {
    const float left = x + viewport_offset, top = y + viewport_offset, right = left + side, bottom = top + side;
    const auto corner = [&](std::size_t k, float px, float py) {
        return TexturedCorner{px, py, {unit[k][0], unit[k][1], unit[k][2]}};
    };
    return textured_quad(
        {corner(0, left, top), corner(1, right, top), corner(2, right, bottom), corner(3, left, bottom)}, color);
}

// The large square in the middle.
constexpr int middle_x = 192, middle_y = 112, middle_side = 256;
TriangleSoup middle(const std::array<Units, 4>& unit) { return square(middle_x, middle_y, middle_side, unit); }

// The two rows s, t, r of the matrix at one corner; q is 1.
using Rows = std::array<std::array<float, 3>, 2>;
// The large square. Unit 0 samples the bump map with two pixels per texel; units 1 and 2 have the rows of the matrix
// that its texels are multiplied by.
TriangleSoup bumped(const std::array<Rows, 4>& rows) {
    constexpr float texels = 128;
    constexpr Coordinate texel[4] = {{0, 0, 0, 1}, {texels, 0, 0, 1}, {texels, texels, 0, 1}, {0, texels, 0, 1}};
    std::array<Units, 4> unit;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& [first, second] = rows[k];
        unit[k] = {texel[k], {first[0], first[1], first[2], 1}, {second[0], second[1], second[2], 1}};
    }
    return middle(unit);
}

// Stage 0 samples the bump map, stages 1 and 2 are its dot products with the rows. `last` is the operation of the
// second one.
pipeline::ShaderStages bump_stages(const Texture& bumps, ShaderOp last) {
    pipeline::ShaderStages stages;
    stages[0] = rectangle_lookup({.color = &bumps});
    stages[1].op = ShaderOp::dot_product;
    stages[2].op = last;
    return stages;
}

// Depth is the quotient of the two dot products, z / w, in the buffer's own units. The rows are from
// rasterizer/reference/chip-depth.md 6.
SuitePicture dot_zw(const DeviceProfile& profile, const Texture& bumps) {
    pipeline::FragmentPath path{bump_stages(bumps, ShaderOp::dot_product_depth_replace),
                                show(pipeline::CombinerRegister::texture0, pipeline::CombinerRegister::texture0)};
    Surface surface{profile, screen};
    surface.clear_depth(0xffff);
    surface.draw({.depth = {.enabled = true, .func = pipeline::CompareFunc::always, .write = true}, .path = &path},
                 bumped({{{{{1000, 1000, 1000}, {0.1f, 0.1f, 0.1f}}},
                          {{{100, 100, 40000}, {1, 1, 0}}},
                          {{{10, 100, 1000}, {1, 0, 0}}},
                          {{{100, 100, 100}, {0, 0, 1}}}}}));
    constexpr int right = middle_x + middle_side, bottom = middle_y + middle_side;
    // The capture contains the depth buffer only inside the square; nothing is compared around it. 0.25 % of its words
    // may differ by one unit: 104 do, by the last bits of the quotient.
    return {.reading = CaptureFormat::depth16,
            .image = surface.depth(),
            .hidden = {{0, 0, picture_width, middle_y},
                       {0, middle_y, middle_x, bottom},
                       {right, middle_y, picture_width, bottom},
                       {0, bottom, picture_width, picture_height}},
            .bound = {middle_side * middle_side / 400, 1}};
}

using Vector = std::array<double, 3>;
// The unit vector from one point to another, computed in binary64 and then rounded to binary32.
// std::sqrt is correctly rounded.
std::array<float, 3> direction(const Vector& from, const Vector& to) {
    const double x = to[0] - from[0], y = to[1] - from[1], z = to[2] - from[2],
                 length = std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

// The two dot products are the coordinates of a lookup: rows are the directions from the eye to a point and from it to
// a light (rasterizer/reference/chip-geometry.md 4.1). `image` is 128 x 128 texels, addressed from 0 to 1.
SuitePicture dot_st(const DeviceProfile& profile, const Texture& bumps, Texture image) {
    // The suite's images are loaded as rectangles; this stage takes coordinates from 0 to 1.
    image.target = pipeline::TextureTarget::two_d;
    pipeline::FragmentPath path{bump_stages(bumps, ShaderOp::dot_product_texture_2d),
                                show(pipeline::CombinerRegister::texture2, pipeline::CombinerRegister::texture2)};
    path.shader[2].texture.color = &image;
    constexpr Vector eye{0, 0, -7}, light{-1.5, 5, 0}, at[4] = {{-1, 1, 4}, {1, 1, 7}, {1, -2, 6}, {-1, -2, 4}};
    std::array<Rows, 4> rows;
    for (std::size_t k = 0; k < 4; ++k) rows[k] = {direction(eye, at[k]), direction(at[k], light)};
    Surface surface{profile, screen};
    surface.clear_color(unpack(background));
    surface.draw({.blend = pipeline::blend_mode::over, .path = &path}, bumped(rows));
    return {.image = surface.color()};
}

// s, t, r, q of the units 0, 1 and 2 at the four corners (rasterizer/reference/chip-geometry.md 4.2).
constexpr std::array<Units, 4> planes{
    {{{{0, 0.1f, -0.02f, -0.25f}, {-0.1f, -0.1f, 0.02f, 0.25f}, {-0.1f, -0.1f, -0.1f, 0.1f}}},
     {{{1, -0.3f, 1, 0}, {0.1f, 0.3f, -0.2f, -0.01f}, {0.1f, -0.1f, -0.1f, -0.1f}}},
     {{{-1, -0.1f, -0.1f, 0.5f}, {1, 0.1f, 0.1f, -0.25f}, {-0.1f, 0.1f, -0.1f, -0.1f}}},
     {{{-0.1f, 2, 3, 0.25f}, {0.1f, -0.6f, 1.1f, -0.35f}, {-0.1f, -0.1f, 0.1f, -0.1f}}}}};

// A dark square, and over it three draws, each culled by one unit. Bits 3 to 0 of `flags` are s, t, r, q. If a bit is
// set, a fragment is discarded if that coordinate is not negative; if it is clear, if it is negative.
void draw_culled(Surface& surface, float x, float y, unsigned flags) {
    constexpr float side = 64;
    constexpr Argb dark = 0xff333333, colors[] = {0xffdd447f, 0xff44dd6e, 0xff5566ee};
    pipeline::FragmentPath path{{}, show(pipeline::CombinerRegister::primary_color, pipeline::CombinerRegister::zero)};
    surface.draw({.path = &path}, square(x, y, side, planes, dark));
    for (std::size_t unit = 0; unit < 3; ++unit) {
        path.shader = {};
        path.shader[unit].op = ShaderOp::cull_fragment;
        for (std::size_t c = 0; c < 4; ++c)
            // CullMode is the comparison with 0 that keeps a fragment: `less` keeps the negative side.
            path.shader[unit].cull[c] =
                (flags >> (3 - c) & 1u) != 0 ? pipeline::CullMode::less : pipeline::CullMode::gequal;
        surface.draw({.path = &path}, square(x, y, side, planes, colors[unit]));
    }
}

// All sixteen combinations of flags, seven squares per row.
SuitePicture clip_plane(const DeviceProfile& profile) {
    Surface surface{profile, screen};
    surface.clear_color(unpack(0xff000000));
    for (unsigned k = 0; k < 16; ++k)
        draw_culled(surface, 32.0f + 80.0f * static_cast<float>(k % 7), 208.0f + 96.0f * static_cast<float>(k / 7), k);
    return {.image = surface.color()};
}

// Coordinates shown as colours: each is truncated to 8 bits, not rounded.
SuitePicture pass_through(const DeviceProfile& profile) {
    pipeline::FragmentPath path{{}, show(pipeline::CombinerRegister::texture0, pipeline::CombinerRegister::texture0)};
    path.shader[0].op = ShaderOp::pass_through;
    Surface surface{profile, screen};
    surface.clear_color(unpack(background));
    surface.draw({.blend = pipeline::blend_mode::over, .path = &path},
                 middle({{{{{0, 0, 1, 0.25f}}}, {{{0, 1, 0, 0.5f}}}, {{{1, 0, 0, 0.75f}}}, {{{1, 1, 0.4f, 0.33f}}}}}));
    return {.image = surface.color()};
}

// The image of that name in the folder `textures`, as a rectangle texture addressed in texels; empty if there is no
// such file. Throws InputError if the file is not an image.
std::optional<Texture> load(const std::string& textures, const std::string& name) {
    const std::string path = (std::filesystem::path(textures) / (name + ".png")).string();
    if (textures.empty() || !std::filesystem::exists(path)) return std::nullopt;
    return as_texture(scenes::read_images(path).front().image);
}
// The picture is then not modelled, and the reason names the missing file.
Drawing needs(const std::string& name) {
    return {std::nullopt, "needs textures/" + name + ".png, which the test loads"};
}

}  // namespace

Drawing draw_pixel_shader_with(std::string_view name, const DeviceProfile& profile, const std::string& textures) {
    if (name == "ClipPlane") return {clip_plane(profile), {}};
    if (name == "Passthru") return {pass_through(profile), {}};
    for (const std::string_view bumped :
         {"BumpEnvMap", "BumpEnvMapLuminance", "StageDependentAlphaRed", "StageDependentGreenBlue"})
        if (name == bumped) return {std::nullopt, "its texture shader operation is not described"};
    if (name != "DotZW" && name != "DotST") return unknown_name;
    const std::string bump_name = "water_bump_map", image_name = "bump_map_test_image";
    const auto bumps = load(textures, bump_name);
    if (!bumps) return needs(bump_name);
    if (name == "DotZW") return {dot_zw(profile, *bumps), {}};
    const auto image = load(textures, image_name);
    return image ? Drawing{dot_st(profile, *bumps, *image), {}} : needs(image_name);
}

Drawing draw_pixel_shader(std::string_view name, const DeviceProfile& profile) {
    return draw_pixel_shader_with(name, profile, {});
}

}  // namespace strata::hardware_check
