// Tests the depth test against comparisons of the values that the codes represent.
#include "pipeline/stages/depth_test.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using strata::rasterizer::Lanes;

namespace {

std::uint32_t any_code(Random& random, DepthFormat format) {
    if (format == DepthFormat::d32f) return bits_of(any_float(random));
    const std::uint32_t top = format == DepthFormat::d16 ? 0xffff : 0xffffff;
    return one_in(random, 4) ? top - below(random, 2) : below(random, top) + 1;
}

// The value of a code: an integer, or the float with these bits.
double meaning(std::uint32_t code, DepthFormat format) {
    return format == DepthFormat::d32f ? double{float_of(code)} : static_cast<double>(code);
}

bool passes_one(CompareFunc func, DepthFormat format, std::uint32_t code, std::uint32_t stored) {
    std::uint32_t pass = 0;
    depth_test({true, func, true}, format, &code, &stored, &pass, 1);
    return pass == ~0u;
}

}  // namespace

TEST_CASE("a fragment passes the depth test exactly if its code has the function's relation to the stored one") {
    Random random{5};
    Tally tally;
    for (int round = 0; round < 4000; ++round) {
        const DepthTest state{!one_in(random, 8), any_of(random, CompareFunc::always), true};
        const auto format = any_of(random, DepthFormat::d32f);
        const int count = static_cast<int>(below(random, 65));
        Lanes<std::uint32_t> code{}, stored{}, pass{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            code[i] = any_code(random, format);
            stored[i] = one_in(random, 3) ? code[i] : any_code(random, format);
        }
        depth_test(state, format, code.data(), stored.data(), pass.data(), count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const bool expected =
                !state.enabled || model_compare(state.func, meaning(code[i], format), meaning(stored[i], format));
            tally.expect(pass[i] == (expected ? ~0u : 0u), [&] {
                return fmt::format("format {} func {}: {:08x} against {:08x}", static_cast<int>(format),
                                   static_cast<int>(state.func), code[i], stored[i]);
            });
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("a D32F buffer cleared to -1 is in front of every fragment and one cleared to 2 behind") {
    for (const float z : {0.0f, 0.25f, 1.0f}) {
        CHECK(passes_one(CompareFunc::greater, DepthFormat::d32f, bits_of(z), bits_of(-1.0f)));
        CHECK_FALSE(passes_one(CompareFunc::lequal, DepthFormat::d32f, bits_of(z), bits_of(-1.0f)));
        CHECK(passes_one(CompareFunc::less, DepthFormat::d32f, bits_of(z), bits_of(2.0f)));
    }
}

TEST_CASE("a NaN in a D32F buffer passes only NOTEQUAL and ALWAYS") {
    using enum CompareFunc;
    for (const CompareFunc func : {never, less, equal, lequal, greater, notequal, gequal, always})
        CHECK(passes_one(func, DepthFormat::d32f, 0x3f000000, 0x7fc00001) == (func == notequal || func == always));
}

TEST_CASE("negative zero and positive zero are one depth") {
    CHECK(passes_one(CompareFunc::equal, DepthFormat::d32f, 0x00000000, 0x80000000));
    CHECK_FALSE(passes_one(CompareFunc::less, DepthFormat::d32f, 0x80000000, 0x00000000));
}

TEST_CASE("depth is written where the fragment is alive and nowhere while the test is off") {
    Lanes<std::uint32_t> code{}, alive{}, stored{};
    for (std::uint32_t i = 0; i < 100; ++i) code[i] = i, stored[i] = 1000 + i, alive[i] = i % 3 == 0 ? ~0u : 0u;
    write_depth(code.data(), alive.data(), stored.data(), 90);
    int wrong = 0;
    for (std::uint32_t i = 0; i < 100; ++i) wrong += stored[i] == (i % 3 == 0 && i < 90 ? i : 1000 + i) ? 0 : 1;
    CHECK(wrong == 0);
    CHECK(writes_depth({true, CompareFunc::always, true}));
    CHECK_FALSE(writes_depth({false, CompareFunc::always, true}));
    CHECK_FALSE(writes_depth({true, CompareFunc::always, false}));
}
