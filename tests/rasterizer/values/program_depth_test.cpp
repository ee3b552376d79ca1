// Tests depths that a program writes: the logarithm against 50 decimal digits, and the digits of packed depths and what
// is read back against rationals, every rounding written out.
#include "rasterizer/values/depth/program_depth.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;
using Wide = boost::multiprecision::cpp_bin_float_50;

// The byte that a channel of RGBA8 stores for a value from 0 to 1.
[[nodiscard]] Integer byte_of(const Rational& value) { return floor(value * 255 + Rational{1, 2}); }

[[nodiscard]] std::array<Integer, 4> model_bytes(float z) {
    const Rational v{z};
    const Integer whole = floor(v * power(24));
    const Integer red = floor(v * 256), green = floor(v * power(16)) - red * 256,
                  blue = whole - floor(v * power(16)) * 256;
    return {red, green, blue, byte_of(v * power(24) - Rational{whole})};
}

[[nodiscard]] float model_unpacked(const std::array<std::uint8_t, 4>& bytes) {
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
        const float texel = nearest_float(Rational{bytes[static_cast<std::size_t>(i)], 255});
        const Rational factor = i < 3 ? Rational{255, 256} * power(-8 * i) : power(-24);
        sum = nearest_float(Rational{sum} + Rational{nearest_float(Rational{texel} * factor)});
    }
    return sum;
}

}  // namespace

TEST_CASE("log2 is within 2^-50 of the real logarithm relative to it or to 1 for numbers of all sizes") {
    Random random{59};
    Wide worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const double v = i % 2 == 0 ? 1.0 + static_cast<double>(random_float(random, 0, 1)) * std::ldexp(1.0, -(i % 40))
                                    : std::ldexp(1.0 + static_cast<double>(random_float(random, 0, 1)), i % 100 - 20);
        const Wide real = log2(Wide{v}), size = abs(real) < 1 ? abs(real) : Wide{abs(real)};
        if (real == 0) {
            CHECK(log2_of(v) == 0.0);
            continue;
        }
        worst = std::max(worst, Wide{abs(Wide{log2_of(v)} - real) / size});
    }
    CHECK(worst < ldexp(Wide{1}, -49));
    for (int e = -30; e < 100; ++e) CHECK(log2_of(std::ldexp(1.0, e)) == e);
    CHECK(log2_of(0.0) == 0.0);
    CHECK(log2_of(-1.0) == 0.0);
}

TEST_CASE("the scale gives the far plane depth 1 and is 0 where there is no far plane") {
    for (const double far : {1.0, 10.0, 1000.0, 1e7}) {
        const float depth = logarithmic_depth(static_cast<float>(1 + far), log_scale_of(far));
        CHECK(std::abs(depth - 1.0f) <= 0x1p-22f);
    }
    CHECK(logarithmic_depth(1.0f, log_scale_of(100)) == 0.0f);
    CHECK(log_scale_of(0.0) == 0.0f);
    CHECK(log_scale_of(-5.0) == 0.0f);
    CHECK(log_scale_of(1e-30) == 0.0f);
    CHECK(log_scale_of(std::numeric_limits<double>::infinity()) == 0.0f);
    CHECK(log_scale_of(std::numeric_limits<double>::quiet_NaN()) == 0.0f);
}

TEST_CASE("packed depths are three digits in base 256 and a rest and are read back by rounded products and sums") {
    Random random{60};
    std::uint64_t wrong = 0;
    float most = 0;
    for (int i = 0; i < 20000; ++i) {
        const float z = std::ldexp(random_float(random, 0.5f, 1), -(i % 30));
        const auto bytes = pack_depth(z);
        const auto model = model_bytes(z);
        for (std::size_t k = 0; k < 4; ++k) wrong += Integer{bytes[k]} != model[k] ? 1 : 0;
        wrong += unpack_depth(bytes) != model_unpacked(bytes) ? 1 : 0;
        most = std::max(most, std::abs(unpack_depth(bytes) - z));
    }
    CHECK(wrong == 0);
    CHECK(most > 0);  // what is read back is not always what was written
    CHECK(most <= 0x1p-32f);
    for (int i = 0; i < 20000; ++i) {
        const float z = random_float(random, 0x1p-7f, 1);
        wrong += unpack_depth(pack_depth(z)) != z ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(unpack_depth(pack_depth(0.0f)) == 0.0f);
    CHECK(pack_depth(-1.0f) == pack_depth(0.0f));
    CHECK(pack_depth(1.0f) == std::array<std::uint8_t, 4>{255, 255, 255, 255});
    CHECK(pack_depth(2.0f) == pack_depth(1.0f));
}
