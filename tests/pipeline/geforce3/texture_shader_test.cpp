// Tests each texture shader operation on batches made by hand, against rational arithmetic or a table of the extension.
#include "pipeline/geforce3/texture_shader.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "pipeline/device/profile.h"
#include "tests/pipeline/addressing_model.h"

using namespace strata::pipeline;
using model::Rational;
using strata::rasterizer::DepthPath;
using strata::rasterizer::FragmentBatch;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
using Coordinate = std::array<float, 4>;

// Runs four stages on one fragment after the other and holds the results.
struct Bench {
    ShaderStages stages{};
    ShaderDevice machine;
    std::unique_ptr<FragmentBatch> batch = std::make_unique<FragmentBatch>();
    std::unique_ptr<ShaderResults> out = std::make_unique<ShaderResults>();

    explicit Bench(const char* profile = "geforce3") {
        machine.profile = find_profile(profile);
        machine.depth = {DepthPath::window_z, DepthFormat::d16};
    }
    void put(std::size_t unit, Coordinate c) {
        for (std::size_t k = 0; k < 4; ++k) batch->unit[unit][k][0] = c[k];
    }
    ShaderOps run() {
        batch->count = 1;
        const ShaderOps ops = consistent_operations(stages);
        run_texture_shader(stages, ops, machine, *batch, *out);
        return ops;
    }
    [[nodiscard]] bool alive() const { return out->alive[0] != 0; }
    [[nodiscard]] std::uint32_t code() const { return out->code[0]; }
    [[nodiscard]] float dot(std::size_t stage) const { return out->stage[stage].dot[0]; }
    [[nodiscard]] Coordinate rgba(std::size_t stage) const {
        const auto& c = out->stage[stage].rgba;
        return {c[0][0], c[1][0], c[2][0], c[3][0]};
    }
};

// A texture whose texels encode their position: red the column, green the row.
Texture place_texture(TextureTarget target, int width, int height) {
    Texture texture{.name = "place",
                    .target = target,
                    .width = width,
                    .height = height,
                    .filter = TextureFilter::nearest,
                    .wrap_s = TextureWrap::clamp_to_edge,
                    .wrap_t = TextureWrap::clamp_to_edge,
                    .texels = {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int k : {x, y, 255, 128}) texture.texels.push_back(static_cast<std::uint8_t>(k));
    return texture;
}

HiloTexture hilo(std::uint16_t high, std::uint16_t low, bool is_signed = false) {
    HiloTexture texture;
    texture.is_signed = is_signed;
    texture.texels = {{high, low}};
    return texture;
}

// Stages 0 to 2 of Everitt's Listing 2: depth = r1 / r2.
struct DepthReplaceBench : Bench {
    HiloTexture zero = hilo(0, 0);
    DepthReplaceBench() {
        stages[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &zero}};
        stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
        stages[2] = {.op = ShaderOp::dot_product_depth_replace, .previous = 0, .texture = {}};
        put(0, {0, 0, 0, 1});
    }
    void divide(float numerator, float denominator) {
        put(1, {0, 0, numerator, 1});
        put(2, {0, 0, denominator, 1});
        static_cast<void>(run());
    }
};

}  // namespace

