// Tests the states that register combiners reject, message by message, and parts of their state that no random test
// reaches. Expected messages are written by hand, expected codes are integers worked out by hand.
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>

#include "pipeline/geforce3/combiner.h"

namespace {

using namespace strata::pipeline;
using In = CombinerRegister;

// The message with which a state is rejected, or "".
[[nodiscard]] std::string refusal_of(const auto& change) {
    Combiners state{{CombinerStage{}}, {}};
    change(state);
    try {
        const auto unit = std::make_unique<CombinerUnit>(state);
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

// Codes of one fragment after `state`. The texture belongs to unit 0; arguments that are not given are absent.
[[nodiscard]] std::array<int, 4> combined_codes(const Combiners& state, const std::array<int, 4>& primary,
                                                const std::array<int, 4>* texture0 = nullptr) {
    const auto lanes = std::make_unique<std::array<ColorLanes, 3>>();
    for (std::size_t c = 0; c < 4; ++c) {
        (*lanes)[0][c][0] = static_cast<float>(primary[c]) / 255.0f;
        if (texture0 != nullptr) (*lanes)[1][c][0] = static_cast<float>((*texture0)[c]) / 255.0f;
    }
    CombinerSources sources{.primary = &(*lanes)[0]};
    if (texture0 != nullptr) sources.texture[0] = &(*lanes)[1];
    std::make_unique<CombinerUnit>(state)->run(sources, (*lanes)[2], 1);
    std::array<int, 4> codes{};
    for (std::size_t c = 0; c < 4; ++c) codes[c] = static_cast<int>((*lanes)[2][c][0] * 255.0f + 0.5f);
    return codes;
}

constexpr CombinerInput one_input{In::zero, CombinerMapping::unsigned_invert};

[[nodiscard]] Combiners showing(In shown, std::vector<CombinerStage> stages = {}) {
    Combiners state{std::move(stages), {}};
    state.final_stage.d = {shown};
    state.final_stage.g = {shown};
    return state;
}

}  // namespace

TEST_CASE("an invalid state is rejected with one message that names the fault") {
    CHECK(refusal_of([](Combiners&) {}).empty());
    CHECK(refusal_of([](Combiners& s) { s.stages.resize(8); }).empty());
    CHECK(refusal_of([](Combiners& s) { s.stages.resize(9); }) == "combiner state: at most eight general stages");
    for (CombinerPortion CombinerStage::*portion : {&CombinerStage::rgb, &CombinerStage::alpha})
        for (CombinerInput CombinerPortion::*input :
             {&CombinerPortion::a, &CombinerPortion::b, &CombinerPortion::c, &CombinerPortion::d}) {
            const auto with = [&](In source) {
                return refusal_of([&](Combiners& s) { (s.stages[0].*portion.*input).source = source; });
            };
            CHECK(with(In::spare1).empty());
            for (const In source : {In::spare0_plus_secondary_color, In::e_times_f, In::discard})
                CHECK(with(source) == "combiner state: an input of a general stage names no register that it has");
        }
    for (CombinerPortion CombinerStage::*portion : {&CombinerStage::rgb, &CombinerStage::alpha})
        for (In CombinerPortion::*output : {&CombinerPortion::ab, &CombinerPortion::cd, &CombinerPortion::sum}) {
            const auto with = [&](In to) {
                return refusal_of([&](Combiners& s) { s.stages[0].*portion.*output = to; });
            };
            for (const In to : {In::primary_color, In::texture3, In::spare0, In::spare1, In::discard})
                CHECK(with(to).empty());
            for (const In to :
                 {In::zero, In::constant_color0, In::constant_color1, In::spare0_plus_secondary_color, In::e_times_f})
                CHECK(with(to) == "combiner state: an output names no writable register");
        }
}

TEST_CASE("dot products exist only for colours and have no sum") {
    for (CombinerProduct CombinerPortion::*product : {&CombinerPortion::ab_product, &CombinerPortion::cd_product}) {
        CHECK(refusal_of([&](Combiners& s) { s.stages[0].rgb.*product = CombinerProduct::dot; }).empty());
        CHECK(refusal_of([&](Combiners& s) { s.stages[0].alpha.*product = CombinerProduct::dot; }) ==
              "combiner state: alpha portions have no dot product");
        CHECK(refusal_of([&](Combiners& s) {
                  s.stages[0].rgb.*product = CombinerProduct::dot;
                  s.stages[0].rgb.sum = In::spare0;
              }) == "combiner state: a stage with a dot product has no sum");
    }
}

TEST_CASE("the final stage takes unsigned inputs and its inputs E F G are plain registers") {
    using enum CombinerMapping;
    for (CombinerInput FinalCombiner::*input :
         {&FinalCombiner::a, &FinalCombiner::b, &FinalCombiner::c, &FinalCombiner::d, &FinalCombiner::e,
          &FinalCombiner::f, &FinalCombiner::g}) {
        const auto mapped_by = [&](CombinerMapping mapping) {
            return refusal_of([&](Combiners& s) { (s.final_stage.*input).mapping = mapping; });
        };
        for (const CombinerMapping mapping : {unsigned_identity, unsigned_invert}) CHECK(mapped_by(mapping).empty());
        for (const CombinerMapping mapping :
             {expand_normal, expand_negate, half_bias_normal, half_bias_negate, signed_identity, signed_negate})
            CHECK(mapped_by(mapping) == "combiner state: the final stage takes unsigned inputs");
        CHECK_FALSE(refusal_of([&](Combiners& s) { (s.final_stage.*input).source = In::discard; }).empty());
        const bool is_plain = input == &FinalCombiner::e || input == &FinalCombiner::f || input == &FinalCombiner::g;
        for (const In source : {In::spare0_plus_secondary_color, In::e_times_f})
            CHECK(refusal_of([&](Combiners& s) { (s.final_stage.*input).source = source; }) ==
                  (is_plain ? "combiner state: E, F and G take plain registers" : ""));
    }
}

TEST_CASE("spare0 starts with the alpha of texture 0 and missing sources are 0") {
    const std::array<int, 4> primary{10, 20, 30, 40}, texture{50, 60, 70, 80};
    CHECK(combined_codes(showing(In::spare0), primary, &texture) == std::array{0, 0, 0, 80});
    CHECK(combined_codes(showing(In::spare0), primary) == std::array{0, 0, 0, 0});
    CHECK(combined_codes(showing(In::spare1), primary, &texture) == std::array{0, 0, 0, 0});
    CHECK(combined_codes(showing(In::secondary_color), primary, &texture) == std::array{0, 0, 0, 0});
    CHECK(combined_codes(showing(In::texture0), primary, &texture) == texture);
    CHECK(combined_codes(showing(In::texture2), primary, &texture) == std::array{0, 0, 0, 0});
    CHECK(combined_codes(showing(In::primary_color), primary) == primary);
}

TEST_CASE("every stage has its own two constants and the final stage has separate ones") {
    const auto constants = [](float first, float second) {
        return std::array{strata::Rgba(first), strata::Rgba(second)};
    };
    CombinerStage add;  // texture1 = primary + constant0, texture2 = constant1 * 1
    add.rgb.a = {In::primary_color}, add.rgb.b = one_input, add.rgb.c = {In::constant_color0}, add.rgb.d = one_input;
    add.rgb.sum = In::primary_color;
    add.constant = constants(10 / 255.0f, 0);
    CombinerStage again = add;
    again.rgb.c = {In::constant_color1};
    again.constant = constants(0, 30 / 255.0f);
    Combiners state = showing(In::primary_color, {add, again});
    CHECK(combined_codes(state, {1, 2, 3, 4}) == std::array{41, 42, 43, 4});
    state.final_stage.d = {In::constant_color1};
    state.final_stage.g = {In::constant_color0};
    state.final_stage.constant = constants(90 / 255.0f, 100 / 255.0f);
    CHECK(combined_codes(state, {1, 2, 3, 4}) == std::array{100, 100, 100, 90});
}

TEST_CASE("both portions of a stage read the registers before it regardless of what the other writes") {
    CombinerStage swap;  // colour reads alpha, alpha reads blue
    swap.rgb.a = {In::primary_color, CombinerMapping::unsigned_identity, CombinerComponent::alpha};
    swap.alpha.a = {In::primary_color, CombinerMapping::unsigned_identity, CombinerComponent::blue};
    swap.rgb.b = swap.alpha.b = one_input;
    swap.rgb.ab = swap.alpha.ab = In::primary_color;
    CHECK(combined_codes(showing(In::primary_color, {swap}), {1, 2, 3, 4}) == std::array{4, 4, 4, 3});
    CHECK(combined_codes(showing(In::primary_color, {swap, swap}), {1, 2, 3, 4}) == std::array{3, 3, 3, 4});
}

TEST_CASE("a negative spare0 counts as 0 in the final stage's sum and as 1 if inverted") {
    CombinerStage negate;
    negate.rgb.a = {In::primary_color, CombinerMapping::signed_negate};
    negate.rgb.b = one_input;
    negate.rgb.ab = In::spare0;
    Combiners state{{negate}, {}};
    state.final_stage.d = {In::spare0_plus_secondary_color};
    CHECK(combined_codes(state, {100, 50, 0, 0}) == std::array{0, 0, 0, 0});
    state.final_stage.inverts_spare0 = true;
    CHECK(combined_codes(state, {100, 50, 0, 0}) == std::array{255, 255, 255, 0});
    CombinerStage lend = negate;  // with a secondary colour of 60
    lend.rgb.c = {In::zero, CombinerMapping::unsigned_invert};
    lend.rgb.d = {In::constant_color0};
    lend.rgb.cd = In::secondary_color;
    lend.constant[0] = {60 / 255.0f, 60 / 255.0f, 60 / 255.0f, 0};
    Combiners added{{lend}, {}};
    added.final_stage.d = {In::spare0_plus_secondary_color};
    CHECK(combined_codes(added, {100, 50, 0, 0}) == std::array{60, 60, 60, 0});
    state.final_stage.inverts_spare0 = false;
    state.final_stage.d = {In::spare0};  // and as a separate input
    CHECK(combined_codes(state, {100, 50, 0, 0}) == std::array{0, 0, 0, 0});
}

TEST_CASE("selection by the lowest bit takes the second product for every odd alpha of spare0 in colour and alpha") {
    CombinerStage choose;
    for (CombinerPortion* portion : {&choose.rgb, &choose.alpha}) {
        portion->a = {In::primary_color};
        portion->b = portion->d = one_input;
        portion->c = {In::texture0};
        portion->sum = In::spare1;
        portion->sum_rule = CombinerSum::mux_low_bit;
    }
    int wrong = 0;
    for (int alpha = 0; alpha < 256; ++alpha) {
        const std::array<int, 4> texture{7, 8, 9, alpha};
        const auto found = combined_codes(showing(In::spare1, {choose}), {100, 101, 102, 103}, &texture);
        const auto expected = alpha % 2 == 1 ? texture : std::array{100, 101, 102, 103};
        wrong += found == expected ? 0 : 1;
    }
    CHECK(wrong == 0);
}
