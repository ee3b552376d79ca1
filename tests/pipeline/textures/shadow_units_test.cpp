// Tests the units of R in shadow comparisons against rational arithmetic: R in the units of the texels, compared as a
// depth write stores it, or unquantised.
#include <catch2/catch.hpp>
#include <memory>

#include "pipeline/textures/shadow_compare.h"
#include "tests/pipeline/addressing_model.h"

namespace {

using namespace strata::pipeline;
using model::Rational;
using strata::rasterizer::WindowZ;

struct ShadowDevice {
    DepthFormat format;
    WindowZ convention;
    DepthRounding rounding;
    bool quantizes;
};

[[nodiscard]] std::vector<ShadowDevice> shadow_devices() {
    std::vector<ShadowDevice> all;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
        for (const WindowZ convention : {WindowZ::unit_interval, WindowZ::buffer_units})
            for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest})
                for (const bool quantizes : {true, false}) all.push_back({format, convention, rounding, quantizes});
    return all;
}

// R as it is compared, in codes.
[[nodiscard]] Rational compared_r(const ShadowDevice& device, float r) {
    const Rational top = device.format == DepthFormat::d16 ? 65535 : 16777215;
    if (is_nan(r) || r <= 0) return 0;
    if (r > 3e38f) return top;  // including infinity
    const Rational scaled = device.convention == WindowZ::buffer_units ? Rational{r} : Rational{r} * top;
    if (scaled >= top) return top;
    if (!device.quantizes) return scaled;
    return Rational{model::floor(scaled + (device.rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0}))};
}

[[nodiscard]] bool shadow_passes(const ShadowDevice& device, CompareFunc func, std::uint32_t texel, float r) {
    static const auto lanes = std::make_unique<std::array<strata::rasterizer::Lanes<float>, 3>>();
    static const auto rgba = std::make_unique<std::array<strata::rasterizer::Lanes<float>, 4>>();
    DeviceProfile profile;
    profile.raster.window_z = device.convention;
    profile.raster.depth_rounding = device.rounding;
    profile.raster.hypothesis.quantize_reference = device.quantizes;
    Image image{target_format(device.format), 1, 1};
    image.codes[0] = texel;
    (*lanes)[0][0] = (*lanes)[1][0] = 0.5f, (*lanes)[2][0] = r;
    shadow_compare(image, {.func = func}, profile, {(*lanes)[0], (*lanes)[1], (*lanes)[2]}, *rgba, 1);
    return (*rgba)[0][0] == 1.0f;
}

}  // namespace

TEST_CASE(
    "R is compared in the texels' units on every device as 0 to 1 or as codes and rounded down or to nearest or not",
    "[slow]") {
    Random random{721};
    Tally tally;
    for (const ShadowDevice& device : shadow_devices()) {
        const std::uint32_t top = device.format == DepthFormat::d16 ? 65535 : 16777215;
        for (int n = 0; n < 400; ++n) {
            const std::uint32_t texel = n % 5 == 0 ? top : n % 7 == 0 ? 0 : below(random, top + 1);
            // offset in codes
            const double beside = static_cast<double>(static_cast<int>(below(random, 17)) - 8) / 4.0;
            const double code = static_cast<double>(texel) + beside;
            float r = static_cast<float>(device.convention == WindowZ::buffer_units ? code : code / top);
            if (n % 11 == 0) r = any_float(random);
            for (const CompareFunc func : {CompareFunc::less, CompareFunc::equal, CompareFunc::lequal,
                                           CompareFunc::greater, CompareFunc::notequal, CompareFunc::gequal}) {
                const Rational own = compared_r(device, r), other{texel};
                const bool expected = model_compare(func, own < other ? -1 : own > other ? 1 : 0, 0);
                tally.expect(shadow_passes(device, func, texel, r) == expected, [&] {
                    return fmt::format("R {:08x} against {} of {}, func {}, quantizes {}", bits_of(r), texel, top,
                                       static_cast<int>(func), device.quantizes);
                });
            }
        }
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() > 30000);
}

TEST_CASE("an unquantised depth between two codes passes EQUAL with neither and beyond the range it equals the last") {
    const ShadowDevice exact{DepthFormat::d16, WindowZ::buffer_units, DepthRounding::nearest, false};
    CHECK_FALSE(shadow_passes(exact, CompareFunc::equal, 1000, 1000.25f));
    CHECK_FALSE(shadow_passes(exact, CompareFunc::equal, 1001, 1000.25f));
    CHECK(shadow_passes(exact, CompareFunc::greater, 1000, 1000.25f));
    CHECK(shadow_passes(exact, CompareFunc::equal, 65535, 1e9f));
    CHECK(shadow_passes(exact, CompareFunc::equal, 0, -5.0f));
    const ShadowDevice cuts{DepthFormat::d16, WindowZ::buffer_units, DepthRounding::floor, true};
    CHECK(shadow_passes(cuts, CompareFunc::equal, 1000, 1000.75f));
    const ShadowDevice rounds{DepthFormat::d16, WindowZ::buffer_units, DepthRounding::nearest, true};
    CHECK(shadow_passes(rounds, CompareFunc::equal, 1001, 1000.5f));
}
