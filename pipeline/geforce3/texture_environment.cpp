// pipeline/geforce3/texture_environment.cpp - translates texture environments to register combiners
// (texture_environment.h).
#include "pipeline/geforce3/texture_environment.h"

#include <cassert>

namespace strata::pipeline {
namespace {

using Input = CombinerInput;
using Reg = CombinerRegister;
using Map = CombinerMapping;
using Part = CombinerComponent;

// 1, as the inverted zero register: a product with it is the other factor.
constexpr Input unity{Reg::zero, Map::unsigned_invert};

[[nodiscard]] Reg texture(std::size_t unit) {
    assert(unit < 4 && "four texture units");
    return static_cast<Reg>(static_cast<std::size_t>(Reg::texture0) + unit);
}

// The inputs of one unit's stage: the registers of Cf (the previous stage), Ct (the texture) and Cc. A portion for
// alpha reads the alpha of these registers: Af and At.
struct Sources {
    Reg previous, texture;
    [[nodiscard]] Input f() const { return {previous}; }
    [[nodiscard]] Input t() const { return {texture}; }
    [[nodiscard]] static Input c() { return {Reg::constant_color0}; }
};

[[nodiscard]] Input inverted(Input input) {
    input.mapping = Map::unsigned_invert;
    return input;
}
[[nodiscard]] Input alpha_of(Input input) {
    input.component = Part::alpha;
    return input;
}

// A portion that writes a b + c d to spare0.
[[nodiscard]] CombinerPortion sum_of(Input a, Input b, Input c = {}, Input d = {}) {
    CombinerPortion p;
    p.a = a;
    p.b = b;
    p.c = c;
    p.d = d;
    p.sum = Reg::spare0;
    return p;
}

[[nodiscard]] CombinerPortion color_portion(TexEnvMode mode, const Sources& s) {
    switch (mode) {
        case TexEnvMode::none: return sum_of(s.f(), unity);
        case TexEnvMode::replace: return sum_of(s.t(), unity);
        case TexEnvMode::modulate: return sum_of(s.f(), s.t());
        case TexEnvMode::decal: return sum_of(s.f(), inverted(alpha_of(s.t())), s.t(), alpha_of(s.t()));
        case TexEnvMode::blend: return sum_of(s.f(), inverted(s.t()), Sources::c(), s.t());
        case TexEnvMode::add: return sum_of(s.f(), unity, s.t(), unity);
        case TexEnvMode::combine: break;  // handled by its own state
    }
    return {};
}

[[nodiscard]] CombinerPortion alpha_portion(TexEnvMode mode, const Sources& s) {
    switch (mode) {
        case TexEnvMode::none:
        case TexEnvMode::decal: return sum_of(s.f(), unity);
        case TexEnvMode::replace: return sum_of(s.t(), unity);
        case TexEnvMode::modulate:
        case TexEnvMode::blend:
        case TexEnvMode::add: return sum_of(s.f(), s.t());
        case TexEnvMode::combine: break;  // handled by its own state
    }
    return {};
}

[[nodiscard]] Input argument(const CombineArgument& arg, const Sources& s) {
    Input input;
    switch (arg.source) {
        case CombineSource::texture: input.source = s.texture; break;
        case CombineSource::constant: input.source = Reg::constant_color0; break;
        case CombineSource::primary_color: input.source = Reg::primary_color; break;
        case CombineSource::previous: input.source = s.previous; break;
    }
    switch (arg.operand) {
        case CombineOperand::src_color: break;
        case CombineOperand::one_minus_src_color: input.mapping = Map::unsigned_invert; break;
        case CombineOperand::src_alpha: input.component = Part::alpha; break;
        case CombineOperand::one_minus_src_alpha: return inverted(alpha_of(input));
    }
    return input;
}

[[nodiscard]] CombinerPortion combined(const CombineState& state, const Sources& s) {
    const Input a = argument(state.argument[0], s), b = argument(state.argument[1], s),
                c = argument(state.argument[2], s);
    // 1 - c: the argument with the inverse mapping.
    const Input not_c{c.source, c.mapping == Map::unsigned_invert ? Map::unsigned_identity : Map::unsigned_invert,
                      c.component};
    // 2 * 0 - 1: expand_normal of the zero register.
    constexpr Input minus_one{Reg::zero, Map::expand_normal};
    CombinerPortion p;
    switch (state.func) {
        case CombineFunc::replace: p = sum_of(a, unity); break;
        case CombineFunc::modulate: p = sum_of(a, b); break;
        case CombineFunc::add:
        case CombineFunc::add_signed: p = sum_of(a, unity, b, unity); break;
        case CombineFunc::interpolate: p = sum_of(a, c, b, not_c); break;
        case CombineFunc::subtract: p = sum_of(a, unity, b, minus_one); break;
    }
    if (state.func == CombineFunc::add_signed) p.bias = CombinerBias::by_negative_half;
    p.scale = state.scale;
    return p;
}

}  // namespace

Combiners texture_environment(std::span<const TexEnv> units) {
    Combiners all;
    Reg previous = Reg::primary_color;
    for (std::size_t u = 0; u < units.size(); ++u) {
        if (units[u].mode == TexEnvMode::none) continue;
        const Sources s{previous, texture(u)};
        const bool combines = units[u].mode == TexEnvMode::combine;
        CombinerStage stage;
        stage.rgb = combines ? combined(units[u].rgb, s) : color_portion(units[u].mode, s);
        stage.alpha = combines ? combined(units[u].alpha, s) : alpha_portion(units[u].mode, s);
        stage.constant[0] = units[u].color;
        all.stages.push_back(stage);
        previous = Reg::spare0;
    }
    // The final stage passes the last stage through: A, B and C are zero, so only D remains.
    all.final_stage.d = {previous};
    all.final_stage.g = {previous};
    return all;
}

Combiners peel_combiners(std::size_t unit) {
    CombinerStage stage;
    stage.rgb.a = {texture(unit), Map::unsigned_invert};
    stage.rgb.b = {Reg::primary_color, Map::unsigned_identity, Part::alpha};
    stage.rgb.ab = Reg::spare0;
    Combiners all;
    all.stages = {stage};
    all.final_stage.d = {Reg::primary_color};
    all.final_stage.g = {Reg::spare0, Map::unsigned_identity, Part::blue};
    return all;
}

}  // namespace strata::pipeline
