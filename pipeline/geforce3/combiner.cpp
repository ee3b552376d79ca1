#include "pipeline/geforce3/combiner.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {
namespace {

using Input = CombinerInput;
using Reg = CombinerRegister;

// In units of 1/255. The chip's half is 128, not 127.5 (chip-fragment.md 9).
constexpr std::int32_t one = 255, half = 128;

[[nodiscard]] constexpr std::int32_t mapped(CombinerMapping mapping, std::int32_t e) noexcept {
    const std::int32_t positive = std::max(e, 0);
    switch (mapping) {
        case CombinerMapping::unsigned_identity: return positive;
        case CombinerMapping::unsigned_invert: return one - std::min(positive, one);
        case CombinerMapping::expand_normal: return 2 * positive - one;
        case CombinerMapping::expand_negate: return one - 2 * positive;
        case CombinerMapping::half_bias_normal: return positive - half;
        case CombinerMapping::half_bias_negate: return half - positive;
        case CombinerMapping::signed_identity: return e;
        case CombinerMapping::signed_negate: return -e;
    }
    return 0;  // unreachable: the enum is closed
}

// A sum of products in units of 1/255^2, to 1/255, to nearest.
[[nodiscard]] constexpr std::int32_t rounded(std::int32_t sum) noexcept {
    return sum >= 0 ? (sum + one / 2) / one : -((-sum + one / 2) / one);
}

// Bias, scale and clamp of a rounded result (combiners.md 2.2).
[[nodiscard]] constexpr std::int32_t scaled(const CombinerPortion& p, std::int32_t x) noexcept {
    if (p.bias == CombinerBias::by_negative_half) x -= half;
    switch (p.scale) {
        case CombinerScale::by_one: break;
        case CombinerScale::by_two: x *= 2; break;
        case CombinerScale::by_four: x *= 4; break;
        case CombinerScale::by_half: x = (x + 1) >> 1; break;  // a half goes up
    }
    return std::clamp(x, -one, one);
}

// Which of the two products a choice takes.
[[nodiscard]] constexpr bool takes_cd(CombinerSum rule, std::int32_t alpha) noexcept {
    return rule == CombinerSum::mux_low_bit ? (alpha & 1) != 0 : alpha >= half;
}

// Colour sum and E F are no registers of general stages, and neither is `discard`.
[[nodiscard]] constexpr bool holds_value(Reg r) noexcept { return static_cast<std::size_t>(r) < combiner_registers; }
[[nodiscard]] constexpr bool is_written(Reg r) noexcept { return r >= Reg::primary_color && r <= Reg::spare1; }

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string{"combiner state: "} + what);
}

// Throws for what NV_register_combiners makes an error: a mistake of the program, never a lack of the device.
void check(const CombinerPortion& p, bool is_alpha) {
    for (const Input& input : {p.a, p.b, p.c, p.d})
        require(holds_value(input.source), "an input of a general stage names no register that it has");
    for (const Reg r : {p.ab, p.cd, p.sum})
        require(r == Reg::discard || is_written(r), "an output names no writable register");
    const bool dots = p.ab_product == CombinerProduct::dot || p.cd_product == CombinerProduct::dot;
    require(!(dots && is_alpha), "alpha portions have no dot product");
    require(!(dots && p.sum != Reg::discard), "a stage with a dot product has no sum");
}

[[nodiscard]] bool is_unsigned(const Input& input) noexcept {
    return input.mapping == CombinerMapping::unsigned_identity || input.mapping == CombinerMapping::unsigned_invert;
}

}  // namespace

// An input as the portion reads it: the channel for output channel c, mapped.
struct CombinerUnit::Operand {
    const Register& reg;
    const Input& input;
    // 3 in an alpha portion, where `own` means alpha; else 0.
    std::size_t own_alpha;

    [[nodiscard]] std::int32_t at(std::size_t c, std::size_t i) const noexcept {
        const std::size_t channel = input.component == CombinerComponent::alpha  ? 3
                                    : input.component == CombinerComponent::blue ? 2
                                    : own_alpha != 0                             ? 3
                                                                                 : c;
        return mapped(input.mapping, reg[channel][i]);
    }
};

CombinerUnit::CombinerUnit(const Combiners& state) : state_{state} {
    require(state.stages.size() <= max_combiner_stages, "at most eight general stages");
    for (const CombinerStage& stage : state.stages) {
        check(stage.rgb, false);
        check(stage.alpha, true);
    }
    const FinalCombiner& f = state.final_stage;
    for (const Input& input : {f.a, f.b, f.c, f.d, f.e, f.f, f.g})
        require(is_unsigned(input) && input.source != Reg::discard, "the final stage takes unsigned inputs");
    for (const Input& input : {f.e, f.f, f.g}) require(holds_value(input.source), "E, F and G take plain registers");
}

const CombinerUnit::Register& CombinerUnit::value_of(Reg r) const noexcept {
    if (r == Reg::spare0_plus_secondary_color) return sum_;
    if (r == Reg::e_times_f) return product_;
    return registers_[static_cast<std::size_t>(r)];
}

void CombinerUnit::load(Reg r, const ColorLanes* color, std::size_t count) {
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < count; ++i) at(r)[c][i] = color == nullptr ? 0 : to_unorm8((*color)[c][i]);
}

