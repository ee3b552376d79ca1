// Tests the register combiners against a scalar model of one fragment in rational arithmetic, and against values read
// from captures of an NV2A.
#include "pipeline/geforce3/combiner.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>

#include "rasterizer/base/simd.h"
#include "tests/pipeline/addressing_model.h"

using namespace strata::pipeline;
using model::Rational;
using Reg = CombinerRegister;
using Map = CombinerMapping;

namespace {

using Color = std::array<int, 4>;  // codes

struct Fragment {
    Color primary{}, secondary{};
    std::array<Color, 4> texture{};
    Color fog{};  // its alpha is the fog factor
};

constexpr int lanes_used = 19;  // full vectors and a remainder on every instruction set

void put(ColorLanes& lanes, const Color& c) {
    for (std::size_t k = 0; k < 4; ++k) std::fill_n(lanes[k].begin(), lanes_used, static_cast<float>(c[k]) / 255.0f);
}

// Runs the fragment in every lane on every instruction set; all results must be equal.
Color run(const Combiners& state, const Fragment& f) {
    const auto lanes = std::make_unique<std::array<ColorLanes, 8>>();
    put((*lanes)[0], f.primary);
    put((*lanes)[1], f.secondary);
    CombinerSources sources{.primary = &(*lanes)[0], .secondary = &(*lanes)[1]};
    for (std::size_t u = 0; u < 4; ++u) {
        put((*lanes)[2 + u], f.texture[u]);
        sources.texture[u] = &(*lanes)[2 + u];
    }
    put((*lanes)[7], f.fog);
    sources.fog_factor = &(*lanes)[7][3];
    for (std::size_t k = 0; k < 3; ++k) sources.fog[k] = static_cast<float>(f.fog[k]) / 255.0f;
    Color out{-1, -1, -1, -1};
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        const auto unit = std::make_unique<CombinerUnit>(state);
        unit->run(sources, (*lanes)[6], lanes_used);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& channel = (*lanes)[6][k];
            if (out[k] < 0) out[k] = static_cast<int>(channel[0] * 255.0f + 0.5f);
            const float expected = static_cast<float>(out[k]) / 255.0f;
            REQUIRE(std::count(channel.begin(), channel.begin() + lanes_used, expected) == lanes_used);
        }
    }
    return out;
}

// A final stage that outputs one register.
FinalCombiner show(Reg r) {
    FinalCombiner f;
    f.d = {r};
    f.g = {r};
    return f;
}

// The model: registers hold rationals; the rules are the tables of NV_register_combiners.
using Values = std::array<Rational, 4>;
struct Machine {
    std::array<Values, combiner_registers> reg{};

