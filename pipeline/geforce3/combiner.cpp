// pipeline/geforce3/combiner.cpp - runs the stages of register combiners over a batch, and rejects invalid state
// (combiner.h).
#include "pipeline/geforce3/combiner.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pipeline/formats/unorm8.h"
#include "pipeline/geforce3/combiner_loops.h"

namespace strata::pipeline {
namespace {

using Input = CombinerInput;
using Reg = CombinerRegister;

constexpr std::int32_t one = combiner_one;

// Bias, scale and clamp of a rounded result (pipeline/reference/combiners.md 2.2).
[[nodiscard]] CombinerScaling scaling_of(const CombinerPortion& p) noexcept {
    const std::int32_t bias = p.bias == CombinerBias::by_negative_half ? combiner_half : 0;
    switch (p.scale) {
        case CombinerScale::by_one: return {bias, 0, 0};
        case CombinerScale::by_two: return {bias, 1, 0};
        case CombinerScale::by_four: return {bias, 2, 0};
        case CombinerScale::by_half: break;
    }
    return {bias, 0, 1};
}

// True if the choice selects C D.
[[nodiscard]] constexpr bool takes_cd(CombinerSum rule, std::int32_t alpha) noexcept {
    return rule == CombinerSum::mux_low_bit ? (alpha & 1) != 0 : alpha >= combiner_half;
}

// True for registers with a value: not colour sum, E F or `discard`, which general stages cannot read.
[[nodiscard]] constexpr bool holds_value(Reg r) noexcept { return static_cast<std::size_t>(r) < combiner_registers; }
[[nodiscard]] constexpr bool is_written(Reg r) noexcept { return r >= Reg::primary_color && r <= Reg::spare1; }

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string{"combiner state: "} + what);
}

