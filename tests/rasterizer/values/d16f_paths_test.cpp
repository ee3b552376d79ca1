// Tests that every depth path stores D16F codes, against the format's definition: 4 bits of exponent, 12 of mantissa, a
// code's value, and the greatest code whose value is at most the depth.
#include <catch2/catch.hpp>
#include <sstream>

#include "rasterizer/values/fragment_values.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr int size = 12;
constexpr FragmentNeeds depths{.exact_code = true, .color = false, .reference = true};
constexpr std::array all_paths{DepthPath::window_z, DepthPath::perspective_rq, DepthPath::depth_replace,
                               DepthPath::float32,  DepthPath::float32_plane,  DepthPath::exact};

// (1 + m / 4096) 2^(e - 7), and 0 for e = 0.
[[nodiscard]] Rational model_value(std::uint32_t code) {
    const std::uint32_t exponent = code >> 12, mantissa = code & 0xfff;
    return exponent == 0 ? Rational{0} : Rational{4096 + mantissa} * (1 << exponent) / (4096 * 128);
}

[[nodiscard]] std::uint32_t model_code(const Rational& v) {
    std::uint32_t low = 0xfff, high = 0x10000;  // codes below 0x1000 are 0
    while (high - low > 1) {
        const std::uint32_t middle = (low + high) / 2;
        (model_value(middle) <= v ? low : high) = middle;
    }
    return low == 0xfff ? 0 : low;
}

[[nodiscard]] RasterRules rules_of(WindowZ units, WindowZRule rule) {
    return {.subpixel_bits = 4,
            .window_z = units,
            .depth_rounding = DepthRounding::floor,
            .hypothesis = {.window_z = rule}};
}

// A triangle over the whole window whose corners have the depths `z`, in [0, 1].
[[nodiscard]] Geometry window_of(const std::array<double, 3>& z, const RasterRules& rules) {
    const double units = rules.window_z == WindowZ::buffer_units ? 511.9375 : 1.0;
    std::array<double, 3> vertex_z{};
    for (std::size_t i = 0; i < 3; ++i) vertex_z[i] = static_cast<float>(z[i] * units);
    Geometry geometry =
        window_geometry({window_triangle({{{-64, -64}, {1600, -64}, {-64, 1600}}}, 4, vertex_z)}, size, size, rules);
    geometry.state.depth_format = DepthFormat::d16f;
    geometry.extras = {.stride = 2, .has_rq = true, .values = {}};
    for (const double r : vertex_z) geometry.extras.values.insert(geometry.extras.values.end(), {float(r), 1.0f});
    return geometry;
}

struct Tally {
    std::uint64_t fragments = 0, wrong = 0;
    std::string first;
    void add(const Fragment& f, std::uint32_t found, std::uint32_t expected, DepthPath path) {
        ++fragments;
        if (found == expected || wrong++ > 0) return;
        std::ostringstream text;
        text << "path " << static_cast<int>(path) << " at " << f.x << "," << f.y << ": code " << found << ", not "
             << expected;
        first = text.str();
    }
};

}  // namespace

TEST_CASE("depth 32 of 511.9375 is D16F code 49152 on every depth path") {
    for (const WindowZRule rule : {WindowZRule::chip, WindowZRule::exact, WindowZRule::float32})
        for (const DepthPath path : all_paths) {
            const Geometry geometry =
                window_of({32 / 511.9375, 32 / 511.9375, 32 / 511.9375}, rules_of(WindowZ::buffer_units, rule));
            Tally tally;
            for (const Fragment& f : draw(geometry, {path, DepthFormat::d16f}, depths).fragments) {
                if (path == DepthPath::float32) continue;  // binary32 cannot represent 32 / 511.9375
                tally.add(f, f.code, 49152, path);
                tally.add(f, f.reference_code, 49152, path);
                tally.add(f, f.exact_code, 49152, path);
            }
            CHECK(tally.fragments == (path == DepthPath::float32 ? 0 : 3 * size * size));
            INFO(tally.first);
            CHECK(tally.wrong == 0);
        }
}

TEST_CASE("every depth path stores the D16F code of its value in buffer units and in the unit interval", "[slow]") {
    Random random{931};
    for (const WindowZ units : {WindowZ::buffer_units, WindowZ::unit_interval})
        for (const WindowZRule rule : {WindowZRule::chip, WindowZRule::exact, WindowZRule::float32})
            for (const DepthPath path : all_paths) {
                if (path == DepthPath::window_z && units == WindowZ::unit_interval)
                    continue;  // the chip has only buffer units
                Tally tally;
                std::uint64_t steps = 0;  // for path exact, whose binary64 value may be on the other side of a code
                for (int n = 0; n < 6; ++n) {
                    const auto z = [&] {
                        return double{random_float(random, -0.1f, 1.1f) * (n % 2 == 0 ? 1.0f : 0x1p-8f)};
                    };
                    const Geometry geometry = window_of({z(), z(), z()}, rules_of(units, rule));
                    for (const Fragment& f : draw(geometry, {path, DepthFormat::d16f}, depths).fragments) {
                        const std::uint32_t expected = model_code(Rational{f.reference_z});
                        steps += f.code != expected ? 1 : 0;
                        tally.add(f, f.reference_code, f.code, path);
                        if (path != DepthPath::exact) tally.add(f, f.code, expected, path);
                        // On every path the depth is that of the plane except for its last bits.
                        const std::uint32_t far = f.code > f.exact_code ? f.code - f.exact_code : f.exact_code - f.code;
                        tally.add(f, far > 1 ? far : 0, 0, path);
                    }
                }
                INFO(tally.first);
                CHECK(tally.fragments > 1000);
                CHECK(tally.wrong == 0);
                CHECK(steps < 8);
            }
}

TEST_CASE("a depth-only pass stores the D16F codes of a full pass") {
    const Geometry geometry = window_of({0.125, 0.5, 0.875}, rules_of(WindowZ::unit_interval, WindowZRule::chip));
    const DepthRequest depth{DepthPath::float32, DepthFormat::d16f};
    const auto alone = draw(geometry, depth, {.shader_z = false, .color = false}).fragments;
    const auto full = draw(geometry, depth, everything).fragments;
    REQUIRE(alone.size() == full.size());
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < alone.size(); ++i)
        wrong +=
            alone[i].code != full[i].code || full[i].code != model_code(Rational{full[i].shader_z} * Rational{511.9375})
                ? 1
                : 0;
    CHECK(alone.size() == size * size);
    CHECK(wrong == 0);
}

TEST_CASE("a depth of the unit interval becomes the greatest D16F code whose value is at most 511.9375 times it",
          "[slow]") {
    std::uint64_t wrong = 0;
    for (std::uint32_t code = 0; code < 0x10000; code += 7)
        for (const int step : {-1, 0, 1}) {
            const float v = d16f_value(code) / max_d16f;
            const float z = std::bit_cast<float>(std::bit_cast<std::uint32_t>(v) +
                                                 static_cast<std::uint32_t>(code == 0 ? 0 : step));
            const std::uint32_t expected = z >= 1.0f ? 0xffff : model_code(Rational{z} * Rational{511.9375});
            wrong += to_depth_code(z, DepthFormat::d16f, DepthRounding::nearest) != expected ? 1 : 0;
        }
    CHECK(wrong == 0);
}
