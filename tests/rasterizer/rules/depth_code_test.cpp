// Tests depth codes against an inequality over integers: k is correct for z exactly if k <= z (2^n - 1) < k + 1 (floor)
// or k - 1/2 <= z (2^n - 1) < k + 1/2 (nearest), with z = mantissa / 2^shift.
#include "rasterizer/rules/depth_code.h"

#include <array>
#include <atomic>
#include <catch2/catch.hpp>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/parallel.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::rasterizer;
__extension__ using Wide = __int128;

[[nodiscard]] bool is_right_inside(std::uint32_t code, std::uint32_t bits, Wide max, DepthRounding rounding) {
    const std::uint32_t field = bits >> 23;
    const Wide mantissa = (bits & 0x7fffffu) | (field == 0 ? 0u : 0x800000u);
    const int shift = 150 - static_cast<int>(field == 0 ? 1 : field);  // at least 24 below 1.0
    if (shift >= 60) return code == 0;                                 // z (2^24 - 1) < 2^(24 - 60 + 24) < 1/2
    const Wide doubled = 2 * mantissa * max, low = 2 * Wide{code} - (rounding == DepthRounding::nearest ? 1 : 0);
    return (low << shift) <= doubled && doubled < ((low + 2) << shift);
}

[[nodiscard]] bool is_right(std::uint32_t bits, DepthFormat format, DepthRounding rounding) {
    const std::uint32_t code = to_depth_code(std::bit_cast<float>(bits), format, rounding);
    const std::uint32_t max = format == DepthFormat::d16 ? 65535 : 16777215;
    const bool is_nan = (bits & 0x7fffffffu) > 0x7f800000u;
    if (is_nan || (bits >> 31) != 0) return code == 0;
    if (bits >= 0x3f800000u) return code == max;
    return is_right_inside(code, bits, max, rounding);
}

[[nodiscard]] std::uint64_t wrong_among(std::uint32_t first, std::uint32_t step, std::uint64_t count) {
    std::uint64_t wrong = 0;
    std::uint32_t bits = first;
    for (std::uint64_t i = 0; i < count; ++i, bits += step)
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
            for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest})
                wrong += is_right(bits, format, rounding) ? 0 : 1;
    return wrong;
}

}  // namespace

namespace {

// Uses nearest_float of rational.h.
[[nodiscard]] Rational float_product(float z, std::uint32_t max) {
    return Rational{nearest_float(Rational{z} * Rational{max})};
}

// Ties go to the even integer, by definition.
[[nodiscard]] std::uint32_t product_code(float z, std::uint32_t max) {
    const Rational product = float_product(z, max);
    const Integer below = floor(product);
    const Rational rest = product - Rational{below};
    const bool rises = rest > Rational{1, 2} || (rest == Rational{1, 2} && (below & 1) != 0);
    return (below + (rises ? 1 : 0)).convert_to<std::uint32_t>();
}

}  // namespace

TEST_CASE("product_even rounds the product in binary32 and then to the nearest code with ties to even", "[slow]") {
    std::uint64_t wrong = 0, unlike_nearest = 0;
    const auto check = [&](float z) {
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
            const std::uint32_t code = to_depth_code(z, format, DepthRounding::product_even);
            wrong += code == product_code(z, max_code(format)) ? 0 : 1;
            unlike_nearest += code == to_depth_code(z, format, DepthRounding::nearest) ? 0 : 1;
        }
        CHECK(to_depth_code(z, DepthFormat::d32f, DepthRounding::product_even) == std::bit_cast<std::uint32_t>(z));
    };
    for (std::uint32_t k = 0; k < 4000; ++k) check(static_cast<float>(2 * k + 1) / 131070.0f);
    for (std::uint32_t k = 0; k < 4000; ++k) check(std::bit_cast<float>(0x3e000000u + k * 4093u));
    CHECK(wrong == 0);
    CHECK(unlike_nearest > 100);
    CHECK(to_depth_code(2.0f, DepthFormat::d24, DepthRounding::product_even) == 0xffffffu);
    CHECK(to_depth_code(std::bit_cast<float>(0x7fc00000u), DepthFormat::d24, DepthRounding::product_even) == 0);
}

TEST_CASE("product_floor truncates the binary32 product for 16 bits and the exact one for 24") {
    std::uint64_t wrong = 0, unlike_floor = 0;
    const auto check = [&](float z) {
        const std::uint32_t code = to_depth_code(z, DepthFormat::d16, DepthRounding::product_floor);
        wrong += code == floor(float_product(z, 65535)).convert_to<std::uint32_t>() ? 0 : 1;
        unlike_floor += code == to_depth_code(z, DepthFormat::d16, DepthRounding::floor) ? 0 : 1;
        for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f, DepthFormat::d24f})
            wrong +=
                to_depth_code(z, format, DepthRounding::product_floor) == to_depth_code(z, format, DepthRounding::floor)
                    ? 0
                    : 1;
    };
    for (std::uint32_t k = 1; k <= 65535; k += 13)  // just below a code the product rounds up to it
        for (const float z : {static_cast<float>(k) / 65535.0f, std::nextafter(static_cast<float>(k) / 65535.0f, 0.0f)})
            check(z);
    for (std::uint32_t k = 0; k < 4000; ++k) check(std::bit_cast<float>(0x3e000000u + k * 4093u));
    CHECK(wrong == 0);
    CHECK(unlike_floor > 100);
    CHECK(to_depth_code(2.0f, DepthFormat::d16, DepthRounding::product_floor) == 0xffffu);
    CHECK(to_depth_code(std::bit_cast<float>(0x7fc00000u), DepthFormat::d16, DepthRounding::product_floor) == 0);
    CHECK((truncates(DepthRounding::floor) && truncates(DepthRounding::product_floor)));
    CHECK((!truncates(DepthRounding::nearest) && !truncates(DepthRounding::product_even)));
}