void CombinerUnit::set_constants(const std::array<Rgba, 2>& constant, std::size_t count) {
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            std::fill_n(at(k == 0 ? Reg::constant_color0 : Reg::constant_color1)[c].begin(), count,
                        std::int32_t{to_unorm8(constant[k][c])});
}

void CombinerUnit::run_portion(const CombinerPortion& p, bool is_alpha, std::size_t count) {
    const std::size_t first = is_alpha ? 3 : 0, end = is_alpha ? 4 : 3;
    const auto operand = [&](const Input& input) { return Operand{value_of(input.source), input, first}; };
    const Operand a = operand(p.a), b = operand(p.b), c = operand(p.c), d = operand(p.d);
    const auto product = [&](const Operand& x, const Operand& y, CombinerProduct kind, std::size_t ch, std::size_t i) {
        if (kind == CombinerProduct::component_wise) return x.at(ch, i) * y.at(ch, i);
        return x.at(0, i) * y.at(0, i) + x.at(1, i) * y.at(1, i) + x.at(2, i) * y.at(2, i);
    };
    for (std::size_t ch = first; ch < end; ++ch)
        for (std::size_t i = 0; i < count; ++i) {
            // The sum adds the exact products, before either is rounded: one rounding for each of the three results.
            const std::int32_t ab = product(a, b, p.ab_product, ch, i), cd = product(c, d, p.cd_product, ch, i);
            const std::int32_t sum = p.sum_rule == CombinerSum::add                ? ab + cd
                                     : takes_cd(p.sum_rule, at(Reg::spare0)[3][i]) ? cd
                                                                                   : ab;
            result_[0][ch][i] = scaled(p, rounded(ab));
            result_[1][ch][i] = scaled(p, rounded(cd));
            result_[2][ch][i] = scaled(p, rounded(sum));
        }
}

void CombinerUnit::commit(const CombinerPortion& p, bool is_alpha, std::size_t count) {
    const std::array to{p.ab, p.cd, p.sum};
    for (std::size_t k = 0; k < to.size(); ++k)
        for (std::size_t ch = is_alpha ? 3 : 0; to[k] != Reg::discard && ch < (is_alpha ? 4u : 3u); ++ch)
            std::copy_n(result_[k][ch].begin(), count, at(to[k])[ch].begin());
}

// Both portions are computed before either writes: rgb must not show in alpha's inputs.
void CombinerUnit::run_stage(const CombinerStage& stage, std::size_t count) {
    set_constants(stage.constant, count);
    run_portion(stage.rgb, false, count);
    run_portion(stage.alpha, true, count);
    commit(stage.rgb, false, count);
    commit(stage.alpha, true, count);
}

void CombinerUnit::finish(ColorLanes& out, std::size_t count) {
    const FinalCombiner& f = state_.final_stage;
    set_constants(f.constant, count);
    const auto operand = [&](const Input& input) { return Operand{value_of(input.source), input, 0}; };
    const Operand a = operand(f.a), b = operand(f.b), c = operand(f.c), d = operand(f.d), e = operand(f.e),
                  second = operand(f.f);
    const Operand g{value_of(f.g.source), f.g, f.g.component == CombinerComponent::own ? std::size_t{3} : 0};
    for (std::size_t ch = 0; ch < 3; ++ch)
        for (std::size_t i = 0; i < count; ++i) {
            // spare0 may be negative here; the sum takes it as 0 (combiners.md 3).
            const std::int32_t spare0 = std::max(at(Reg::spare0)[ch][i], 0),
                               secondary = at(Reg::secondary_color)[ch][i];
            const std::int32_t sum =
                (f.inverts_spare0 ? one - spare0 : spare0) + (f.inverts_secondary_color ? one - secondary : secondary);
            sum_[ch][i] = f.clamps_color_sum ? std::min(sum, one) : sum;
            product_[ch][i] = rounded(e.at(ch, i) * second.at(ch, i));
        }
    for (std::size_t ch = 0; ch < 3; ++ch)
        for (std::size_t i = 0; i < count; ++i) {
            // Both products are summed exactly and rounded once; D is added behind the rounding.
            const std::int32_t weight = a.at(ch, i);
            const std::int32_t mixed = rounded(weight * b.at(ch, i) + (one - weight) * c.at(ch, i)) + d.at(ch, i);
            out[ch][i] = from_unorm8(static_cast<std::uint8_t>(std::clamp(mixed, 0, one)));
        }
    for (std::size_t i = 0; i < count; ++i)
        out[3][i] = from_unorm8(static_cast<std::uint8_t>(std::clamp(g.at(3, i), 0, one)));
}

// Alpha of spare0 starts as texture 0's alpha, and everything else of the spare registers as 0 (combiners.md 1).
void CombinerUnit::run(const CombinerSources& sources, ColorLanes& out, int count) {
    const auto n = static_cast<std::size_t>(count);
    for (const Reg r : {Reg::zero, Reg::spare0, Reg::spare1}) load(r, nullptr, n);
    load(Reg::primary_color, sources.primary, n);
    load(Reg::secondary_color, sources.secondary, n);
    constexpr std::array textures{Reg::texture0, Reg::texture1, Reg::texture2, Reg::texture3};
    for (std::size_t u = 0; u < textures.size(); ++u) load(textures[u], sources.texture[u], n);
    at(Reg::spare0)[3] = at(Reg::texture0)[3];
    for (const CombinerStage& stage : state_.stages) run_stage(stage, n);
    finish(out, n);
}

}  // namespace strata::pipeline
