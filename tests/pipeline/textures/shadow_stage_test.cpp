// Tests shadow stages against the light's window coordinates computed from its matrices in binary64, and the texels of
// its map at that position.
#include "pipeline/textures/shadow_stage.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "pipeline/device/profile.h"
#include "tests/pipeline/stage_values.h"

namespace {

using namespace strata::pipeline;
using strata::rasterizer::ClipDepth;
using strata::rasterizer::RasterState;
using strata::rasterizer::YDirection;

[[nodiscard]] std::array<double, 4> through(const Matrix& m, const std::array<double, 4>& v) {
    std::array<double, 4> out{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) out[r] += m[c][r] * v[c];
    return out;
}

[[nodiscard]] ShadowLight some_light() {
    ShadowLight light;
    light.view = {0.8, 0, -0.6, 0, 0, 1, 0, 0, 0.6, 0, 0.8, 0, 0.25, -0.5, -3, 1};
    light.projection = {1.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.25, -1, 0, 0, -2.25, 0};
    light.ambient = 0.25f;
    return light;
}

// A map of 2 x 2 texels, and one fragment that looks up (s, t) with depth r.
struct ShadowBench {
    std::unique_ptr<strata::rasterizer::FragmentBatch> batch = std::make_unique<strata::rasterizer::FragmentBatch>();
    std::array<strata::rasterizer::Lanes<float>, 4> scratch{};
    Image map{Format::d32f, 2, 2};
    RasterState state;

    ShadowBench() {
        for (std::size_t i = 0; i < 4; ++i) map.codes[i] = bits_of(0.2f * static_cast<float>(i + 1));
    }
    [[nodiscard]] std::array<float, 4> color_of(const ShadowLight& light, float s, float t, float r, float q) {
        batch->count = 1;
        for (std::size_t c = 0; c < 4; ++c) batch->color[c][0] = 0.5f + 0.125f * static_cast<float>(c);
        const std::array<float, 4> coordinate{s, t, r, q};
        for (std::size_t c = 0; c < 4; ++c) batch->unit[shadow_unit][c][0] = coordinate[c];
        const ShadowStage stage = shadow_stage(light, map, state);
        cast_shadow(stage, *find_profile("ideal"), *batch, scratch);
        return {batch->color[0][0], batch->color[1][0], batch->color[2][0], batch->color[3][0]};
    }
};

}  // namespace

TEST_CASE(
    "a light's unit maps every eye position to window coordinates in the light's map for either depth convention") {
    const ShadowLight light = some_light();
    const Matrix camera{1, 0, 0, 0, 0, 0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0.5, 1, -4, 1};
    Random random{711};
    double worst = 0;
    for (const ClipDepth convention : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one})
        for (const auto& [n, f] : {std::pair{0.0f, 1.0f}, std::pair{0.25f, 0.75f}, std::pair{1.0f, 0.0f}}) {
            RasterState state;
            state.clip_depth = convention;
            state.depth_near = n, state.depth_far = f;
            const CoordinateUnits units = shadow_units(light, camera, state, *find_profile("ideal"));
            for (std::size_t u = 0; u < units.size(); ++u) CHECK(units[u].enabled == (u == 3));
            for (int i = 0; i < 50; ++i) {
                const auto number = [&] { return static_cast<double>(below(random, 4096)) / 1024.0 - 2.0; };
                const std::array<double, 4> world{number(), number(), number(), 1};
                const auto eye = through(camera, world), clip = through(light.projection, through(light.view, world));
                const bool symmetric = convention == ClipDepth::minus_one_to_one;
                const double n64 = n, f64 = f;
                const std::array<double, 4> expected{0.5 * (clip[0] + clip[3]), 0.5 * (clip[1] + clip[3]),
                                                     symmetric ? 0.5 * ((f64 - n64) * clip[2] + (f64 + n64) * clip[3])
                                                               : (f64 - n64) * clip[2] + n64 * clip[3],
                                                     clip[3]};
                for (std::size_t c = 0; c < 4; ++c) {
                    const Plane4& plane = units[3].gen[c].plane;
                    double found = 0;
                    for (std::size_t k = 0; k < 4; ++k) found += plane[k] * eye[k];
                    worst = std::max(worst, std::fabs(found - expected[c]));
                }
            }
        }
    CHECK(worst < 1e-12);
}

