// Tests the alpha test against comparisons of integers and real numbers, and against hardware captures.
#include "pipeline/stages/alpha_test.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using strata::rasterizer::Lanes;

namespace {

// Expected result: 8-bit codes compare as integers, binary32 as real numbers, and a NaN is not equal to anything.
bool model_passes(const AlphaTest& state, bool eight_bit, float alpha) {
    if (!state.enabled) return true;
    if (eight_bit) return model_compare(state.func, model::unorm8(bits_of(alpha)), model::unorm8(bits_of(state.ref)));
    return model_compare(state.func, alpha, state.ref);
}

bool passes_one(const AlphaTest& state, bool eight_bit, float alpha) {
    std::uint32_t alive = ~0u;
    alpha_test(state, eight_bit, &alpha, &alive, 1);
    return alive != 0;
}

}  // namespace

TEST_CASE("a fragment passes the alpha test exactly if its alpha does and dead fragments stay dead") {
    Random random{4};
    Tally tally;
    for (int round = 0; round < 4000; ++round) {
        const AlphaTest state{!one_in(random, 8), any_of(random, CompareFunc::always), any_float(random)};
        const bool eight_bit = one_in(random, 2);
        const int count = static_cast<int>(below(random, 65));
        Lanes<float> alpha{};
        Lanes<std::uint32_t> alive{}, before{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            alpha[i] = one_in(random, 4) ? state.ref : any_float(random);
            alive[i] = before[i] = one_in(random, 4) ? 0u : ~0u;
        }
        alpha_test(state, eight_bit, alpha.data(), alive.data(), count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const std::uint32_t expected = model_passes(state, eight_bit, alpha[i]) ? before[i] : 0u;
            tally.expect(alive[i] == expected, [&] {
                return fmt::format("func {} ref {:08x} alpha {:08x} 8-bit {}", static_cast<int>(state.func),
                                   bits_of(state.ref), bits_of(alpha[i]), eight_bit);
            });
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("on an 8-bit target alphas of one code are equal though their floats differ") {
    const AlphaTest equal{true, CompareFunc::equal, 0.5f};
    CHECK(passes_one(equal, true, 128.0f / 255.0f));
    CHECK_FALSE(passes_one(equal, false, 128.0f / 255.0f));
    CHECK(passes_one(equal, false, 0.5f));
}

TEST_CASE("a mask cutoff of 0.5 keeps exactly the 8-bit alphas from 128 up") {
    const AlphaTest cutoff{true, CompareFunc::gequal, 0.5f};
    for (int k = 0; k < 256; ++k) CHECK(passes_one(cutoff, true, static_cast<float>(k) / 255.0f) == (k >= 128));
}

// pipeline/reference/chip-fragment.md 2: 8-bit alphas against 7F, sixteen hardware captures.
TEST_CASE("alphas 7E and 7F and 80 against 7F pass as in the hardware captures") {
    const auto outcome = [](CompareFunc func) {
        std::string passed;
        for (const int alpha : {0x7e, 0x7f, 0x80})
            passed += passes_one({true, func, 127.0f / 255.0f}, true, static_cast<float>(alpha) / 255.0f) ? '1' : '0';
        return passed;
    };
    using enum CompareFunc;
    CHECK(outcome(never) == "000");
    CHECK(outcome(less) == "100");
    CHECK(outcome(equal) == "010");
    CHECK(outcome(lequal) == "110");
    CHECK(outcome(greater) == "001");
    CHECK(outcome(notequal) == "101");
    CHECK(outcome(gequal) == "011");
    CHECK(outcome(always) == "111");
}

TEST_CASE("the comparison has 8 bits if the profile says so or the target has them") {
    CHECK(is_eight_bit_alpha(AlphaTestPrecision::unorm8, ChannelType::single));
    CHECK(is_eight_bit_alpha(AlphaTestPrecision::by_target, ChannelType::unorm8));
    CHECK_FALSE(is_eight_bit_alpha(AlphaTestPrecision::by_target, ChannelType::half));
}
