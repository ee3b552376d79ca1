// Tests each function of the texture environment against its formula in rational arithmetic, rounded once to 8 bits.
#include "pipeline/geforce3/texture_environment.h"

#include <catch2/catch.hpp>
#include <memory>

#include "tests/pipeline/addressing_model.h"

using namespace strata::pipeline;
using model::Rational;

namespace {

using Color = std::array<int, 4>;
struct Inputs {
    Color f, t, c;  // fragment, texture, environment colour
};

Color run(const Combiners& state, std::size_t unit, const Inputs& in) {
    const auto lanes = std::make_unique<std::array<ColorLanes, 3>>();
    for (std::size_t k = 0; k < 4; ++k) {
        (*lanes)[0][k][0] = static_cast<float>(in.f[k]) / 255.0f;
        (*lanes)[1][k][0] = static_cast<float>(in.t[k]) / 255.0f;
    }
    CombinerSources sources{.primary = &(*lanes)[0]};
    sources.texture[unit] = &(*lanes)[1];
    const auto combiners = std::make_unique<CombinerUnit>(state);
    combiners->run(sources, (*lanes)[2], 1);
    Color out;
    for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<int>((*lanes)[2][k][0] * 255.0f + 0.5f);
    return out;
}

int code(const Rational& x) {
    const Rational clamped = x < 0 ? Rational{0} : x > 1 ? Rational{1} : x;
    return static_cast<int>(model::floor(clamped * 255 + Rational{1, 2}));
}

Rational part(const Color& c, std::size_t k) { return Rational{c[k], 255}; }

Color formula(TexEnvMode mode, const Inputs& in) {
    Color out;
    for (std::size_t k = 0; k < 4; ++k) {
        const Rational f = part(in.f, k), t = part(in.t, k), c = part(in.c, k), at = part(in.t, 3);
        Rational v = f;
        if (mode == TexEnvMode::replace) v = t;
        if (mode == TexEnvMode::modulate || (k == 3 && (mode == TexEnvMode::blend || mode == TexEnvMode::add)))
            v = f * t;
        if (mode == TexEnvMode::decal && k < 3) v = f * (1 - at) + t * at;
        if (mode == TexEnvMode::blend && k < 3) v = f * (1 - t) + c * t;
        if (mode == TexEnvMode::add && k < 3) v = f + t;
        out[k] = code(v);
    }
    return out;
}

Color any_color(Random& random) { return {any_byte(random), any_byte(random), any_byte(random), any_byte(random)}; }
strata::Rgba floats(const Color& c) {
    strata::Rgba out;
    for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<float>(c[k]) / 255.0f;
    return out;
}

Rational value(const CombineArgument& arg, const Inputs& in, std::size_t k) {
    const Color& source = arg.source == CombineSource::texture    ? in.t
                          : arg.source == CombineSource::constant ? in.c
                                                                  : in.f;
    const bool alpha = arg.operand == CombineOperand::src_alpha || arg.operand == CombineOperand::one_minus_src_alpha;
    const bool inverse =
        arg.operand == CombineOperand::one_minus_src_color || arg.operand == CombineOperand::one_minus_src_alpha;
    const Rational x = part(source, alpha ? 3 : k);
    return inverse ? Rational{1 - x} : x;
}

int combined(const CombineState& s, const Inputs& in, std::size_t k) {
    const Rational a = value(s.argument[0], in, k), b = value(s.argument[1], in, k), c = value(s.argument[2], in, k);
    Rational v = a;
    if (s.func == CombineFunc::modulate) v = a * b;
    if (s.func == CombineFunc::add || s.func == CombineFunc::add_signed) v = a + b;
    if (s.func == CombineFunc::interpolate) v = a * c + b * (1 - c);
    if (s.func == CombineFunc::subtract) v = a - b;
    // A product is rounded before bias and scale; 1/2 is 128/255 on this chip.
    Rational stored =
        Rational{model::floor((v < 0 ? Rational{-v} : v) * 255 + Rational{1, 2})} / 255 * (v < 0 ? -1 : 1);
    if (s.func == CombineFunc::add_signed) stored -= Rational{128, 255};
    return code(stored * (s.scale == CombinerScale::by_two ? 2 : s.scale == CombinerScale::by_four ? 4 : 1));
}

CombineState any_combine(Random& random, bool alpha) {
    CombineState s{any_of(random, CombineFunc::subtract), {}, any_of(random, CombinerScale::by_four)};
    for (CombineArgument& arg : s.argument) {
        arg.source = any_of(random, CombineSource::previous);
        arg.operand = any_of(random, CombineOperand::one_minus_src_alpha);
        if (alpha) arg.operand = one_in(random, 2) ? CombineOperand::src_alpha : CombineOperand::one_minus_src_alpha;
    }
    return s;
}

}  // namespace

TEST_CASE("every mode of the texture environment gives its formula rounded once to 8 bits") {
    Random random{331};
    Tally tally;
    for (int round = 0; round < 4000; ++round) {
        const auto mode = static_cast<TexEnvMode>(below(random, 6));
        const std::size_t unit = below(random, 4);
        const Inputs in{any_color(random), any_color(random), any_color(random)};
        std::array<TexEnv, 4> env{};
        env[unit] = {.mode = mode, .color = floats(in.c), .rgb = {}, .alpha = {}};
        const Color found = run(texture_environment(env), unit, in), expected = formula(mode, in);
        tally.expect(found == expected,
                     [&] { return fmt::format("mode {} in unit {}", static_cast<int>(mode), unit); });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("COMBINE gives its formulas with any argument and operand and scale", "[slow]") {
    Random random{332};
    Tally tally;
    for (int round = 0; round < 4000; ++round) {
        const Inputs in{any_color(random), any_color(random), any_color(random)};
        TexEnv env{.mode = TexEnvMode::combine,
                   .color = floats(in.c),
                   .rgb = any_combine(random, false),
                   .alpha = any_combine(random, true)};
        const Color found = run(texture_environment(std::span{&env, 1}), 0, in);
        Color expected;
        for (std::size_t k = 0; k < 4; ++k) expected[k] = combined(k < 3 ? env.rgb : env.alpha, in, k);
        tally.expect(found == expected,
                     [&] { return fmt::format("round {}: rgb func {}", round, static_cast<int>(env.rgb.func)); });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("a further unit continues from the clamped result of the previous one") {
    std::array<TexEnv, 2> env{};
    env[0].mode = TexEnvMode::add;
    env[1].mode = TexEnvMode::modulate;
    const Inputs in{{200, 100, 0, 255}, {200, 100, 9, 255}, {}};
    const auto state = texture_environment(env);
    CHECK(state.stages.size() == 2);
    CHECK(run(state, 0, in) == Color{0, 0, 0, 0});  // texture 1 is absent: 0
    CHECK(run(texture_environment({}), 0, in) == in.f);
}

TEST_CASE("the peel combiner keeps the colour and copies the comparison into alpha") {
    Random random{333};
    std::size_t wrong = 0;
    for (int round = 0; round < 500; ++round) {
        const bool in_shadow_map = one_in(random, 2);
        const int lit = in_shadow_map ? 255 : 0;
        const Inputs in{any_color(random), {lit, lit, lit, 255}, {}};
        Color expected = in.f;
        if (in_shadow_map) expected[3] = 0;
        wrong += run(peel_combiners(3), 3, in) != expected ? 1 : 0;
    }
    CHECK(wrong == 0);
}
