// Tests frames in other formats and on devices with mixed rules: every execution must equal literal execution.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/execution/execution_ways.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Execution;

}  // namespace

TEST_CASE("alpha for everything and other formats and the complete state of the rasterizer execute alike", "[slow]") {
    const TriangleScene scene = random_triangles(77, 30);
    RenderOptions options = small_frame();
    options.alpha = 0.375f;
    options.color_format = strata::pipeline::Format::rgba16f;
    options.depth = strata::pipeline::DepthFormat::d24;
    options.raster.scissor = strata::rasterizer::Rect{5, 9, 70, 33};
    options.raster.polygon_offset = {true, 1.5f, 2.0f};
    for (const char* algorithm : {"front_to_back", "dual", "dual_independent", "depth_units", "weighted_average"})
        check_all_ways(scene, {"geforce8_dx101", algorithm}, options);
}

// With alphas of 3e-38 many products of colour and alpha are denormal, which GeForce8 adds as 0; over black this is
// visible.
TEST_CASE("sums execute alike in halves and in binary32 including denormals") {
    const TriangleScene scene = random_triangles(79, 12);
    RenderOptions options = small_frame();
    options.width = 40;
    options.height = 28;
    options.background = {0, 0, 0, 1};
    const std::array<ExecutionWay, 2> chosen{ways[7], ways[8]};
    for (const auto format : {strata::pipeline::Format::rgba8, strata::pipeline::Format::rgba32f})
        for (const float alpha : {0.375f, 3e-38f})
            for (const char* profile : {"geforce8_dx101", "ideal"})
                for (const char* algorithm : {"weighted_average", "weighted_sum"}) {
                    options.color_format = format;
                    options.alpha = alpha;
                    check_all_ways(scene, {profile, algorithm}, options, chosen);
                }
}

// Rows add only colours of exact planes.
TEST_CASE("sums of colours by the chip's weights execute alike on a device with binary32 depths") {
    using namespace strata::pipeline;
    DeviceProfile mixed = *find_profile("geforce8_dx101");
    mixed.raster.color = strata::rasterizer::ColorInterpolation::weights_8bit;
    const TriangleScene scene = random_triangles(79, 12);
    RenderOptions options = small_frame();
    options.color_format = Format::rgba32f;
    options.alpha = 0.375f;
    options.execution = Execution::literal;
    const RenderResult expected = drawn_on(mixed, scene, "weighted_average", options);
    REQUIRE(expected.outcome == strata::peeling::Outcome::done);
    for (const ExecutionWay& way : {ways[7], ways[8]})
        CHECK(difference(drawn_on(mixed, scene, "weighted_average", with(options, way)), expected) == "");
}

// OVER and UNDER with (0, 0, 0, 0) flush a denormal that a float target holds and turn -0 into 0, so even these blends
// may not be skipped.
TEST_CASE("peels from both ends over a background of denormals and -0 execute alike in floats") {
    const TriangleScene scene = random_triangles(85, 5);  // many pixels have one fragment
    const std::array<ExecutionWay, 2> chosen{ways[7], ways[8]};
    for (const auto format : {strata::pipeline::Format::rgba16f, strata::pipeline::Format::rgba32f})
        for (const char* profile : {"geforce8_dx101", "ideal"}) {
            RenderOptions options = small_frame();
            options.background = {1e-40f, -0.0f, -1e-40f, 1};
            options.color_format = format;
            options.alpha = 1;
            check_all_ways(scene, {profile, "dual_independent"}, options, chosen);
            const auto audit = [&](const strata::pipeline::Instruments& instruments) {
                return render(scene.list, scene.view, {profile, "dual_independent"}, options, instruments).audit;
            };
            CHECK(audit({.check_selections = true}) == audit({}));
        }
}

// An offset moves most fragments below 0: in fixed point they wrap around and are farther than all others, in D32F
// nearer.
TEST_CASE("depths beyond the range execute alike because the frame is drawn as a whole and no tile uses a bound",
          "[slow]") {
    using namespace strata::pipeline;
    const std::vector<ExecutionWay> few{ways[0], ways[1], ways[3], ways[7], ways[8]};
    DeviceProfile wraps = *find_profile("llvmpipe"), clamps = wraps;
    wraps.raster.depth_limits = strata::rasterizer::DepthLimits::wrap;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (const char* algorithm : {"front_to_back", "unsorted", "weighted_average", "depth_units"}) {
            const TriangleScene scene = random_triangles(84, 20);
            RenderOptions options = small_frame();
            options.depth = format;
            options.alpha = 0.4f;
            // A unit is two codes; in D32F it is a small power of two.
            const float units = format == DepthFormat::d16 ? -2e4f : format == DepthFormat::d24 ? -5e6f : -1e7f;
            options.raster.polygon_offset = {true, 0, units};
            options.execution = Execution::literal;
            options.max_passes = 12;
            const RenderResult expected = drawn_on(wraps, scene, algorithm, options);
            REQUIRE(expected.outcome == strata::peeling::Outcome::done);
            INFO(algorithm << ", format " << static_cast<int>(format));
            if (format != DepthFormat::d32f)
                CHECK(difference(drawn_on(clamps, scene, algorithm, options), expected) != "");
            for (const ExecutionWay& way : few)
                CHECK(difference(drawn_on(wraps, scene, algorithm, with(options, way)), expected) == "");
        }
}