TEST_CASE("the light's depth has the units of vertex depth which are codes of the map's format on some devices") {
    RasterState state;
    state.depth_format = DepthFormat::d24;
    const auto units_on = [&](const char* device) {
        return shadow_units(some_light(), identity, state, *find_profile(device))[shadow_unit].depth_units;
    };
    CHECK(units_on("geforce3") == strata::Vec3d{1, 1, 16777215});
    CHECK(units_on("geforce8") == strata::Vec3d{1, 1, 1});
    state.depth_format = DepthFormat::d16;
    CHECK(units_on("geforce3")[2] == 65535.0);
}

TEST_CASE("a map is sampled as its light states with y up or down and one or four comparisons and its ambient factor") {
    const Image map{Format::d24, 2, 2};
    ShadowLight light = some_light();
    RasterState state;
    const ShadowStage soft = shadow_stage(light, map, state);
    CHECK(soft.map.bottom_up);
    CHECK(soft.map.width == 2);
    CHECK(soft.map.format == DepthFormat::d24);
    CHECK(soft.compare == ShadowCompare{.func = CompareFunc::lequal,
                                        .mode = DepthTextureMode::luminance,
                                        .fail_value = 0.25f,
                                        .target = TextureTarget::two_d,
                                        .filter = TextureFilter::linear,
                                        .wrap_s = TextureWrap::clamp_to_edge,
                                        .wrap_t = TextureWrap::clamp_to_edge});
    light.percentage_closer = false;
    state.y_direction = YDirection::down;
    const ShadowStage hard = shadow_stage(light, map, state);
    CHECK_FALSE(hard.map.bottom_up);
    CHECK(hard.compare.filter == TextureFilter::nearest);
}

TEST_CASE("the colour is multiplied by the comparison of r/q at s/q and t/q and alpha is unchanged") {
    ShadowBench bench;
    ShadowLight light = some_light();
    light.percentage_closer = false;
    const std::array<float, 4> lit{0.5f, 0.625f, 0.75f, 0.875f}, dark{0.125f, 0.15625f, 0.1875f, 0.875f};
    bench.state.y_direction = YDirection::down;  // texels 0.2, 0.4 above 0.6, 0.8
    for (const float q : {1.0f, 4.0f, 0.5f}) {
        CHECK(bench.color_of(light, 0.25f * q, 0.25f * q, 0.1f * q, q) == lit);
        CHECK(bench.color_of(light, 0.25f * q, 0.25f * q, 0.3f * q, q) == dark);
        CHECK(bench.color_of(light, 0.75f * q, 0.25f * q, 0.3f * q, q) == lit);
        CHECK(bench.color_of(light, 0.75f * q, 0.25f * q, 0.5f * q, q) == dark);
        CHECK(bench.color_of(light, 0.25f * q, 0.75f * q, 0.5f * q, q) == lit);
        CHECK(bench.color_of(light, -9 * q, 9 * q, 0.7f * q, q) == dark);  // the border: texel 0.6
    }
    bench.state.y_direction = YDirection::up;  // t = 0 is the last row
    CHECK(bench.color_of(light, 0.25f, 0.25f, 0.5f, 1) == lit);
    CHECK(bench.color_of(light, 0.25f, 0.75f, 0.5f, 1) == dark);
    light.percentage_closer = true;  // of four texels, 0.8 and 0.6 are behind 0.5: half lit, half 0.25
    const auto half = bench.color_of(light, 0.5f, 0.5f, 0.5f, 1);
    CHECK(half == std::array{0.5f * 0.625f, 0.625f * 0.625f, 0.75f * 0.625f, 0.875f});
}