TEST_CASE("a lookup is at s/q and t/q in normalised coordinates in a 2D texture and in texels in a rectangle") {
    Random random{311};
    Tally tally;
    for (const TextureTarget target : {TextureTarget::two_d, TextureTarget::rectangle}) {
        const Texture texture = place_texture(target, 16, 8);
        Bench bench;
        bench.stages[2] = {.op = target == TextureTarget::two_d ? ShaderOp::texture_2d : ShaderOp::texture_rectangle,
                           .texture = {.color = &texture}};
        for (int round = 0; round < 4000; ++round) {
            // Multiples of 1/16 texel divided by a power of two: the quotient is exact, and so is its texel.
            const float q = one_in(random, 2) ? 4.0f : 0.125f;
            const auto coordinate = [&] {
                return static_cast<float>(static_cast<int>(below(random, 400)) - 50) / 16.0f;
            };
            const float s = coordinate(), t = coordinate(), unit = target == TextureTarget::two_d ? 1.0f / 16.0f : 1.0f;
            bench.put(2, {s * unit * q, t * unit * q, 77.0f, q});
            static_cast<void>(bench.run());
            const auto texel = [](float u, int size) {
                return std::clamp(static_cast<int>(std::floor(u)), 0, size - 1);
            };
            const int x = texel(s, 16), y = texel(target == TextureTarget::two_d ? t / 2 : t, 8);
            const Coordinate expected{static_cast<float>(x) / 255.0f, static_cast<float>(y) / 255.0f, 1.0f,
                                      128.0f / 255.0f};
            tally.expect(bench.rgba(2) == expected, [&] { return fmt::format("s {} t {} q {}", s, t, q); });
        }
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("pass-through truncates coordinates to 8 bits on a device with 8-bit textures and otherwise clamps them") {
    Random random{312};
    Tally tally;
    Bench cuts{"geforce3"}, keeps{"ideal"};
    for (int round = 0; round < 4000; ++round) {
        Coordinate c;
        for (float& x : c) x = any_float(random);
        for (Bench* bench : {&cuts, &keeps}) {
            bench->stages[1].op = ShaderOp::pass_through;
            bench->put(1, c);
            static_cast<void>(bench->run());
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const float clamped = is_nan(c[k]) || c[k] < 0 ? 0.0f : std::min(c[k], 1.0f);
            const model::Integer fixed = model::floor(Rational{clamped} * 4096);
            const auto code = static_cast<int>(model::floor(Rational{fixed - model::floor(Rational{fixed, 256}), 16}));
            tally.expect(cuts.rgba(1)[k] == static_cast<float>(code) / 255.0f && keeps.rgba(1)[k] == clamped,
                         [&] { return fmt::format("coordinate {:#010x}", bits_of(c[k])); });
        }
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("a fragment is culled if any coordinate has the wrong sign and zero is not negative") {
    const std::array<float, 8> values{-1.0f, -0x1p-149f, -0.0f, 0.0f, 0x1p-149f, 1.0f, infinity, not_a_number};
    std::size_t wrong = 0;
    for (std::size_t component = 0; component < 4; ++component)
        for (const CullMode mode : {CullMode::gequal, CullMode::less})
            for (const float value : values) {
                Bench bench;
                bench.stages[3].op = ShaderOp::cull_fragment;
                bench.stages[3].cull[component] = mode;  // the other stages cull by gequal on 0
                Coordinate c{0, 0, 0, 0};
                c[component] = value;
                bench.put(3, c);
                static_cast<void>(bench.run());
                const bool negative = std::signbit(value) && value != 0.0f;
                const bool lives = !is_nan(value) && (mode == CullMode::less) == negative;
                wrong += bench.alive() != lives || bench.rgba(3) != Coordinate{} ? 1 : 0;
            }
    CHECK(wrong == 0);
}

TEST_CASE("a dot product multiplies s t r with HI LO 1 or with a colour and is not divided by q") {
    Random random{313};
    Tally tally;
    const Texture color = place_texture(TextureTarget::two_d, 16, 8);
    for (int round = 0; round < 2000; ++round) {
        const bool is_hilo = one_in(random, 2), expands = one_in(random, 2);
        const auto high = static_cast<std::uint16_t>(random()), low = static_cast<std::uint16_t>(random());
        const HiloTexture texture = hilo(high, low);
        Bench bench;
        bench.stages[0] = {.op = ShaderOp::texture_2d,
                           .texture = is_hilo ? BoundTexture{.hilo = &texture} : BoundTexture{.color = &color}};
        bench.stages[1] = {.op = ShaderOp::dot_product,
                           .previous = 0,
                           .mapping = expands ? DotMapping::expand_normal : DotMapping::unsigned_identity,
                           .texture = {}};
        const std::uint32_t column = below(random, 16), line = below(random, 8);
        bench.put(0, {(static_cast<float>(column) + 0.5f) / 16, (static_cast<float>(line) + 0.5f) / 8, 0, 1});
        const Coordinate c{any_float(random), any_float(random), any_float(random), any_float(random)};
        bench.put(1, c);
        static_cast<void>(bench.run());
        // Binary32 operations, each computed in binary64 and rounded once: products are exact, and the double rounding
        // of sums of two values is innocuous.
        const auto rounded = [](double x) { return static_cast<float>(x); };
        const std::array<float, 3> colour{static_cast<float>(column) / 255.0f, static_cast<float>(line) / 255.0f, 1.0f};
        const std::array<float, 3> pair{static_cast<float>(high) / 65535.0f, static_cast<float>(low) / 65535.0f, 1.0f};
        std::array<float, 3> x = is_hilo ? pair : colour;
        for (float& k : x)
            if (expands && !is_hilo) k = rounded(double{rounded(2.0 * k)} - 1.0);
        const float sx = rounded(double{c[0]} * x[0]), ty = rounded(double{c[1]} * x[1]),
                    rz = rounded(double{c[2]} * x[2]);
        const float expected = rounded(double{rounded(double{sx} + ty)} + rz);
        tally.expect(is_nan(expected) ? is_nan(bench.dot(1)) : bits_of(bench.dot(1)) == bits_of(expected),
                     [&] { return fmt::format("round {}: {} against {}", round, bench.dot(1), expected); });
        tally.expect(bench.rgba(1) == Coordinate{}, [] { return std::string{"a dot product has a colour"}; });
        if (is_hilo) tally.expect(bench.rgba(0) == Coordinate{}, [] { return std::string{"HILO has a colour"}; });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("a signed HILO texel is a vector of length one whose third component is not negative") {
    Bench bench;
    bench.put(1, {0, 0, 1, 1});
    for (const auto& [high, low, third] :
         std::initializer_list<std::tuple<int, int, float>>{{0, 0, 1.0f},
                                                            {-32768, 0, 0.0f},
                                                            {16384, 16384, std::sqrt(0.5f)},
                                                            {32767, 32767, 0.0f},
                                                            {0, -24576, std::sqrt(0.4375f)}}) {
        const HiloTexture texture = hilo(static_cast<std::uint16_t>(high), static_cast<std::uint16_t>(low), true);
        bench.stages[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &texture}};
        bench.stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
        static_cast<void>(bench.run());
        CHECK(bench.dot(1) == third);
    }
}

TEST_CASE("replaced depth is the quotient of two dot products in depth units rounded down") {
    Random random{314};
    Tally tally;
    DepthReplaceBench bench;
    for (int round = 0; round < 20000; ++round) {
        const int q = static_cast<int>(below(random, 128)) + 1, r = static_cast<int>(below(random, 65536u * 64u));
        bench.divide(static_cast<float>(r), static_cast<float>(q));
        const bool inside = r <= 65535 * q;  // in integers: the quotient is at most 65535
        tally.expect(bench.alive() == inside && (!inside || bench.code() == static_cast<std::uint32_t>(r / q)),
                     [&] { return fmt::format("{} / {}: {}", r, q, bench.code()); });
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("a replaced depth outside the depth range rejects the fragment as do zero divisors and NaN") {
    DepthReplaceBench bench;
    const auto lives = [&](float r, float q) { return bench.divide(r, q), bench.alive(); };
    CHECK(lives(0.0f, 1.0f));
    CHECK(lives(65535.0f, 1.0f));
    CHECK(lives(-65535.0f, -1.0f));  // only the quotient counts
    CHECK_FALSE(lives(65536.0f, 1.0f));
    CHECK_FALSE(lives(-1.0f, 1.0f));
    CHECK_FALSE(lives(1.0f, 0.0f));
    CHECK_FALSE(lives(0.0f, 0.0f));
    CHECK_FALSE(lives(1.0f, -0.0f));
    CHECK_FALSE(lives(not_a_number, 1.0f));
    CHECK_FALSE(lives(1.0f, not_a_number));
    CHECK_FALSE(lives(infinity, 1.0f));
    bench.machine.depth_near = 0.25f;
    bench.machine.depth_far = 0.5f;
    CHECK_FALSE(lives(16383.0f, 1.0f));
    CHECK(lives(16384.0f, 1.0f));
    CHECK(lives(32767.0f, 1.0f));
    CHECK_FALSE(lives(32768.0f, 1.0f));
    bench.machine.depth_clamp = true;
    CHECK(lives(1.0f, 0.0f));
    CHECK(bench.code() == 32767);
    CHECK(lives(-5.0f, 1.0f));
    CHECK(bench.code() == 16383);
    CHECK_FALSE(lives(0.0f, 0.0f));  // NaN cannot be clamped
}

TEST_CASE("a device with depths in 0 to 1 replaces by a quotient in that range and converts it like a depth write") {
    DepthReplaceBench bench;
    bench.machine.profile = find_profile("ideal");
    bench.machine.depth.format = DepthFormat::d32f;
    bench.divide(3.0f, 4.0f);
    CHECK(bench.code() == bits_of(0.75f));
    bench.divide(-0.0f, 4.0f);
    CHECK(bench.code() == 0u);
    bench.divide(5.0f, 4.0f);
    CHECK_FALSE(bench.alive());
    bench.machine.depth.format = DepthFormat::d24;
    bench.divide(1.0f, 2.0f);
    CHECK(bench.code() == 0x800000u);  // 8,388,607.5 to nearest, ties up
}

TEST_CASE("dependent lookups take the previous dot product as s and their own as t") {
    const HiloTexture one = hilo(0, 0);
    const Texture target = place_texture(TextureTarget::two_d, 128, 128);
    Bench bench;
    bench.stages[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &one}};
    bench.stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
    bench.stages[2] = {.op = ShaderOp::dot_product_texture_2d, .previous = 0, .texture = {.color = &target}};
    std::size_t wrong = 0;
    for (const float u : {-0.769f, 0.0f, 0.011f, 0.5f, 0.810f, 0.999f, 1.066f})
        for (const float v : {-0.25f, 0.3f, 0.75f, 2.0f}) {
            bench.put(1, {0, 0, u, 3});
            bench.put(2, {0, 0, v, 5});
            static_cast<void>(bench.run());
            const auto texel = [](float x) {
                return static_cast<float>(std::clamp(static_cast<int>(std::floor(x * 128.0f)), 0, 127));
            };
            wrong += bench.rgba(2)[0] != texel(u) / 255.0f || bench.rgba(2)[1] != texel(v) / 255.0f ? 1 : 0;
        }
    CHECK(wrong == 0);
}

TEST_CASE("a depth texture compares r/q in the three-dimensional stage and 0 in the chip's two-dimensional one") {
    Image depth{Format::d16, 2, 1};
    depth.codes = {1000, 0};
    Bench bench;
    bench.machine.texels[3] = DepthTexels{depth};
    bench.stages[3].op = ShaderOp::texture_rectangle;
    bench.stages[3].texture.depth_image = &depth;
    bench.stages[3].texture.compare = {
        .func = CompareFunc::lequal, .mode = DepthTextureMode::intensity, .target = TextureTarget::rectangle};
    const auto passes = [&](float s, float r, float q) {
        bench.put(3, {s * q, 0, r, q});
        static_cast<void>(bench.run());
        return bench.rgba(3)[0] == 1.0f;
    };
    CHECK(passes(0.5f, 2000.0f, 2.0f));        // R = 1000
    CHECK(passes(0.5f, 2001.0f, 2.0f));        // 1000.5 is truncated like a depth write
    CHECK_FALSE(passes(0.5f, 2002.0f, 2.0f));  // 1001 <= 1000 is false
    CHECK_FALSE(passes(1.5f, 1.0f, 1.0f));
    bench.stages[3].texture.reference = CompareReference::zero;
    CHECK(passes(1.5f, 1.0f, 1.0f));
    CHECK(passes(0.5f, 5000.0f, 1.0f));
}

TEST_CASE("an inconsistent stage does nothing and neither do stages that depend on it") {
    const HiloTexture zero = hilo(0, 0);
    const Texture flat = place_texture(TextureTarget::two_d, 1, 1),
                  rectangle = place_texture(TextureTarget::rectangle, 1, 1);
    const ShaderStage look{.op = ShaderOp::texture_2d, .texture = {.hilo = &zero}};
    const ShaderStage dot{.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
    const ShaderStage replace{.op = ShaderOp::dot_product_depth_replace, .previous = 0, .texture = {}};
    const ShaderStage none{};
    const auto ops = [](const ShaderStages& stages) { return consistent_operations(stages); };
    const auto last = [&](const ShaderStages& stages) { return ops(stages)[3]; };

    CHECK(ops({look, dot, replace, none})[2] == ShaderOp::dot_product_depth_replace);
    CHECK(last({look, none, dot, replace}) == ShaderOp::dot_product_depth_replace);
    CHECK(last({look, dot, none, replace}) == ShaderOp::none);     // the previous stage is not a dot product
    CHECK(last({look, dot, replace, replace}) == ShaderOp::none);  // a depth stage cannot be the first dot product
    CHECK(ops({dot, replace, none, none}) == ShaderOps{});         // no texture to multiply with in units 0 and 1
    CHECK(ops({none, dot, replace, none}) == ShaderOps{});         // NONE has no texel
    CHECK(ops({look, {.op = ShaderOp::dot_product, .previous = 1, .texture = {}}, none, none})[1] == ShaderOp::none);
    CHECK(ops({look, {.op = ShaderOp::dot_product, .previous = -1, .texture = {}}, none, none})[1] == ShaderOp::none);
    CHECK(last({look, dot, {.op = ShaderOp::dot_product, .previous = 1, .texture = {}}, replace}) == ShaderOp::none);
    CHECK(ops({ShaderStage{.op = ShaderOp::texture_2d, .texture = {}}, dot, none, none}) == ShaderOps{});  // no texture
    CHECK(ops({ShaderStage{.op = ShaderOp::texture_2d, .texture = {.color = &rectangle}}, none, none, none}) ==
          ShaderOps{});
    CHECK(ops({ShaderStage{.op = ShaderOp::texture_rectangle, .texture = {.color = &flat}}, none, none, none}) ==
          ShaderOps{});
    CHECK(last({look, dot, none,
                ShaderStage{.op = ShaderOp::dot_product_texture_2d, .previous = 0, .texture = {.color = &flat}}}) ==
          ShaderOp::none);

    DepthReplaceBench bench;
    bench.stages[1].op = ShaderOp::none;
    bench.divide(0.0f, 0.0f);
    CHECK(bench.alive());  // depth is not replaced, so the fragment is not rejected
    CHECK_FALSE(replaces_depth(consistent_operations(bench.stages)));
    CHECK(bench.rgba(2) == Coordinate{});
}

TEST_CASE("a pass computes only the coordinates that its operations use") {
    const HiloTexture zero = hilo(0, 0);
    Image depth{Format::d16, 1, 1};
    ShaderStages stages{};
    stages[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &zero}};
    stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
    stages[3].op = ShaderOp::texture_rectangle;
    stages[3].texture.depth_image = &depth;
    stages[3].texture.compare.target = TextureTarget::rectangle;
    CHECK(coordinates_of(stages, consistent_operations(stages)) == 0xf07b);
    stages[3].texture.reference = CompareReference::zero;
    CHECK(coordinates_of(stages, consistent_operations(stages)) == 0xb07b);
    stages[3].op = ShaderOp::cull_fragment;
    CHECK(coordinates_of(stages, consistent_operations(stages)) == 0xf07b);
    CHECK(coordinates_of({}, {}) == 0);
}

// 4 bits of exponent, 12 of mantissa: (1 + m / 4096) 2^(e - 7), in units in which depth 1 is 511.9375.
TEST_CASE("a replaced depth of a 16-bit float buffer is truncated to 4 bits of exponent and 12 of mantissa") {
    DepthReplaceBench bench;
    bench.machine.depth.format = DepthFormat::d16f;
    const auto code_of = [&](float depth) {
        bench.divide(depth, 1);
        return bench.code();
    };
    CHECK(code_of(32.0f) == 0xc000);
    CHECK(code_of(511.9375f) == 0xffff);
    CHECK((code_of(0x1p-6f) == 0x1000 && code_of(0x1.fffffep-7f) == 0));
    for (std::uint32_t code = 0x1000; code < 0xffff; code += 5) {
        const float low = std::ldexp(static_cast<float>(4096 + (code & 0xfff)), static_cast<int>(code >> 12) - 19);
        const float high = std::ldexp(static_cast<float>(4097 + (code & 0xfff)), static_cast<int>(code >> 12) - 19);
        if (code_of(low) != code || code_of(std::nextafter(high, 0.0f)) != code) FAIL("code " << code);
    }
    bench.divide(512, 1);
    CHECK_FALSE(bench.alive());
    bench.machine.depth_clamp = true;
    CHECK(code_of(512) == 0xffff);
}
