// Tests texture shader stages whose result depends on a texture's shape, a device's depth or its rule for divisions.
// Expected texels are found in integers, expected values by the extension's formulas, and division rules are checked on
// the neighbours of the quotient.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "pipeline/device/profile.h"
#include "pipeline/geforce3/texture_shader.h"
#include "tests/pipeline/addressing_model.h"

namespace {

using namespace strata::pipeline;
using model::Rational;
using strata::rasterizer::DivideRule;
using strata::rasterizer::FragmentBatch;

// One fragment, four stages, a profile that a test may change.
struct ShaderRun {
    DeviceProfile profile;
    ShaderStages stages{};
    ShaderDevice machine;
    std::unique_ptr<FragmentBatch> batch = std::make_unique<FragmentBatch>();
    std::unique_ptr<ShaderResults> out = std::make_unique<ShaderResults>();

    explicit ShaderRun(const char* device) : profile{*find_profile(device)} { batch->count = 1; }
    void put(std::size_t unit, const std::array<float, 4>& strq) {
        for (std::size_t c = 0; c < 4; ++c) batch->unit[unit][c][0] = strq[c];
    }
    void run() {
        machine.profile = &profile;
        run_texture_shader(stages, consistent_operations(stages), machine, *batch, *out);
    }
};

// Stage 2 replaces depth by r1 / r2.
struct ReplaceRun : ShaderRun {
    HiloTexture zero;
    explicit ReplaceRun(const char* device, DepthFormat format) : ShaderRun{device} {
        zero.texels = {{0, 0}};
        machine.depth.format = format;
        stages[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &zero}};
        stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
        stages[2] = {.op = ShaderOp::dot_product_depth_replace, .previous = 0, .texture = {}};
        put(0, {0, 0, 0, 1});
    }
    void divide(float numerator, float denominator) {
        put(1, {0, 0, numerator, 1});
        put(2, {0, 0, denominator, 1});
        run();
    }
};

[[nodiscard]] float neighbour_toward_zero(float v) { return std::nextafter(v, 0.0f); }

// 1 / d rounded toward zero: the largest binary32 whose product with d is at most 1.
[[nodiscard]] float cut_one_over(float d) {
    const float near = 1.0f / d;
    return Rational{near} * Rational{d} > 1 ? neighbour_toward_zero(near) : near;
}

[[nodiscard]] float quotient_by(DivideRule rule, float n, float d) {
    switch (rule) {
        case DivideRule::exact: return n / d;
        case DivideRule::cut_reciprocal: return n * cut_one_over(d);
        case DivideRule::low_reciprocal: return n * neighbour_toward_zero(1.0f / d);
    }
    return 0;
}

}  // namespace

