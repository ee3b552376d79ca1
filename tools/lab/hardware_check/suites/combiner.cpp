// Suite Combiner: CombinerOps, Flags, Mux, SpecialInputs: register combiners on flat quads.
// pipeline/reference/chip-fragment.md 9. All pictures are equal; the checkerboard behind two of them tests texture
// coordinates that are integers in exact arithmetic.
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/suite.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace strata::hardware_check {
namespace {

using pipeline::CombinerComponent;
using pipeline::CombinerInput;
using pipeline::CombinerMapping;
using pipeline::CombinerPortion;
using pipeline::Combiners;
using pipeline::FinalCombiner;
using pipeline::Surface;
using Reg = pipeline::CombinerRegister;

constexpr pipeline::DrawState over{.blend = pipeline::blend_mode::over};
// 255 - 0: the constant 1 of a stage's inputs.
constexpr CombinerInput one{.source = Reg::zero, .mapping = CombinerMapping::unsigned_invert};
constexpr CombinerInput constant0{.source = Reg::constant_color0}, constant1{.source = Reg::constant_color1};
// An input's blue, for an alpha portion (pipeline/reference/combiners.md 2.1).
constexpr CombinerInput blue(CombinerInput input) {
    input.component = CombinerComponent::blue;
    return input;
}

// Values of 8-bit codes, 0 to 255, for the combiners' constants: they are converted back to the same codes.
Rgba codes(int r, int g, int b, int a) {
    const auto value = [](int code) { return static_cast<float>(code) / 255.0f; };
    return {value(r), value(g), value(b), value(a)};
}

// Draws the soup with these combiners: no texture shader, blending OVER.
void draw(Surface& surface, const Combiners& combiners, const TriangleSoup& soup) {
    const pipeline::FragmentPath path{{}, combiners};
    pipeline::DrawState state = over;
    state.path = &path;
    surface.draw(state, soup);
}

// A white rectangle at window x, y in pixels, upper left corner first. The fixed-function pipeline adds its viewport
// offset.
TriangleSoup rectangle(float x, float y, float width, float height) {
    const float left = x + viewport_offset, top = y + viewport_offset;
    return box({left, top, left + width, top + height}, 0xffffffff);
}

// The checkerboard behind CombinerOps and SpecialInputs: a cell covers 20 x 15 pixels.
void draw_greys(Surface& surface) { draw_checkerboard(surface, 8, 0xff333333, 0xff444444); }

// Quad `number`, 0 to 5, of the test's grid of world points: four in the upper row, two in the
// lower one.
TriangleSoup world_quad(int number) {
    // World units. The lower row is a quad and four gaps further down.
    constexpr double width = 1.3, height = 3.4 / 3.0, gap = 0.1, z = 1;
    const double left = -2.75 + (width + gap) * (number % 4), top = 1.75 - (height + 4 * gap) * (number / 4);
    const auto corner = [&](double x, double y) {
        ClipVertex v = project(x, y, z, 1, {1, 1, 1, 1});
        v.x += viewport_offset;
        v.y += viewport_offset;
        return v;
    };
    TriangleSoup soup;
    add_quad(soup, {corner(left, top), corner(left + width, top), corner(left + width, top - height),
                    corner(left, top - height)});
    return soup;
}

// The clear colour of Mux and Flags.
constexpr Argb dark = 0xff303030;

// The selector is spare 0's alpha: its lowest bit, or its highest. Unset, the sum is AB, red; set, it is CD, blue. The
// alphas 82, 81 and 0 give both results in each mode (pipeline/reference/chip-fragment.md 9).
SuitePicture mux(const pipeline::DeviceProfile& profile) {
    struct Case {
        int alpha;
        pipeline::CombinerSum rule;
    };
    using pipeline::CombinerSum;
    constexpr Case cases[] = {{0x82, CombinerSum::mux_low_bit}, {0x82, CombinerSum::mux},
                              {0x81, CombinerSum::mux_low_bit}, {0x81, CombinerSum::mux},
                              {0, CombinerSum::mux_low_bit},    {0, CombinerSum::mux}};
    Surface surface{profile, {}};
    surface.clear_color(unpack(dark));
    for (int k = 0; k < 6; ++k) {
        Combiners combiners = show(Reg::primary_color, Reg::primary_color);
        combiners.stages.resize(2);
        combiners.stages[0].constant[0] = codes(0, 0, 0, cases[k].alpha);
        combiners.stages[0].alpha = {.a = constant0, .b = one, .ab = Reg::spare0};
        combiners.stages[1].constant = {codes(255, 0, 0, 255), codes(0, 0, 255, 255)};
        combiners.stages[1].rgb = {
            .a = constant0, .b = one, .c = constant1, .d = one, .sum = Reg::primary_color, .sum_rule = cases[k].rule};
        combiners.stages[1].alpha = {.a = one, .b = one, .ab = Reg::primary_color};
        draw(surface, combiners, world_quad(k));
    }
    return {.image = surface.color()};
}

// Combiners of one general stage with this rgb portion and constant 0, and of the final stage.
Combiners sum_of(const CombinerPortion& rgb, const Rgba& constant, const FinalCombiner& final_stage) {
    Combiners combiners;
    combiners.stages.resize(1);
    combiners.stages[0].rgb = rgb;
    combiners.stages[0].constant[0] = constant;
    combiners.final_stage = final_stage;
    return combiners;
}

// Six quads: the final stage's sum of spare 0 and secondary colour without a flag, clamped, and with either operand
// inverted. The first two are halved, because only half of a sum above 255 shows whether it was clamped: 127 * 510 /
// 255 is 254, not 127.
SuitePicture flags(const pipeline::DeviceProfile& profile) {
    const Rgba half = codes(127, 127, 127, 127), most = codes(191, 191, 191, 191);
    const CombinerPortion both{.a = one, .b = one, .c = one, .d = one, .ab = Reg::secondary_color, .cd = Reg::spare0};
    const CombinerPortion to_spare0{.c = constant0, .d = one, .ab = Reg::secondary_color, .cd = Reg::spare0};
    const CombinerPortion to_secondary{.c = constant0, .d = one, .ab = Reg::spare0, .cd = Reg::secondary_color};
    const CombinerInput sum{.source = Reg::spare0_plus_secondary_color};
    const FinalCombiner halved{.a = constant0, .b = sum, .g = one, .constant = {half}},
        whole{.a = one, .b = sum, .g = one};
    FinalCombiner clamped = halved, inverts_spare0 = whole, inverts_secondary = whole;
    clamped.clamps_color_sum = true;
    inverts_spare0.inverts_spare0 = true;
    inverts_secondary.inverts_secondary_color = true;
    const Combiners all[] = {sum_of(both, most, halved),        sum_of(both, most, clamped),
                             sum_of(to_spare0, most, whole),    sum_of(to_spare0, most, inverts_spare0),
                             sum_of(to_secondary, most, whole), sum_of(to_secondary, most, inverts_secondary)};
    Surface surface{profile, {}};
    surface.clear_color(unpack(dark));
    for (int k = 0; k < 6; ++k) draw(surface, all[k], world_quad(k));
    return {.image = surface.color()};
}

// Pixels: the positions of the squares of CombinerOps and SpecialInputs.
constexpr float quad_side = 64, quad_top = 74, quad_step = 72, left_column = 200, right_column = 500;

// Each pair of bias and scale on the constant (25, 63, 255, 127). The left half of a square is opaque, the right half
// shows alpha, which the alpha portion computes from the constant's blue.
SuitePicture combiner_ops(const pipeline::DeviceProfile& profile) {
    using pipeline::CombinerBias;
    using pipeline::CombinerScale;
    struct Operation {
        CombinerBias bias;
        CombinerScale scale;
    };
    constexpr Operation operations[] = {
        {CombinerBias::none, CombinerScale::by_one},  {CombinerBias::by_negative_half, CombinerScale::by_one},
        {CombinerBias::none, CombinerScale::by_two},  {CombinerBias::by_negative_half, CombinerScale::by_two},
        {CombinerBias::none, CombinerScale::by_four}, {CombinerBias::none, CombinerScale::by_half}};
    Surface surface{profile, {}};
    draw_greys(surface);
    for (int k = 0; k < 6; ++k) {
        const auto [bias, scale] = operations[k];
        const CombinerPortion rgb{.a = constant0, .b = one, .ab = Reg::spare0, .scale = scale, .bias = bias};
        CombinerPortion alpha = rgb;
        alpha.a = blue(constant0);
        // Five squares in the left column, the sixth at the top of the right one.
        const float x = k < 5 ? left_column : right_column, y = quad_top + quad_step * static_cast<float>(k % 5);
        for (const bool opaque : {true, false}) {
            Combiners combiners = show(Reg::spare0, opaque ? Reg::zero : Reg::spare0);
            combiners.stages.push_back({.rgb = rgb, .alpha = alpha, .constant = {codes(25, 63, 255, 127)}});
            draw(surface, combiners, rectangle(opaque ? x : x + quad_side / 2, y, quad_side / 2, quad_side));
        }
    }
    return {.image = surface.color()};
}

// Four squares: the final stage's product of E and F; its sum of spare 0 and secondary colour; the same with either
// inverted. No flag clamps a sum; the final result is clamped to 0..255 in any case.
SuitePicture special_inputs(const pipeline::DeviceProfile& profile) {
    Combiners product;
    product.final_stage = {.d = {.source = Reg::e_times_f},
                           .e = constant0,
                           .f = constant1,
                           .g = one,
                           .constant = {codes(255, 191, 127, 255), codes(127, 127, 127, 127)}};
    Combiners sum = product;
    sum.final_stage.d = {.source = Reg::spare0_plus_secondary_color};
    sum.stages.resize(1);
    sum.stages[0].rgb = {
        .a = constant0, .b = one, .c = constant1, .d = one, .ab = Reg::spare0, .cd = Reg::secondary_color};
    sum.stages[0].constant = {codes(63, 127, 191, 0), codes(178, 127, 38, 127)};
    Combiners inverts_spare0 = sum, inverts_secondary = sum;
    inverts_spare0.final_stage.inverts_spare0 = true;
    inverts_secondary.final_stage.inverts_secondary_color = true;
    constexpr float second = quad_top + quad_step + 24;
    Surface surface{profile, {}};
    draw_greys(surface);
    draw(surface, product, rectangle(left_column, quad_top, quad_side, quad_side));
    draw(surface, sum, rectangle(left_column, second, quad_side, quad_side));
    draw(surface, inverts_spare0, rectangle(right_column, second, quad_side, quad_side));
    draw(surface, inverts_secondary, rectangle(left_column, second + quad_step, quad_side, quad_side));
    return {.image = surface.color()};
}

}  // namespace

Drawing draw_combiner(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (name == "CombinerOps") return {combiner_ops(profile), {}};
    if (name == "Flags") return {flags(profile), {}};
    if (name == "Mux") return {mux(profile), {}};
    if (name == "SpecialInputs") return {special_inputs(profile), {}};
    // Names of the suite whose scenes pipeline/reference/chip-fragment.md 9 does not describe.
    for (const std::string_view known : {"AlphaFromBlue", "ColorAlphaIndependence", "Independence", "SignedCombinerOps",
                                         "SignedPassThroughPipeline", "SignedToUnsignedMapping", "UnboundTexSampler"})
        if (name == known) return {std::nullopt, "what it draws is not described"};
    return unknown_name;
}

}  // namespace strata::hardware_check
