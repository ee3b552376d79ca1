// Tests the comparison functions against the table of GL 2.1 4.1.4 as sets of outcomes (stage_values.h); a float's
// neighbours are found by its bits.
#include "pipeline/device/compare.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "pipeline/device/state.h"
#include "pipeline/stages/depth_compare.h"
#include "tests/pipeline/stage_values.h"

namespace {

using namespace strata::pipeline;

constexpr std::array every_function{CompareFunc::never,  CompareFunc::less,    CompareFunc::equal,
                                    CompareFunc::lequal, CompareFunc::greater, CompareFunc::notequal,
                                    CompareFunc::gequal, CompareFunc::always};

template <class T>
[[nodiscard]] bool compared(CompareFunc func, T a, T b) {
    bool result = false;
    int calls = 0;
    with_compare(func, [&](auto chosen) {
        result = passes<chosen()>(a, b);
        ++calls;
    });
    return calls == 1 && result;
}

}  // namespace

TEST_CASE("the default state is OpenGL's initial state") {
    const Blend blend;
    CHECK_FALSE(blend.enabled);
    CHECK(blend.constant == strata::Rgba{0, 0, 0, 0});
    CHECK(blend.write_mask == 0xf);
    for (const BlendTerm& term : {blend.color, blend.alpha}) {
        CHECK(term.equation == BlendEquation::add);
        CHECK(term.src == BlendFactor::one);
        CHECK(term.dst == BlendFactor::zero);
    }
}

TEST_CASE("each function passes exactly its own outcomes for integers and floats and NaN") {
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                    infinity = std::numeric_limits<float>::infinity();
    int wrong = 0;
    for (const CompareFunc func : every_function) {
        for (const float a : {-infinity, -1.0f, -0.0f, 0.0f, 0x1p-149f, 1.0f, infinity, not_a_number})
            for (const float b : {-infinity, -1.0f, -0.0f, 0.0f, 0x1p-149f, 1.0f, infinity, not_a_number})
                wrong += compared(func, a, b) != model_compare(func, a, b) ? 1 : 0;
        for (const std::uint32_t a : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
            for (const std::uint32_t b : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
                wrong += compared(func, a, b) != model_compare(func, a, b) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK_FALSE(compared(CompareFunc::never, 1, 1));
    CHECK(compared(CompareFunc::always, not_a_number, not_a_number));
}

TEST_CASE("steps of binary32 raise only depths above 0 and leave 0 and negative depths unchanged") {
    const DepthCompare steps{.epsilon = {0.0, 3}};
    int wrong = 0;
    for (const float b : {0x1p-149f, 0x1p-126f, 0.3f, 0.99999994f, 1.0f, 5.0f})
        for (std::uint32_t apart = 0; apart < 6; ++apart) {
            const float a = float_of(bits_of(b) + apart);
            wrong += steps.exceeds(a, b) != (apart > 3) ? 1 : 0;
        }
    CHECK(wrong == 0);
    CHECK(steps.exceeds(0x1p-149f, 0.0f));
    CHECK(steps.exceeds(0x1p-149f, -0.0f));
    CHECK_FALSE(steps.exceeds(0.0f, 0.0f));
    CHECK(steps.exceeds(-0.5f, std::nextafter(-0.5f, -1.0f)));
    CHECK_FALSE(steps.exceeds(-0.5f, -0.5f));
    const DepthCompare both{.epsilon = {0x1p-10, 3}};
    CHECK_FALSE(both.exceeds(0.5 + 0x1p-10, 0.5));
    CHECK_FALSE(both.exceeds(0.5 + 0x1p-10 + 3 * 0x1p-24, 0.5));
    CHECK(both.exceeds(0.5 + 0x1p-10 + 4 * 0x1p-24, 0.5));
}