    static Rational mapped(Map mapping, Rational e) {
        const Rational half{128, 255}, low = e < 0 ? Rational{0} : e, unit = low > 1 ? Rational{1} : low;
        switch (mapping) {
            case Map::unsigned_identity: return low;
            case Map::unsigned_invert: return 1 - unit;
            case Map::expand_normal: return 2 * low - 1;
            case Map::expand_negate: return 1 - 2 * low;
            case Map::half_bias_normal: return low - half;
            case Map::half_bias_negate: return half - low;
            case Map::signed_identity: return e;
            case Map::signed_negate: return -e;
        }
        return 0;
    }
    // Rounds to the nearest multiple of 1/255.
    static Rational stored(const Rational& x) {
        const model::Integer k = model::floor((x < 0 ? -x : x) * 255 + Rational{1, 2});
        return (x < 0 ? Rational{-k} : Rational{k}) / 255;
    }
    [[nodiscard]] Rational input(const CombinerInput& in, bool alpha, std::size_t channel) const {
        const Values& v = reg[static_cast<std::size_t>(in.source)];
        const std::size_t own = alpha ? 3 : channel;
        return mapped(in.mapping, v[in.component == CombinerComponent::alpha  ? 3
                                    : in.component == CombinerComponent::blue ? 2
                                                                              : own]);
    }
    static Rational out(const CombinerPortion& p, Rational x) {
        x = stored(x);
        if (p.bias == CombinerBias::by_negative_half) x -= Rational{128, 255};
        if (p.scale == CombinerScale::by_two) x *= 2;
        if (p.scale == CombinerScale::by_four) x *= 4;
        if (p.scale == CombinerScale::by_half) x = Rational{model::floor(x * 255 / 2 + Rational{1, 2})} / 255;
        return x > 1 ? Rational{1} : x < -1 ? Rational{-1} : x;
    }
    void portion(const CombinerPortion& p, bool alpha, std::array<Values, combiner_registers>& to) const {
        for (std::size_t ch = alpha ? 3 : 0; ch < (alpha ? 4u : 3u); ++ch) {
            const auto product = [&](const CombinerInput& x, const CombinerInput& y, CombinerProduct kind) {
                if (kind == CombinerProduct::component_wise) return Rational{input(x, alpha, ch) * input(y, alpha, ch)};
                Rational sum = 0;
                for (std::size_t k = 0; k < 3; ++k) sum += input(x, alpha, k) * input(y, alpha, k);
                return sum;
            };
            const Rational ab = product(p.a, p.b, p.ab_product), cd = product(p.c, p.d, p.cd_product);
            const bool second = reg[static_cast<std::size_t>(Reg::spare0)][3] * 255 >= 128;
            const Rational sum = p.sum_rule == CombinerSum::add ? Rational{ab + cd} : second ? cd : ab;
            if (p.ab != Reg::discard) to[static_cast<std::size_t>(p.ab)][ch] = out(p, ab);
            if (p.cd != Reg::discard) to[static_cast<std::size_t>(p.cd)][ch] = out(p, cd);
            if (p.sum != Reg::discard) to[static_cast<std::size_t>(p.sum)][ch] = out(p, sum);
        }
    }
    void stage(const CombinerStage& s) {
        for (std::size_t k = 0; k < 4; ++k) {
            reg[1][k] = Rational{static_cast<int>(s.constant[0][k] * 255.0f + 0.5f), 255};
            reg[2][k] = Rational{static_cast<int>(s.constant[1][k] * 255.0f + 0.5f), 255};
        }
        auto next = reg;
        portion(s.rgb, false, next);
        portion(s.alpha, true, next);
        reg = next;
    }
};

CombinerInput any_input(Random& random) {
    return {any_of(random, Reg::spare1), any_of(random, Map::signed_negate), any_of(random, CombinerComponent::blue)};
}

Reg any_output(Random& random) {
    return one_in(random, 3) ? Reg::discard : static_cast<Reg>(3 + below(random, 8));  // primary_color to spare1
}

CombinerPortion any_portion(Random& random, bool alpha) {
    CombinerPortion p;
    p.a = any_input(random);
    p.b = any_input(random);
    p.c = any_input(random);
    p.d = any_input(random);
    // The outputs must be distinct: two writes to one register are undefined.
    p.ab = any_output(random);
    do p.cd = any_output(random);
    while (p.cd != Reg::discard && p.cd == p.ab);
    do p.sum = any_output(random);
    while (p.sum != Reg::discard && (p.sum == p.ab || p.sum == p.cd));
    if (!alpha && one_in(random, 4)) {
        p.sum = Reg::discard;
        p.ab_product = any_of(random, CombinerProduct::dot);
        p.cd_product = any_of(random, CombinerProduct::dot);
    }
    p.sum_rule = any_of(random, CombinerSum::mux);
    p.scale = any_of(random, CombinerScale::by_half);
    p.bias = any_of(random, CombinerBias::by_negative_half);
    return p;
}

Color any_color(Random& random) { return {any_byte(random), any_byte(random), any_byte(random), any_byte(random)}; }

Color values(const Values& v) {
    Color codes;
    for (std::size_t k = 0; k < 4; ++k)
        codes[k] = static_cast<int>(model::floor(v[k] < 0 ? Rational{0} : Rational{v[k] * 255}));
    return codes;
}

}  // namespace