TEST_CASE("a HILO texture is read with its own width and height and wrapped by its own two modes") {
    HiloTexture texture;
    texture.width = 4, texture.height = 3;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            texture.texels.push_back(
                {static_cast<std::uint16_t>(1000 * x + 1), static_cast<std::uint16_t>(1000 * y + 2)});
    Tally tally;
    for (const TextureTarget target : {TextureTarget::two_d, TextureTarget::rectangle})
        for (const TextureWrap wrap_s : {TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge})
            for (const TextureWrap wrap_t :
                 {TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge}) {
                texture.target = target, texture.wrap_s = wrap_s, texture.wrap_t = wrap_t;
                ShaderRun shader{"geforce3"};
                shader.stages[0] = {
                    .op = target == TextureTarget::two_d ? ShaderOp::texture_2d : ShaderOp::texture_rectangle,
                    .texture = {.hilo = &texture}};
                for (int i = -9; i < 12; ++i)
                    for (int k = -7; k < 10; ++k) {
                        const float s = (static_cast<float>(i) + 0.5f) / (target == TextureTarget::two_d ? 4.0f : 1.0f);
                        const float t = (static_cast<float>(k) + 0.5f) / (target == TextureTarget::two_d ? 3.0f : 1.0f);
                        shader.put(0, {s * 2, t * 2, 0, 2});
                        shader.run();
                        const bool clamps = target == TextureTarget::rectangle;
                        const int x = model::wrap_texel(clamps ? TextureWrap::clamp_to_edge : wrap_s, 4, i);
                        const int y = model::wrap_texel(clamps ? TextureWrap::clamp_to_edge : wrap_t, 3, k);
                        const auto& xyz = shader.out->stage[0].xyz;
                        tally.expect(xyz[0][0] == static_cast<float>(1000 * x + 1) / 65535.0f &&
                                         xyz[1][0] == static_cast<float>(1000 * y + 2) / 65535.0f && xyz[2][0] == 1.0f,
                                     [&] {
                                         return fmt::format("texel {} {} of wraps {} {}", i, k,
                                                            static_cast<int>(wrap_s), static_cast<int>(wrap_t));
                                     });
                    }
            }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("the divisions of lookups and comparisons and replaced depths follow the device's hypothesis") {
    Random random{731};
    Tally tally;
    std::uint64_t unlike = 0;
    for (const DivideRule rule : {DivideRule::exact, DivideRule::cut_reciprocal, DivideRule::low_reciprocal}) {
        ReplaceRun replace{"ideal", DepthFormat::d32f};
        replace.profile.raster.hypothesis.divide = rule;
        Image texel{Format::d32f, 1, 1};
        ShaderRun compare{"ideal"};
        compare.profile.raster.hypothesis.divide = rule;
        compare.machine.texels[0] = DepthTexels{texel};
        compare.stages[0].op = ShaderOp::texture_2d;
        compare.stages[0].texture.depth_image = &texel;
        compare.stages[0].texture.compare = {.func = CompareFunc::equal};
        for (int n = 0; n < 2000; ++n) {
            const float d = static_cast<float>(below(random, 1u << 24) + 1) * 0x1p-20f;
            const float numerator = d * (static_cast<float>(below(random, 1u << 20)) * 0x1p-20f);
            const float expected = quotient_by(rule, numerator, d);
            unlike += expected != numerator / d ? 1 : 0;
            replace.divide(numerator, d);
            const bool inside = expected >= 0.0f && expected <= 1.0f;
            tally.expect(
                (replace.out->alive[0] != 0) == inside && (!inside || replace.out->code[0] == bits_of(expected)),
                [&] { return fmt::format("{} / {} replaced", numerator, d); });
            texel.codes[0] = bits_of(expected);
            compare.put(0, {0, 0, numerator, d});
            compare.run();
            tally.expect(compare.out->stage[0].rgba[0][0] == 1.0f,
                         [&] { return fmt::format("{} / {} compared", numerator, d); });
        }
    }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(unlike > 500);
}

TEST_CASE("a replaced depth is rounded like the device's depth writes in every fixed format and unit") {
    Random random{732};
    Tally tally;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
        for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest})
            for (const bool in_codes : {false, true}) {
                ReplaceRun shader{"ideal", format};
                shader.profile.raster.depth_rounding = rounding;
                shader.profile.raster.window_z =
                    in_codes ? strata::rasterizer::WindowZ::buffer_units : strata::rasterizer::WindowZ::unit_interval;
                const std::uint32_t top = format == DepthFormat::d16 ? 65535 : 16777215;
                for (int n = 0; n < 500; ++n) {
                    const float z = in_codes ? static_cast<float>(below(random, 65535u * 256u)) / 256.0f
                                             : static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;
                    shader.divide(z * 4, 4);
                    const Rational code = in_codes ? Rational{z} : Rational{z} * top;
                    const auto expected = static_cast<std::uint32_t>(
                        model::floor(code + (rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0})));
                    tally.expect(shader.out->alive[0] != 0 && shader.out->code[0] == expected,
                                 [&] { return fmt::format("{} of top {}: {}", z, top, shader.out->code[0]); });
                }
            }
    INFO(tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE(
    "a reversed depth range is the same range and with depth clamp a replaced depth is clamped to its nearer end") {
    ReplaceRun shader{"ideal", DepthFormat::d32f};
    shader.machine.depth_near = 0.75f, shader.machine.depth_far = 0.25f;
    const auto outcome = [&](float z) {
        shader.divide(z, 1);
        return shader.out->alive[0] == 0 ? -1.0f : float_of(shader.out->code[0]);
    };
    CHECK(outcome(0.25f) == 0.25f);
    CHECK(outcome(0.75f) == 0.75f);
    CHECK(outcome(0.5f) == 0.5f);
    CHECK(outcome(std::nextafter(0.25f, 0.0f)) == -1.0f);
    CHECK(outcome(std::nextafter(0.75f, 1.0f)) == -1.0f);
    shader.machine.depth_clamp = true;
    CHECK(outcome(0.1f) == 0.25f);
    CHECK(outcome(7.0f) == 0.75f);
    CHECK(outcome(-std::numeric_limits<float>::infinity()) == 0.25f);
    CHECK(outcome(std::numeric_limits<float>::quiet_NaN()) == -1.0f);
}

TEST_CASE("a fragment that one stage culls stays dead in later stages") {
    ShaderRun shader{"geforce3"};
    shader.stages[0].op = shader.stages[2].op = ShaderOp::cull_fragment;
    int wrong = 0;
    for (const float first : {-1.0f, 1.0f})
        for (const float second : {-1.0f, 1.0f}) {
            shader.put(0, {0, first, 0, 0});
            shader.put(2, {0, 0, 0, second});
            shader.run();
            wrong += (shader.out->alive[0] != 0) != (first > 0 && second > 0) ? 1 : 0;
        }
    CHECK(wrong == 0);
}

TEST_CASE("each operation requests only its own coordinates in any stage") {
    const auto asked = [](ShaderOp op, std::size_t stage) {
        ShaderOps ops{};
        ops[stage] = op;
        return unsigned{coordinates_of({}, ops)} >> (4 * stage);
    };
    for (std::size_t stage = 0; stage < 4; ++stage) {
        CHECK(asked(ShaderOp::none, stage) == 0);
        for (const ShaderOp lookup : {ShaderOp::texture_2d, ShaderOp::texture_rectangle})
            CHECK(asked(lookup, stage) == 0xb);
        for (const ShaderOp all : {ShaderOp::pass_through, ShaderOp::cull_fragment}) CHECK(asked(all, stage) == 0xf);
        for (const ShaderOp dot : {ShaderOp::dot_product, ShaderOp::dot_product_texture_2d,
                                   ShaderOp::dot_product_texture_rectangle, ShaderOp::dot_product_depth_replace})
            CHECK(asked(dot, stage) == 0x7);
    }
    for (const ShaderOp op : {ShaderOp::none, ShaderOp::texture_2d, ShaderOp::pass_through, ShaderOp::dot_product,
                              ShaderOp::dot_product_texture_rectangle})
        CHECK_FALSE(replaces_depth({op, op, op, op}));
    CHECK(replaces_depth({ShaderOp::none, ShaderOp::none, ShaderOp::none, ShaderOp::dot_product_depth_replace}));
}