// The offset moves sloping opaque triangles below 0, but not the flat ones in front of and behind them.
TEST_CASE("an opaque depth below 0 is not a bound for sorting and such a frame executes alike") {
    using namespace strata::pipeline;
    TriangleScene scene = random_triangles(86, 20);
    for (const std::size_t i : {0u, 1u})
        for (auto& position : scene.list.meshes[scene.list.instances[i].mesh].positions)
            position[2] = i == 0 ? -2.0f : -3.0f;
    for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f})
        for (const auto& [device, algorithm] : {std::pair{"llvmpipe", "front_to_back"},
                                                {"llvmpipe", "depth_units"},
                                                {"llvmpipe", "layer_peel"},
                                                {"geforce8", "stencil_routed_k_buffer"}}) {
            DeviceProfile wraps = *find_profile(device);
            wraps.raster.depth_limits = strata::rasterizer::DepthLimits::wrap;
            RenderOptions options = small_frame();
            options.depth = format;
            options.raster.polygon_offset = {true, -20, 0};
            options.execution = Execution::literal;
            const RenderResult expected = drawn_on(wraps, scene, algorithm, options);
            REQUIRE(expected.outcome == strata::peeling::Outcome::done);
            INFO(algorithm << ", format " << static_cast<int>(format));
            for (const ExecutionWay& way : {ways[1], ways[7], ways[8]})
                CHECK(difference(drawn_on(wraps, scene, algorithm, with(options, way)), expected) == "");
        }
}

// Tiles of 64 pixels that share a slot in the cache: (5, 0) and (0, 1). The passes blend a pixel several times.
TEST_CASE("blends in cached tiles execute alike in frames whose tiles evict one another and in small ones", "[slow]") {
    using namespace strata::pipeline;
    const std::vector<ExecutionWay> few{ways[0], ways[1], ways[3], ways[7], ways[8]};
    for (const int width : {40, 330})
        for (const auto format : {Format::rgba8, Format::rgba16f})
            for (const char* algorithm : {"unsorted", "painter", "weighted_average", "weighted_sum", "coherent_stencil",
                                          "coherent_blend", "front_to_back"}) {
                const TriangleScene scene = random_triangles(83, 14);
                RenderOptions options = small_frame();
                options.width = width;
                options.height = 70;
                options.color_format = format;
                options.alpha = 0.3f;
                check_all_ways(scene, {"softpipe", algorithm}, options, few);
            }
}

// Mesa's drivers round each product of a blend and convert by binary32 products. Custom profiles may mix the rules;
// random combinations are tested.
TEST_CASE("peels execute alike for every rule of blending and conversion in every format with ties and limits",
          "[slow]") {
    Random random{81};
    const std::array<ExecutionWay, 2> chosen{ways[7], ways[10]};
    using namespace strata::pipeline;
    for (const char* base : {"llvmpipe", "llvmpipe_sse", "softpipe", "swiftshader", "geforce8_dx101"})
        for (const auto format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
            for (const char* algorithm : {"front_to_back", "dual"})
                for (int trial = 0; trial < 3; ++trial) {
                    TriangleScene scene = random_triangles(82, 12);
                    scene.list.instances.push_back(scene.list.instances[0]);  // every depth twice
                    DeviceProfile profile = *find_profile(base);
                    if (trial > 0) {
                        profile.blend_rounding = static_cast<BlendRounding>(random_int(random, 0, 3));
                        profile.unorm_rounding = static_cast<UnormRounding>(random_int(random, 0, 2));
                        profile.half_rounding = static_cast<HalfRounding>(random_int(random, 0, 2));
                        profile.denormals = static_cast<DenormalRule>(random_int(random, 0, 1));
                        profile.min_max_nan = static_cast<MinMaxNan>(random_int(random, 0, 2));
                        profile.blend_storage = static_cast<BlendStorage>(random_int(random, 0, 1));
                    }
                    RenderOptions options = small_frame();
                    options.width = 40;
                    options.height = 28;
                    options.color_format = format;
                    options.alpha = random_channel(random);
                    options.background = random_color(random);
                    options.background[3] = 1;  // resolves require an opaque background
                    options.execution = Execution::literal;
                    const auto drawn = [&](const RenderOptions& how) {
                        return drawn_on(profile, scene, algorithm, how);
                    };
                    const RenderResult expected = drawn(options);
                    REQUIRE(expected.outcome == strata::peeling::Outcome::done);
                    INFO(algorithm << " on " << base << ", format " << static_cast<int>(format) << ", trial " << trial);
                    for (const ExecutionWay& way : chosen) {
                        const RenderResult found = drawn(with(options, way));
                        CHECK(difference(found, expected) == "");
                        if (algorithm == std::string_view{"dual"})
                            CHECK(found.frame.work.visited == 0);  // no pass has run
                    }
                }
}

// Rows and resolves support only colours by exact planes, even for a depth that they support.
TEST_CASE("colours by the chip's weights execute alike on a device whose depth is an exact plane") {
    strata::pipeline::DeviceProfile profile = *strata::pipeline::find_profile("ideal");
    profile.raster.color = strata::rasterizer::ColorInterpolation::weights_8bit;
    const TriangleScene scene = random_triangles(80, 8);
    for (const char* algorithm : {"weighted_average", "weighted_sum", "front_to_back", "dual"})
        for (const auto format : {strata::pipeline::Format::rgba8, strata::pipeline::Format::rgba32f}) {
            RenderOptions options = small_frame();
            options.color_format = format;
            options.execution = Execution::literal;
            const auto drawn = [&](const RenderOptions& how) { return drawn_on(profile, scene, algorithm, how); };
            const RenderResult expected = drawn(options);
            REQUIRE(expected.outcome == strata::peeling::Outcome::done);
            options.execution = Execution::replay;
            INFO(algorithm);
            CHECK(difference(drawn(options), expected) == "");
        }
}
