// Tests states that no algorithm sets: NV2A's signed blends, w buffers without a far plane, profiles that contradict
// themselves, rectangle lookups by dot products. The expected values are computed in integers, by multiplying matrices,
// and from independent tables.
#include <catch2/catch.hpp>

#include "pipeline/device/profile_fields.h"
#include "pipeline/geforce3/texture_shader.h"
#include "pipeline/vertices/check_list.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/simd.h"
#include "tests/pipeline/blend_model.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

std::string profile_error(const DeviceProfile& profile) {
    try {
        check(profile);
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE(
    "every equation of every pair of 8-bit codes is that of integers on every instruction set and for every rounding",
    "[slow]") {
    using enum BlendEquation;
    static Colors src;
    static Codes codes;
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope kernels{simd};
        for (const BlendRounding rounding :
             {BlendRounding::nearest, BlendRounding::truncate, BlendRounding::each_product}) {
            DeviceProfile profile;
            profile.blend_rounding = rounding;
            for (const BlendEquation equation :
                 {add, subtract, reverse_subtract, min, max, signed_add, signed_reverse_subtract}) {
                const BlendTerm term{equation, BlendFactor::one, BlendFactor::one};
                const Blend state{.enabled = true, .color = term, .alpha = term};
                std::size_t wrong = 0;
                for (int s = 0; s < 256; ++s) {
                    for (std::size_t c = 0; c < 4; ++c)
                        for (std::size_t i = 0; i < 256; ++i) {
                            src[c][i] = static_cast<float>(s) / 255.0f;
                            codes[c][i] = static_cast<std::uint32_t>(i);
                        }
                    blend(state, ChannelType::unorm8, profile, 4, src, codes, 256);
                    for (int d = 0; d < 256; ++d) {
                        const int signed_s = s < 128 ? s : s - 256;
                        const int expected = equation == add                ? s + d
                                             : equation == subtract         ? s - d
                                             : equation == reverse_subtract ? d - s
                                             : equation == min              ? std::min(s, d)
                                             : equation == max              ? std::max(s, d)
                                             : equation == signed_add       ? d + signed_s
                                                                            : d - signed_s;
                        for (std::size_t c = 0; c < 4; ++c)
                            wrong +=
                                static_cast<int>(codes[c][static_cast<std::size_t>(d)]) != std::clamp(expected, 0, 255)
                                    ? 1
                                    : 0;
                    }
                }
                INFO("set " << static_cast<int>(simd) << ", rounding " << static_cast<int>(rounding) << ", equation "
                            << static_cast<int>(equation));
                CHECK(wrong == 0);
            }
        }
    }
}

TEST_CASE("a w buffer's unit maps the far plane's w to depth 1 or is the given value or is 1 without such a plane") {
    const auto scale = [](const Matrix& projection, float given) {
        const strata::testing::TriangleScene scene = strata::testing::random_triangles(3, 4);
        View view;
        view.projection = projection;
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 8, 8};
        raster.depth_format = DepthFormat::d24;
        raster.w_scale = given;
        return prepare(scene.list, view, raster, *find_profile("geforce3"), {.threads = 1}).geometry.state.w_scale;
    };
    const Matrix to_five{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5, 0};  // near plane 1, far plane 5
    CHECK(scale(to_five, 0.0f) == static_cast<float>(0xffffff / 5.0));
    CHECK(scale(to_five, 12.5f) == 12.5f);
    const Matrix no_plane{2, 0, 0,  0,  0, 2, 0,  0,
                          0, 0, -1, -1, 0, 0, -2, 0};  // z = w has no solution: the far plane is infinite
    CHECK(scale(no_plane, 0.0f) == 1.0f);
    const Matrix behind{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -0.5, -1, 0, 0, -2.5, 0};  // z = w at w = -5
    CHECK(scale(behind, 0.0f) == 1.0f);
    const Matrix tiny{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5e-40, 0};  // overflows binary32
    CHECK(scale(tiny, 0.0f) == 1.0f);
    const Matrix vast{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5e60, 0};  // underflows to 0 in binary32
    CHECK(scale(vast, 0.0f) == 1.0f);
}

TEST_CASE("an alteration of vertices changes vertices or corners and one without functions neither") {
    const strata::testing::TriangleScene scene = strata::testing::random_triangles(4, 4);
    strata::rasterizer::RasterState raster;
    raster.viewport = {0, 0, 8, 8};
    const auto prepared = [&](const VertexAlteration* alteration) {
        return prepare(scene.list, scene.view, raster, *find_profile("ideal"), {.threads = 1, .alteration = alteration})
            .geometry;
    };
    const auto plain = prepared(nullptr);
    int vertices = 0, corners = 0;
    const VertexAlteration neither;
    const VertexAlteration of_vertices{.vertices = [&](strata::rasterizer::TriangleSoup&) { ++vertices; }};
    const VertexAlteration of_corners{.corners = [&](strata::rasterizer::Geometry& g) {
        ++corners;
        g.corners.front().z = 0.875f;
    }};
    CHECK(prepared(&neither).corners.size() == plain.corners.size());
    CHECK(prepared(&of_vertices).corners.front().z == plain.corners.front().z);
    CHECK(prepared(&of_corners).corners.front().z == 0.875f);
    CHECK(vertices == 1);
    CHECK(corners == 1);
}