TEST_CASE("general combiners compute the tables of the extension with one rounding per sum", "[slow]") {
    Random random{321};
    Tally tally;
    for (int round = 0; round < 3000; ++round) {
        Combiners state;
        for (std::uint32_t k = below(random, 4); k-- > 0;) {
            CombinerStage stage{any_portion(random, false), any_portion(random, true), {}};
            for (auto& constant : stage.constant)
                for (float& c : strata::components(constant)) c = static_cast<float>(any_byte(random)) / 255.0f;
            state.stages.push_back(stage);
        }
        const Reg shown = static_cast<Reg>(3 + below(random, 8));
        state.final_stage = show(shown);
        Fragment f{any_color(random),
                   any_color(random),
                   {any_color(random), any_color(random), any_color(random), any_color(random)}};
        Machine m;
        for (std::size_t k = 0; k < 4; ++k) {
            m.reg[3][k] = Rational{f.primary[k], 255};
            m.reg[4][k] = Rational{f.secondary[k], 255};
            for (std::size_t u = 0; u < 4; ++u) m.reg[5 + u][k] = Rational{f.texture[u][k], 255};
        }
        m.reg[static_cast<std::size_t>(Reg::spare0)][3] = Rational{f.texture[0][3], 255};
        for (const CombinerStage& stage : state.stages) m.stage(stage);
        const Color found = run(state, f), expected = values(m.reg[static_cast<std::size_t>(shown)]);
        tally.expect(found == expected, [&] {
            return fmt::format("round {}: {} {} {} {} against {} {} {} {}", round, found[0], found[1], found[2],
                               found[3], expected[0], expected[1], expected[2], expected[3]);
        });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("bias and scale and their order give the values in captures of the chip") {
    const auto through = [](int code, CombinerScale scale, CombinerBias bias) {
        CombinerStage stage;
        stage.rgb.a = {Reg::primary_color};
        stage.rgb.b = {Reg::zero, Map::unsigned_invert};
        stage.rgb.ab = Reg::spare1;
        stage.rgb.scale = scale;
        stage.rgb.bias = bias;
        return run({{stage}, show(Reg::spare1)}, {.primary = {code, code, code, code}})[0];
    };
    CHECK(through(255, CombinerScale::by_one, CombinerBias::by_negative_half) == 127);
    CHECK(through(255, CombinerScale::by_two, CombinerBias::by_negative_half) == 254);
    CHECK(through(200, CombinerScale::by_two, CombinerBias::none) == 255);
    CHECK(through(63, CombinerScale::by_four, CombinerBias::none) == 252);
    CHECK(through(25, CombinerScale::by_half, CombinerBias::none) == 13);
    CHECK(through(63, CombinerScale::by_half, CombinerBias::none) == 32);
    CHECK(through(255, CombinerScale::by_half, CombinerBias::none) == 128);
}

TEST_CASE("selection is by the upper bit of spare0's alpha or by the lowest bit in the chip's other mode") {
    struct Case {
        CombinerSum rule;
        int alpha, expected;
    };
    constexpr auto high = CombinerSum::mux, low = CombinerSum::mux_low_bit;
    for (const Case& c : {Case{high, 127, 10},
                          {high, 128, 20},
                          {high, 0, 10},
                          {high, 255, 20},
                          {high, 0x81, 20},
                          {high, 0x82, 20},
                          {low, 0x82, 10},
                          {low, 0x81, 20},
                          {low, 0, 10},
                          {low, 1, 20}}) {
        CombinerStage stage;
        stage.rgb.a = {Reg::texture1};
        stage.rgb.c = {Reg::texture2};
        stage.rgb.b = stage.rgb.d = {Reg::zero, Map::unsigned_invert};
        stage.rgb.sum = Reg::spare1;
        stage.rgb.sum_rule = c.rule;
        const Fragment f{.texture = {{{0, 0, 0, c.alpha}, {10, 10, 10, 0}, {20, 20, 20, 0}, {}}}};
        CHECK(run({{stage}, show(Reg::spare1)}, f)[0] == c.expected);
    }
}

TEST_CASE("the final stage's sum of colours is clamped only if requested and may be inverted per operand") {
    CombinerStage copy;
    copy.rgb.a = {Reg::primary_color};
    copy.rgb.b = {Reg::zero, Map::unsigned_invert};
    copy.rgb.ab = Reg::spare0;
    Combiners state{{copy}, {}};
    state.final_stage.d = {Reg::spare0_plus_secondary_color};
    const Fragment f{.primary = {63, 127, 191, 0}, .secondary = {178, 127, 38, 0}};
    CHECK(run(state, f) == Color{241, 254, 229, 0});
    state.final_stage.inverts_spare0 = true;
    CHECK(run(state, f) == Color{255, 255, 102, 0});
    state.final_stage.inverts_spare0 = false;
    state.final_stage.inverts_secondary_color = true;
    CHECK(run(state, f) == Color{140, 255, 255, 0});
    state.final_stage = {};
    state.final_stage.a = {Reg::spare0_plus_secondary_color};
    state.final_stage.b = {Reg::constant_color0};
    state.final_stage.constant[0] = {127.0f / 255.0f, 127.0f / 255.0f, 127.0f / 255.0f, 0};
    const Fragment white{.primary = {255, 255, 255, 0}, .secondary = {255, 255, 255, 0}};
    CHECK(run(state, white)[0] == 254);  // 127 * 510 / 255
    state.final_stage.clamps_color_sum = true;
    CHECK(run(state, white)[0] == 127);
}

TEST_CASE("the final stage's product and mixture are rounded to nearest") {
    Combiners state;
    state.final_stage.d = {Reg::e_times_f};
    state.final_stage.e = {Reg::primary_color};
    state.final_stage.f = {Reg::secondary_color};
    CHECK(run(state, {.primary = {255, 191, 127, 0}, .secondary = {127, 127, 127, 0}}) == Color{127, 95, 63, 0});
    state.final_stage = {};
    state.final_stage.a = {Reg::texture0};
    state.final_stage.b = {Reg::primary_color};
    state.final_stage.c = {Reg::secondary_color};
    state.final_stage.g = {Reg::primary_color, Map::unsigned_invert, CombinerComponent::blue};
    const Fragment f{
        .primary = {200, 10, 90, 7}, .secondary = {100, 250, 0, 0}, .texture = {{{128, 64, 1, 0}, {}, {}, {}}}};
    Color expected{};
    for (std::size_t k = 0; k < 3; ++k)
        expected[k] = (2 * (f.texture[0][k] * f.primary[k] + (255 - f.texture[0][k]) * f.secondary[k]) + 255) / 510;
    expected[3] = 255 - 90;
    CHECK(run(state, f) == expected);
}

TEST_CASE("the final stage mixes a colour with the fog's by its factor, to nearest") {
    Combiners state;
    state.final_stage.a = {.source = Reg::fog, .component = CombinerComponent::alpha};
    state.final_stage.b = {Reg::primary_color};
    state.final_stage.c = {Reg::fog};
    state.final_stage.g = {.source = Reg::fog, .component = CombinerComponent::alpha};
    for (const int factor : {0, 1, 100, 128, 254, 255}) {
        const Fragment f{.primary = {200, 10, 90, 7}, .fog = {48, 32, 127, factor}};
        Color expected{};
        for (std::size_t k = 0; k < 3; ++k)
            expected[k] = (2 * (factor * f.primary[k] + (255 - factor) * f.fog[k]) + 255) / 510;
        expected[3] = factor;
        CHECK(run(state, f) == expected);
    }
}

TEST_CASE("invalid combiner state is rejected") {
    const auto wrong = [](auto change) {
        Combiners state{{CombinerStage{}}, {}};
        change(state);
        return state;
    };
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.stages.resize(9); })), std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.stages[0].rgb.a.source = Reg::e_times_f; })),
                    std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.stages[0].alpha.a = {Reg::fog}; })), std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) {
                        s.stages[0].rgb.a = {.source = Reg::fog, .component = CombinerComponent::alpha};
                    })),
                    std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.stages[0].rgb.ab = Reg::constant_color0; })),
                    std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.stages[0].alpha.ab_product = CombinerProduct::dot; })),
                    std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.final_stage.a.mapping = Map::signed_identity; })),
                    std::logic_error);
    CHECK_THROWS_AS(CombinerUnit(wrong([](Combiners& s) { s.final_stage.g.source = Reg::e_times_f; })),
                    std::logic_error);
}
