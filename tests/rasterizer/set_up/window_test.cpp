// Tests window positions against the division and the viewport in rational arithmetic, rounded where the rules say so.
#include "rasterizer/set_up/window.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] RasterState state_of(Rect viewport) {
    RasterState state;
    state.viewport = viewport;
    return state;
}

// Division by w and the viewport, by definition: a rational, rounded where the rule says so.
[[nodiscard]] float model_map(float c, float w, float scale, float offset, const RasterRules& rules) {
    const float divided = rules.w_divide == WDivide::quotient
                              ? nearest_float(Rational{c} / Rational{w})
                              : nearest_float(Rational{c} * Rational{nearest_float(Rational{1} / Rational{w})});
    const Rational product = Rational{scale} * Rational{divided};
    if (rules.viewport == ViewportArithmetic::fused) return nearest_float(product + Rational{offset});
    return nearest_float(Rational{nearest_float(product)} + Rational{offset});
}

}  // namespace

TEST_CASE("positions are truncated toward zero or rounded to the nearest subpixel with ties to even", "[slow]") {
    CHECK(snap(.5624f, 4, Snap::toward_zero) == 8);  // cases measured on hardware: rasterizer/reference/coverage.md 4.1
    CHECK(snap(.5625f, 4, Snap::toward_zero) == 9);
    CHECK(snap(-.0624f, 4, Snap::toward_zero) == 0);
    CHECK(snap(2.5f / 16, 4, Snap::nearest_even) == 2);
    CHECK(snap(3.5f / 16, 4, Snap::nearest_even) == 4);
    CHECK(snap(-2.5f / 16, 4, Snap::nearest_even) == -2);
    CHECK(snap(-32768.0f, 12, Snap::nearest_even) == -(1 << 27));
    Random random{31};
    std::uint64_t wrong = 0;
    for (int n = 0; n < 20000; ++n) {
        const float v = random_float(random, -1, 1) * (n % 2 == 0 ? 3.0f : 32768.0f);
        for (const int bits : {4, 8, 12}) {
            const Rational scaled = Rational{v} * power(bits);
            const Rational cut = snap(v, bits, Snap::toward_zero), near = snap(v, bits, Snap::nearest_even);
            wrong += abs(cut) > abs(scaled) || abs(scaled) - abs(cut) >= 1 ? 1 : 0;
            wrong += abs(near - scaled) > Rational{1, 2} ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

namespace {

// pipeline/reference/swiftshader-rasterizer.md 1.1: rounded to nearest, ties to even, in subpixels from the centre of
// the first pixel of the lowest row.
[[nodiscard]] Integer from_lowest_centre(float c, float w, int start, int size, int bits) {
    const Rounded divided = Rounded{c} * (Rounded{1} / Rounded{w});
    const Rounded scale{static_cast<float>(size) / 2}, middle{static_cast<float>(start) + static_cast<float>(size) / 2};
    const Rational scaled = Rational{(scale * divided + (middle - Rounded{0.5f})).v} * power(bits);
    Integer below = floor(scaled);
    const Rational rest = scaled - Rational{below};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && below % 2 != 0)) ++below;
    return below;
}

}  // namespace

TEST_CASE("half a pixel is subtracted before the rounding and y is measured from below if the axis is clip space's",
          "[slow]") {
    Random random{33};
    const Rect viewport{17, 5, 17 + 333, 5 + 257};
    std::uint64_t wrong = 0, turned = 0;
    for (int n = 0; n < 20000; ++n) {
        const int bits = n % 2 == 0 ? 4 : 8;
        const bool is_up = n % 3 != 0;
        RasterState state = state_of(viewport);
        state.y_direction = is_up ? YDirection::up : YDirection::down;
        ClipVertex v;
        v.w = random_float(random, 0.3f, 40);
        v.x = random_float(random, -1, 1) * v.w;
        v.y = random_float(random, -1, 1) * v.w;
        RasterRules rules{.subpixel_bits = bits,
                          .w_divide = WDivide::reciprocal,
                          .viewport = ViewportArithmetic::half_pixel_first,
                          .y_axis = YAxis::clip};
        const WindowTransform window{state, rules};
        const Integer x = from_lowest_centre(v.x, v.w, 17, 333, bits);
        const Integer y = from_lowest_centre(v.y, v.w, is_up ? 0 : 5, 257, bits);
        const Integer half = 1 << (bits - 1), rows = Integer{5 + 257} << bits;
        const SubpixelPoint found = window.snapped(window.project(v)), counted = window.from_first_centre(v);
        wrong += found.x == x + half && found.y == (is_up ? Integer{rows - y - half} : Integer{y + half}) ? 0 : 1;
        wrong += counted.x == x && counted.y == y && window.is_turned() == is_up ? 0 : 1;
        wrong += window.counted_row(9) == (is_up ? 252 : 9) ? 0 : 1;
        const auto position = window.position(window.project(v));
        wrong += std::abs(position[0] * static_cast<float>(1 << bits) - static_cast<float>(found.x)) <= 0.51f ? 0 : 1;
        wrong += std::abs(position[1] * static_cast<float>(1 << bits) - static_cast<float>(found.y)) <= 0.51f ? 0 : 1;
        rules.viewport = ViewportArithmetic::separate;
        const WindowTransform whole{state, rules};
        rules.y_axis = YAxis::memory;
        const WindowTransform memory{state, rules};
        turned += memory.snapped(memory.project(v)) == whole.snapped(whole.project(v)) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(turned > 0);
}

TEST_CASE("subtracting half a pixel first changes a position that otherwise rounds to the middle of two subpixels") {
    // Above 1024 the unit in the last place is 2^-13: 1024 + 3/32 - 2^-14 rounds up to a tie of sixteenths. Below 1024
    // it is exact.
    const RasterState state = state_of({960, 0, 1088, 64});
    const auto snapped = [&](float x, ViewportArithmetic arithmetic) {
        const WindowTransform window{state, {.subpixel_bits = 4, .viewport = arithmetic}};
        ClipVertex v;
        v.x = x / 64;
        return window.snapped(window.project(v)).x;
    };
    using enum ViewportArithmetic;
    CHECK(snapped(3.0f / 32 - 0x1p-14f, separate) == 1024 * 16 + 2);
    CHECK(snapped(3.0f / 32 - 0x1p-14f, half_pixel_first) == 1024 * 16 + 1);
    CHECK(snapped(3.0f / 32, half_pixel_first) == 1024 * 16 + 2);
}

TEST_CASE("a vertex out of the 32-bit range is set to the least integer and its w of 0 to 1") {
    const WindowTransform window{state_of({0, 0, 64, 64}), {.subpixel_bits = 4, .w_divide = WDivide::reciprocal}};
    const auto at = [&](float x, float w) {
        ClipVertex v;
        v.x = x;
        v.w = w;
        return window.from_first_centre(v).x;
    };
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    CHECK(at(0.5f, 0.0f) == 48 * 16 - 8);
    CHECK(at(0.5f, 1.0f) == 48 * 16 - 8);
    CHECK(at(0.5f, -1.0f) == 16 * 16 - 8);
    CHECK(at(1e9f, 1.0f) == least);
    CHECK(at(-1e9f, 1.0f) == least);
    CHECK(at(std::numeric_limits<float>::quiet_NaN(), 1.0f) == least);
}

TEST_CASE("given window positions are not offset by half a pixel and their axis is not reversed") {
    RasterState state = state_of({0, 0, 64, 64});
    state.window_positions = true;
    const WindowTransform window{
        state, {.subpixel_bits = 4, .viewport = ViewportArithmetic::half_pixel_first, .y_axis = YAxis::clip}};
    ClipVertex v;
    v.x = 10.25f;
    v.y = 3.5f;
    CHECK(window.snapped(window.project(v)) == SubpixelPoint{164, 56});
    CHECK(window.from_first_centre(v) == SubpixelPoint{156, 48});
    CHECK_FALSE(window.is_turned());
}

TEST_CASE("window positions are the rounded operations of the rule for every division and viewport arithmetic",
          "[slow]") {
    constexpr std::uint64_t seed = 32;
    Random random{seed};
    std::uint64_t wrong = 0, differences = 0;
    for (const WDivide divide : {WDivide::quotient, WDivide::reciprocal})
        for (const ViewportArithmetic arithmetic : {ViewportArithmetic::separate, ViewportArithmetic::fused})
            for (int n = 0; n < 3000; ++n) {
                const RasterRules rules{.w_divide = divide, .viewport = arithmetic};
                RasterState state = state_of({17, 5, 17 + 641, 5 + 479});
                state.depth_near = random_float(random, 0, 1);
                state.depth_far = random_float(random, 0, 1);
                ClipVertex v;
                v.w = random_float(random, 0.01f, 40);
                v.x = random_float(random, -1.2f, 1.2f) * v.w;
                v.y = random_float(random, -1.2f, 1.2f) * v.w;
                v.z = random_float(random, -1, 1) * v.w;
                const WindowVertex found = WindowTransform{state, rules}.project(v);
                const Rational near{state.depth_near}, far{state.depth_far};
                wrong += found.x != model_map(v.x, v.w, 320.5f, 337.5f, rules) ? 1 : 0;
                wrong += found.y != model_map(v.y, v.w, -239.5f, 244.5f, rules) ? 1 : 0;
                wrong += found.z != model_map(v.z, v.w, nearest_float((far - near) / 2),
                                              nearest_float((far + near) / 2), rules)
                             ? 1
                             : 0;
                wrong += found.inverse_w != nearest_float(Rational{1} / Rational{v.w}) ? 1 : 0;
                const RasterRules other{.w_divide = WDivide::quotient, .viewport = ViewportArithmetic::separate};
                differences += found.x != WindowTransform{state, other}.project(v).x ? 1 : 0;
            }
    INFO("seed " << seed);
    CHECK(wrong == 0);
    CHECK(differences > 1000);  // the rules give different results
}

TEST_CASE("fused viewport arithmetic rounds once where two roundings would meet a tie", "[slow]") {
    Random random{33};
    std::uint64_t wrong = 0, twice = 0;
    for (int n = 0; n < 20000; ++n) {
        const auto few_bits = [&](int bits) { return static_cast<float>(random_int(random, 1, (1 << bits) - 1)); };
        const float a = few_bits(12), b = few_bits(13) + 0x1p-10f;
        const float c = few_bits(24) * (n % 2 == 0 ? 0x1p-34f : -0x1p-30f);
        const float found = fused_multiply_add(a, b, c);
        wrong += found != nearest_float(Rational{a} * Rational{b} + Rational{c}) ? 1 : 0;
        twice += found != a * b + c ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(twice > 0);
}

TEST_CASE("window positions beyond the guard band are clamped to its border on each side and axis and NaN is kept") {
    RasterState state = state_of({0, 0, 64, 64});
    state.window_positions = true;
    const WindowTransform transform{state, {.subpixel_bits = 12, .guard_band_px = 32768}};
    for (const float far : {32768.0f, 32769.0f, 40000.0f, 1e9f, std::numeric_limits<float>::infinity()})
        for (const float sign : {-1.0f, 1.0f}) {
            const WindowVertex x = transform.project({.x = sign * far, .y = 3, .z = 0.25f, .w = 1}),
                               y = transform.project({.x = 3, .y = sign * far, .z = 0.25f, .w = 1});
            CHECK(x.x == sign * 32768.0f);
            CHECK(x.y == 3.0f);
            CHECK(y.x == 3.0f);
            CHECK(y.y == sign * 32768.0f);
            CHECK(transform.snapped(x).x == static_cast<int>(sign) * (1 << 27));
        }
    const float inside = 32767.998f;
    CHECK(transform.project({.x = inside, .y = -inside, .z = 0, .w = 1}).x == inside);
    CHECK(transform.project({.x = inside, .y = -inside, .z = 0, .w = 1}).y == -inside);
    CHECK(std::isnan(transform.project({.x = std::nanf(""), .y = 0, .z = 0, .w = 1}).x));
}

TEST_CASE("a guard band that exceeds the range of edge functions is limited to 2^27 subpixels") {
    RasterState state = state_of({0, 0, 64, 64});
    state.window_positions = true;
    constexpr std::pair<int, float> widest[] = {{4, 524288.0f}, {8, 524288.0f}, {12, 32768.0f}};
    for (const auto& [bits, pixels] : widest) {
        const WindowTransform transform{state, {.subpixel_bits = bits, .guard_band_px = 524288}};
        CHECK(transform.project({.x = 1e9f, .y = -1e9f, .z = 0, .w = 1}).x == pixels);
        CHECK(transform.project({.x = 1e9f, .y = -1e9f, .z = 0, .w = 1}).y == -pixels);
    }
}

TEST_CASE("with y up clip-space +1 is on the first row and with y down on the last") {
    RasterState state = state_of({0, 0, 64, 32});
    const ClipVertex top{0, 1, 0, 1, {}, {}, {}};
    CHECK(WindowTransform{state, {}}.project(top).y == 0.0f);
    state.y_direction = YDirection::down;
    CHECK(WindowTransform{state, {}}.project(top).y == 32.0f);
}

TEST_CASE("depth ranges map clip depth as specified and reversed and in buffer units") {
    for (const ClipDepth convention : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one}) {
        RasterState state = state_of({0, 0, 8, 8});
        state.clip_depth = convention;
        state.depth_format = DepthFormat::d24;
        const float lowest = convention == ClipDepth::minus_one_to_one ? -2.0f : 0.0f;
        const auto z = [&](float clip_z, const RasterRules& rules) {
            return WindowTransform{state, rules}.project({0, 0, clip_z, 2, {}, {}, {}}).z;
        };
        const RasterRules units{.window_z = WindowZ::buffer_units};
        CHECK(z(lowest, {}) == 0.0f);
        CHECK(z(2.0f, {}) == 1.0f);
        CHECK(z(2.0f, units) == 16777215.0f);
        state.depth_near = 0.75f;
        state.depth_far = 0.25f;
        CHECK(z(lowest, {}) == 0.75f);
        CHECK(z(2.0f, {}) == 0.25f);
        state.depth_format = DepthFormat::d32f;
        CHECK(z(2.0f, units) == 0.25f);  // a float buffer has no units
    }
}

TEST_CASE("a grid of 0 to 12 bits gives the fragments of vertices that were rounded to it before") {
    for (int bits = 0; bits <= 12; ++bits)
        for (const Snap rule : {Snap::nearest_even, Snap::toward_zero}) {
            Random random{59};
            TriangleSoup given, rounded;
            const Rational unit = power(-bits);
            for (std::uint32_t i = 0; i < 90; ++i) {
                const float x = random_float(random, 1, 31), y = random_float(random, 1, 31),
                            z = random_float(random, 0, 1);
                const auto on_grid = [&](float v) {
                    const Rational scaled = Rational{v} / unit;
                    Integer n = floor(scaled);
                    const Rational rest = scaled - Rational{n}, half{1, 2};
                    if (rule == Snap::nearest_even && (rest > half || (rest == half && (n & 1) != 0))) ++n;
                    return nearest_float(Rational{n} * unit);
                };
                given.vertices.push_back({.x = x, .y = y, .z = z});
                rounded.vertices.push_back({.x = on_grid(x), .y = on_grid(y), .z = z});
                given.indices.push_back(i);
                rounded.indices.push_back(i);
            }
            given.runs = rounded.runs = {{.index_count = 90}};
            RasterState state = state_of({0, 0, 32, 32});
            state.window_positions = true;  // positions in pixels, without a viewport
            RasterRules fine{.subpixel_bits = 12, .snap = rule}, own{.subpixel_bits = bits, .snap = rule};
            const Geometry set = set_up(given, state, own, 1);
            const auto found = draw(set, {DepthPath::float32, DepthFormat::d32f}).fragments;
            const auto expected =
                draw(set_up(rounded, state, fine, 1), {DepthPath::float32, DepthFormat::d32f}).fragments;
            INFO(bits << " bits");
            CHECK(found.size() > 500);
            CHECK(by_pixel(found) == by_pixel(expected));
            CHECK(set.rules.subpixel_bits - set.rules.unused_bits == bits);
            CHECK(set.rules.subpixel_bits % 4 == 0);
        }
}