TEST_CASE(
    "under DepthLimits::wrap a code is the signed integer of the scaled depth in 32 bits and D32F keeps the depth") {
    const auto code = [](float z, DepthFormat format, DepthRounding rounding) {
        return to_wrapped_code(z, depth_conversion(format, rounding, 1.0f));
    };
    // Codes that a driver drew, and values that it read back from the low bits.
    CHECK(code(-1e-9f, DepthFormat::d24, DepthRounding::floor) == 0);
    CHECK(code(-1e-7f, DepthFormat::d24, DepthRounding::floor) == 0xffffffffu);
    CHECK((code(-1e-5f, DepthFormat::d24, DepthRounding::floor) & 0xffffffu) == 0xffff59u);
    CHECK((code(-0.5f, DepthFormat::d16, DepthRounding::product_floor) & 0xffffu) == 0x8001u);
    CHECK(code(1.00000012f, DepthFormat::d24, DepthRounding::floor) == 0x1000000u);
    CHECK((code(1.5f, DepthFormat::d24, DepthRounding::floor) & 0xffffffu) == 0x7ffffeu);
    CHECK((code(1.5f, DepthFormat::d16, DepthRounding::product_floor) & 0xffffu) == 0x7ffeu);
    std::uint64_t wrong = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const float z = -2.0f + 0.00024931f * static_cast<float>(trial);
        wrong += code(z, DepthFormat::d32f, DepthRounding::nearest) == std::bit_cast<std::uint32_t>(z) ? 0 : 1;
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
            for (const DepthRounding rounding : strata::enum_values<DepthRounding>) {
                const std::uint32_t found = code(z, format, rounding), max = max_code(format);
                if (z >= 0.0f && z < 1.0f) {
                    wrong += found == to_depth_code(z, format, rounding) ? 0 : 1;
                    continue;
                }
                wrong += is_beyond_range(found, format) || found == 0 || found == max ? 0 : 1;
                // The magnitude in rational arithmetic, then its sign.
                const bool is_product = rounding == DepthRounding::product_even ||
                                        (rounding == DepthRounding::product_floor && format == DepthFormat::d16);
                const float size = z < 0 ? -z : z;
                const Rational exact = is_product ? float_product(size, max) : Rational{size} * Rational{max};
                Integer whole = floor(exact);
                const Rational rest = exact - Rational{whole}, half{1, 2};
                if (rounding == DepthRounding::nearest && rest >= half) ++whole;
                if (rounding == DepthRounding::product_even && (rest > half || (rest == half && (whole & 1) != 0)))
                    ++whole;
                const auto magnitude = whole.convert_to<std::uint32_t>();
                wrong += found == (z < 0 ? 0u - magnitude : magnitude) ? 0 : 1;
            }
    }
    CHECK(wrong == 0);
    CHECK(code(std::bit_cast<float>(0x7fc00000u), DepthFormat::d24, DepthRounding::floor) == 0);
    CHECK(code(1e30f, DepthFormat::d24, DepthRounding::floor) == 0);
}

TEST_CASE("sampled floats of all kinds become the D16 and D24 codes of the rule with ties up") {
    CHECK(wrong_among(0, 9973, 0x100000000ull / 9973) == 0);
    CHECK(wrong_among(0x3f000000u - 5000, 1, 10000) == 0);
    CHECK(wrong_among(0x3f800000u - 100000, 1, 100010) == 0);
}

TEST_CASE("all 2^32 floats become the D16 and D24 codes of the rule", "[exhaustive]") {
    std::atomic<std::uint64_t> wrong{0};
    strata::parallel_for(
        256, 0, [&](std::size_t block) { wrong += wrong_among(static_cast<std::uint32_t>(block << 24), 1, 1u << 24); });
    CHECK(wrong == 0);
}

TEST_CASE("a D32F code is the clamped float itself and zeros are +0 and codes are ordered like the floats") {
    std::uint64_t wrong = 0;
    std::uint32_t last = 0;
    for (std::uint64_t wide = 0; wide < 0x100000000ull; wide += 4099) {
        const auto bits = static_cast<std::uint32_t>(wide);
        const auto z = std::bit_cast<float>(bits);
        const std::uint32_t code = to_depth_code(z, DepthFormat::d32f, DepthRounding::nearest);
        const float clamped = !(z > 0) ? 0.0f : (z > 1 ? 1.0f : z);
        wrong += code != std::bit_cast<std::uint32_t>(clamped) ? 1 : 0;
        if (bits <= 0x3f800000u) {
            wrong += code < last ? 1 : 0;
            last = code;
        }
    }
    CHECK(wrong == 0);
    CHECK(to_depth_code(-0.0f, DepthFormat::d32f, DepthRounding::nearest) == 0);
}

TEST_CASE("depth 1 is the largest code and a code that is read back gives itself") {
    std::uint64_t wrong = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        CHECK(to_depth_code(1.0f, format, DepthRounding::floor) == max_code(format));
    for (std::uint32_t k = 0; k <= 0xffff; ++k)
        wrong += to_depth_code(static_cast<float>(depth_value(k, DepthFormat::d16)), DepthFormat::d16,
                               DepthRounding::nearest) != k;
    CHECK(wrong == 0);
}