TEST_CASE("a profile has the depth formats that it states and rounds codes once by one of two rules") {
    for (const bool has : {false, true}) {
        DeviceProfile profile;
        profile.has_d16f = profile.has_d24f = has;
        CHECK(profile.has_depth(DepthFormat::d16f) == has);
        CHECK(profile.has_depth(DepthFormat::d24f) == has);
    }
    DeviceProfile profile;
    profile.unorm_rounding = UnormRounding::half_up;
    for (const BlendRounding rounding : {BlendRounding::nearest, BlendRounding::truncate, BlendRounding::each_product,
                                         BlendRounding::unrounded_source}) {
        profile.blend_rounding = rounding;
        const bool is_once = rounding == BlendRounding::nearest || rounding == BlendRounding::truncate;
        CHECK(profile.rounds_codes_once() == is_once);
    }
    profile.blend_rounding = BlendRounding::nearest;
    for (const HalfRounding rounding :
         {HalfRounding::nearest_even, HalfRounding::toward_zero, HalfRounding::no_infinity}) {
        profile.half_rounding = rounding;
        CHECK(profile.rounds_codes_once() == (rounding != HalfRounding::no_infinity));
    }
}

TEST_CASE("float spans exclude every rule of the chip and a field below its range is rejected with both limits") {
    DeviceProfile spans = *find_profile("geforce3");
    spans.raster.coverage = strata::rasterizer::CoverageRule::float_spans;
    spans.raster.color = strata::rasterizer::ColorInterpolation::exact_plane;
    for (const auto& [path, word] :
         {std::pair{DepthPath::window_z, "window_z"}, std::pair{DepthPath::w_buffer, "w_buffer"}}) {
        spans.raster.depth_path = path;
        const auto conflict = conflict_of(spans);
        REQUIRE(conflict);
        CHECK(conflict->expected == std::string{"snapped_edges with raster.depth_path "} + word);
    }
    spans.raster.depth_path = DepthPath::float32;
    CHECK_FALSE(conflict_of(spans));
    spans.raster.y_axis = strata::rasterizer::YAxis::clip;
    CHECK(conflict_of(spans)->expected == "snapped_edges with raster.y_axis clip");
    spans.raster.viewport = strata::rasterizer::ViewportArithmetic::half_pixel_first;
    CHECK(conflict_of(spans)->expected == "snapped_edges with raster.viewport half_pixel_first");
    spans.raster.coverage = strata::rasterizer::CoverageRule::snapped_edges;
    CHECK_FALSE(conflict_of(spans));
    spans.blend_rounding = BlendRounding::unrounded_source;
    CHECK(conflict_of(spans)->key == "blend_rounding");
    spans.has_signed_blend = false;
    CHECK_FALSE(conflict_of(spans));
    DeviceProfile wrapped = *find_profile("swiftshader");
    CHECK_FALSE(conflict_of(wrapped));
    wrapped.raster.depth_limits = strata::rasterizer::DepthLimits::wrap;
    CHECK(conflict_of(wrapped)->key == "depth24");
    wrapped.depth24 = Depth24::codes;
    CHECK_FALSE(conflict_of(wrapped));
    DeviceProfile small = *find_profile("geforce8");
    small.max_samples = -1;
    CHECK(profile_error(small).find("expected 1 to") != std::string::npos);
    CHECK(profile_error(*find_profile("geforce8")) == "accepted");
}

TEST_CASE("a rectangle lookup by a dot product requires two dot products and a rectangle texture") {
    const Texture flat{.name = "flat", .width = 1, .height = 1, .texels = {0, 0, 0, 255}};
    Texture rectangle = flat;
    rectangle.target = TextureTarget::rectangle;
    const auto last_of = [&](const Texture& texture, int previous) {
        ShaderStages stages;
        stages[0] = {.op = ShaderOp::texture_2d, .texture = {.color = &flat}};
        stages[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
        stages[2] = {
            .op = ShaderOp::dot_product_texture_rectangle, .previous = previous, .texture = {.color = &texture}};
        return consistent_operations(stages)[2];
    };
    CHECK(last_of(rectangle, 0) == ShaderOp::dot_product_texture_rectangle);
    CHECK(last_of(flat, 0) == ShaderOp::none);       // another texture target
    CHECK(last_of(rectangle, 1) == ShaderOp::none);  // a scalar is not a valid input
}