// Throws for state that is an error in NV_register_combiners: a programming error, not a missing feature of the device.
void check(const CombinerPortion& p, bool is_alpha) {
    for (const Input& input : {p.a, p.b, p.c, p.d})
        require(holds_value(input.source), "an input of a general stage names no register that it has");
    for (const Input& input : {p.a, p.b, p.c, p.d})
        require(input.source != Reg::fog || !(is_alpha ? input.component != CombinerComponent::blue
                                                       : input.component == CombinerComponent::alpha),
                "only the final stage reads the fog factor");
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

// In an alpha portion, as for G, `own` means alpha.
CombinerOperand CombinerUnit::operand(const Input& input, bool is_alpha) const noexcept {
    const Register& reg = value_of(input.source);
    CombinerOperand operand{{}, map_of(input.mapping)};
    for (std::size_t c = 0; c < 4; ++c) {
        const bool is_own = input.component == CombinerComponent::own;
        const std::size_t own = is_alpha ? 3 : c;
        operand.channel[c] = reg[is_own ? own : input.component == CombinerComponent::blue ? 2 : 3].data();
    }
    return operand;
}

void CombinerUnit::load(Reg r, const ColorLanes* color, std::size_t count) {
    for (std::size_t c = 0; c < 4; ++c)
        if (color == nullptr)
            std::fill_n(at(r)[c].begin(), count, 0);
        else
            combiner_loops().load((*color)[c].data(), at(r)[c].data(), count);
}

void CombinerUnit::load_fog(const CombinerSources& sources, std::size_t count) {
    load(Reg::fog, nullptr, count);
    if (sources.fog_factor == nullptr) return;
    for (std::size_t c = 0; c < 3; ++c)
        std::fill_n(at(Reg::fog)[c].begin(), count, std::int32_t{to_unorm8(sources.fog[c])});
    combiner_loops().load(sources.fog_factor->data(), at(Reg::fog)[3].data(), count);
}

void CombinerUnit::set_constants(const std::array<Rgba, 2>& constant, std::size_t count) {
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            std::fill_n(at(k == 0 ? Reg::constant_color0 : Reg::constant_color1)[c].begin(), count,
                        std::int32_t{to_unorm8(constant[k][c])});
}

// The sum adds the exact products before either is rounded: one rounding for each of the three results.
void CombinerUnit::run_portion(const CombinerPortion& p, bool is_alpha, std::size_t count) {
    const CombinerLoops& loops = combiner_loops();
    const CombinerScaling scaling = scaling_of(p);
    for (std::size_t c = is_alpha ? 3 : 0; c < (is_alpha ? 4u : 3u); ++c) {
        auto &ab = result_[0][c], &cd = result_[1][c], &sum = result_[2][c];
        loops.multiply(operand(p.a, is_alpha), operand(p.b, is_alpha), p.ab_product, c, ab.data(), count);
        loops.multiply(operand(p.c, is_alpha), operand(p.d, is_alpha), p.cd_product, c, cd.data(), count);
        if (p.sum_rule == CombinerSum::add)
            for (std::size_t i = 0; i < count; ++i) sum[i] = ab[i] + cd[i];
        else
            for (std::size_t i = 0; i < count; ++i)
                sum[i] = takes_cd(p.sum_rule, at(Reg::spare0)[3][i]) ? cd[i] : ab[i];
        for (auto* const result : {&ab, &cd, &sum}) loops.settle(scaling, result->data(), result->data(), count);
    }
}

void CombinerUnit::commit(const CombinerPortion& p, bool is_alpha, std::size_t count) {
    const std::array to{p.ab, p.cd, p.sum};
    for (std::size_t k = 0; k < to.size(); ++k)
        for (std::size_t ch = is_alpha ? 3 : 0; to[k] != Reg::discard && ch < (is_alpha ? 4u : 3u); ++ch)
            std::copy_n(result_[k][ch].begin(), count, at(to[k])[ch].begin());
}

// Both portions are computed before either is written, because alpha's inputs must not include the new rgb.
void CombinerUnit::run_stage(const CombinerStage& stage, std::size_t count) {
    set_constants(stage.constant, count);
    run_portion(stage.rgb, false, count);
    run_portion(stage.alpha, true, count);
    commit(stage.rgb, false, count);
    commit(stage.alpha, true, count);
}

void CombinerUnit::finish(ColorLanes& out, std::size_t count) {
    const FinalCombiner& f = state_.final_stage;
    const CombinerLoops& loops = combiner_loops();
    set_constants(f.constant, count);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < count; ++i) {
            // spare0 may be negative here; the sum clamps it to 0 (combiners.md 3).
            const std::int32_t spare0 = std::max(at(Reg::spare0)[c][i], 0), secondary = at(Reg::secondary_color)[c][i];
            const std::int32_t sum =
                (f.inverts_spare0 ? one - spare0 : spare0) + (f.inverts_secondary_color ? one - secondary : secondary);
            sum_[c][i] = f.clamps_color_sum ? std::min(sum, one) : sum;
        }
        std::int32_t* const product = product_[c].data();
        loops.multiply(operand(f.e, false), operand(f.f, false), CombinerProduct::component_wise, c, product, count);
        loops.settle({}, product, product, count);
    }
    const CombinerMix rgb{operand(f.a, false), operand(f.b, false), operand(f.c, false), operand(f.d, false)};
    for (std::size_t c = 0; c < 3; ++c) loops.mix(rgb, c, out[c].data(), count);
    // Alpha is G, computed by the same loop as 0 G + (1 - 0) 0 + G.
    const CombinerOperand g = operand(f.g, true), zero = operand({.source = Reg::zero}, true);
    loops.mix({zero, g, zero, g}, 3, out[3].data(), count);
}

// Initially the alpha of spare0 is texture 0's alpha, and everything else in the spare registers is 0 (combiners.md 1).
void CombinerUnit::run(const CombinerSources& sources, ColorLanes& out, int count) {
    const auto n = static_cast<std::size_t>(count);
    for (const Reg r : {Reg::zero, Reg::spare0, Reg::spare1}) load(r, nullptr, n);
    load(Reg::primary_color, sources.primary, n);
    load(Reg::secondary_color, sources.secondary, n);
    constexpr std::array textures{Reg::texture0, Reg::texture1, Reg::texture2, Reg::texture3};
    for (std::size_t u = 0; u < textures.size(); ++u) load(textures[u], sources.texture[u], n);
    load_fog(sources, n);
    at(Reg::spare0)[3] = at(Reg::texture0)[3];
    for (const CombinerStage& stage : state_.stages) run_stage(stage, n);
    finish(out, n);
}

}  // namespace strata::pipeline
