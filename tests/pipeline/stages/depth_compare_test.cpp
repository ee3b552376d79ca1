// Tests the comparison of a fragment with a stored depth against the rule of depth_compare.h in rational arithmetic.
#include "pipeline/stages/depth_compare.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/rasterizer/rational.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::DepthFormat;
using strata::rasterizer::Rational;

[[nodiscard]] Rational model_value(DepthFormat format, std::uint32_t code) {
    return format == DepthFormat::d32f ? Rational{std::bit_cast<float>(code)} : Rational{code};
}

[[nodiscard]] bool model_is_behind(const DepthCompare& c, std::uint32_t code, double z, std::uint32_t stored) {
    const std::uint32_t last = strata::rasterizer::max_code(c.format);
    const std::uint32_t raised = stored > last - static_cast<std::uint32_t>(c.epsilon.ulps)
                                     ? last
                                     : stored + static_cast<std::uint32_t>(c.epsilon.ulps);
    const Rational one = model_value(c.format, last);
    Rational own = model_value(c.format, code);
    if (!c.quantizes) own = std::clamp(Rational{z}, Rational{0}, one);
    return own > model_value(c.format, raised) + Rational{c.epsilon.absolute} * one;
}

}  // namespace

TEST_CASE("a fragment is behind a stored depth by the frame's epsilon and quantisation in every format") {
    Random random{941};
    std::uint64_t wrong = 0, behind = 0, cases = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (const bool quantizes : {true, false})
            for (const CompareEpsilon epsilon : {CompareEpsilon{}, {0.0, 3}, {0x1p-20, 0}, {1e-7, 2}, {0.25, 0}})
                for (int i = 0; i < 300; ++i) {
                    const DepthCompare compare{format, epsilon, true, quantizes};
                    const std::uint32_t last = strata::rasterizer::max_code(format);
                    const std::uint32_t stored = i % 50 == 0 ? last : static_cast<std::uint32_t>(random()) % (last + 1);
                    const auto apart = static_cast<std::uint32_t>(random_int(random, 0, i % 2 == 0 ? 6 : 4000));
                    const std::uint32_t code =
                        i % 3 == 0 && stored >= apart ? stored - apart : std::min(last, stored + apart);
                    const double scale = format == DepthFormat::d32f ? 0x1p-24 : 1.0;
                    const double z = compare.value(code) + scale * double{random_float(random, -0.9f, 1.9f)};
                    const bool found = compare.is_behind(code, z, stored);
                    // z + epsilon is rounded once in binary64; no value of this test is that close to a code.
                    wrong += found != model_is_behind(compare, code, z, stored) ? 1 : 0;
                    behind += found ? 1 : 0;
                    ++cases;
                }
    CHECK(wrong == 0);
    CHECK(behind > cases / 5);
    CHECK(behind < cases * 4 / 5);
}

TEST_CASE("the farthest code is behind wherever any code is and for D32F also beyond 1") {
    Random random{942};
    std::uint64_t wrong = 0, behind = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (const bool quantizes : {true, false})
            for (const CompareEpsilon epsilon : {CompareEpsilon{}, {0.0, 3}, {0x1p-20, 0}, {0.25, 2}})
                for (int i = 0; i < 300; ++i) {
                    const DepthCompare compare{format, epsilon, true, quantizes};
                    const bool is_float = format == DepthFormat::d32f;
                    const std::uint32_t one = strata::rasterizer::max_code(format);
                    const auto any = [&] {  // a D32F value around 1
                        return is_float ? std::bit_cast<std::uint32_t>(random_float(random, 0.5f, 1.5f))
                                        : one - static_cast<std::uint32_t>(random_int(random, 0, 9));
                    };
                    const std::uint32_t code = any(), stored = any();
                    const double z = is_float ? std::bit_cast<float>(code) : static_cast<double>(code);
                    if (!compare.is_behind(code, z, stored)) continue;
                    ++behind;
                    const double infinity = std::numeric_limits<double>::infinity();
                    wrong += compare.is_behind(compare.farthest_code(), infinity, stored) ? 0 : 1;
                }
    CHECK(wrong == 0);
    CHECK(behind > 500);
}

TEST_CASE("only without reference and epsilon and unrounded depths does a comparison need only codes") {
    CHECK(DepthCompare{}.is_plain());
    CHECK_FALSE(DepthCompare{.epsilon = {0, 1}}.is_plain());
    CHECK_FALSE(DepthCompare{.epsilon = {1e-9, 0}}.is_plain());
    CHECK_FALSE(DepthCompare{.has_reference = true}.is_plain());
    CHECK_FALSE(DepthCompare{.quantizes = false}.is_plain());
}

TEST_CASE("a binary32 depth must exceed another one by units in its last place and by an absolute part") {
    const DepthCompare two{.epsilon = {0, 2}}, part{.epsilon = {0.125, 0}};
    const float b = 0.3f, third = std::bit_cast<float>(std::bit_cast<std::uint32_t>(b) + 3);
    const float second = std::bit_cast<float>(std::bit_cast<std::uint32_t>(b) + 2);
    CHECK(two.exceeds(third, b));
    CHECK_FALSE(two.exceeds(second, b));
    CHECK_FALSE(two.exceeds(b, third));
    CHECK(part.exceeds(0.5, 0.25));
    CHECK_FALSE(part.exceeds(0.375, 0.25));
}
