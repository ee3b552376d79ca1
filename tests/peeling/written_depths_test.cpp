// Tests peels of depths that programs write: the logarithm of w against the real depths of a plane in perspective, what
// each buffer can tell apart at a distance, and what is refused.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/device/check.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Outcome;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::rasterizer::DepthPath;

constexpr double written_near = 0.1, written_far = 1000;
constexpr int written_side = 64;

// glFrustum with an angle of 90 degrees.
View eye_view() {
    View view;
    view.projection[2][2] = -(written_far + written_near) / (written_far - written_near);
    view.projection[3][2] = -2 * written_far * written_near / (written_far - written_near);
    view.projection[2][3] = -1;
    view.projection[3][3] = 0;
    return view;
}

void add_quad(DrawList& list, const std::array<Vec3, 4>& corners) {
    Mesh mesh;
    mesh.positions.assign(corners.begin(), corners.end());
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const auto number = static_cast<std::uint32_t>(list.meshes.size());
    list.meshes.push_back(std::move(mesh));
    list.instances.push_back({.mesh = number, .material = 0});
}

DrawList glass() {
    DrawList list;
    const Rgba half{1, 0.5f, 0.25f, 0.5f};
    list.materials.push_back({.name = "glass",
                              .front = half,
                              .back = half,
                              .alpha_mode = AlphaMode::blend,
                              .double_sided = true,
                              .unlit = true});
    return list;
}

// The plane y = -1 from w = 1 to w = 16, whose corners are on the window's grid: rows 34 to 63.
DrawList ground() {
    DrawList list = glass();
    add_quad(list, {Vec3{-1, -1, -1}, Vec3{1, -1, -1}, Vec3{16, -1, -16}, Vec3{-16, -1, -16}});
    return list;
}

// Two panes across the view, `gap` apart.
DrawList panes(float distance, float gap) {
    DrawList list = glass();
    for (const float d : {distance + gap, distance})
        add_quad(list, {Vec3{-d, -d, -d}, Vec3{d, -d, -d}, Vec3{d, d, -d}, Vec3{-d, d, -d}});
    return list;
}

RenderOptions written_options(DepthFormat format, DepthPath path) {
    RenderOptions options;
    options.width = options.height = written_side;
    options.threads = 1;
    options.depth = format;
    options.depth_path = path;
    options.color_format = Format::rgba8;
    return options;
}

std::string refused(const DrawList& list, const View& view, const char* profile, const RenderOptions& options) {
    const RenderResult result = render(list, view, {profile, "front_to_back"}, options);
    return result.refusal ? result.refusal->message(*find_profile(profile)) : "drawn";
}

}  // namespace

TEST_CASE("logarithmic depth is log2(1 + w) / log2(1 + far) within 2^-23 at every pixel of a plane in perspective") {
    const DrawList list = ground();
    const View view = eye_view();
    for (const char* profile : {"geforce8", "ideal", "direct3d11", "llvmpipe"})
        for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f}) {
            INFO(profile << ", " << strata::enum_name(format));
            strata::peeling::Renderer renderer{list, view, *find_profile(profile),
                                               written_options(format, DepthPath::logarithmic)};
            const auto fragments = renderer.fragments(*strata::peeling::find_algorithm("unsorted")).all;
            double worst = 0;
            for (const CapturedFragment& f : fragments) {
                const double row = f.pixel / written_side + 0.5, w = 1 / (row / (written_side / 2) - 1);
                const double right = std::log2(1 + w) / std::log2(1 + written_far);
                const double found =
                    format == DepthFormat::d32f ? double{std::bit_cast<float>(f.code)} : f.code / 16777215.0;
                worst = std::max(worst, std::abs(found - right));
                CHECK(f.exact_code == f.code);
            }
            CHECK(fragments.size() == 30 * written_side);
            CHECK(worst < 0x1p-23);
        }
}

TEST_CASE("panes closer than a step of linear depth have one code by it and two by logarithmic depth") {
    const View view = eye_view();
    // A step of D24 at 500 is 500^2 / (0.1 * 2^24), 0.149; of its logarithm 501 ln(1001) / 2^24, 0.0002.
    const DrawList list = panes(500, 0.01f);
    const auto told_apart = [&](DepthPath path) {
        strata::peeling::Renderer renderer{list, view, *find_profile("geforce8"),
                                           written_options(DepthFormat::d24, path)};
        std::array<std::vector<std::uint32_t>, 2> codes;  // of the farther pane, which is listed first, and the nearer
        for (const CapturedFragment& f : renderer.fragments(*strata::peeling::find_algorithm("unsorted")).all)
            codes[f.primitive / 2].push_back(f.code);
        REQUIRE(codes[0].size() == written_side * written_side);
        REQUIRE(codes[1].size() == codes[0].size());
        std::size_t apart = 0;
        for (std::size_t i = 0; i < codes[0].size(); ++i) apart += codes[0][i] > codes[1][i] ? 1 : 0;
        return apart;
    };
    CHECK(told_apart(DepthPath::float32) == 0);
    CHECK(told_apart(DepthPath::logarithmic) == written_side * written_side);
}

TEST_CASE("every exact peel composites panes in the order of their logarithms where linear depth is too coarse") {
    const View view = eye_view();
    const DrawList list = panes(500, 0.01f);
    for (const Running& running : all_ways_of_running)
        for (const char* algorithm : {"depth_units", "front_to_back", "dual", "dual_independent", "shadow_map"}) {
            INFO(algorithm);
            RenderOptions options = written_options(DepthFormat::d24, DepthPath::logarithmic);
            options.reference_path = DepthPath::logarithmic;
            running.apply(options);
            const RenderResult found = render(list, view, {"geforce8_dx101", algorithm}, options);
            CHECK(found.outcome == Outcome::done);
            CHECK(found.audit.order_errors == 0u);
            CHECK(found.audit.ties.pixels == 0u);
            CHECK(found.audit.layers_max == 2);
        }
}

TEST_CASE("a packed depth is z except near 0 where a peel that compares it with z repeats layers") {
    DrawList list = glass();
    const auto ends = {std::pair{0.001f, 0.0023f}, {0.0031f, 0.0017f}};
    for (const auto& [left, right] : ends)
        add_quad(list, {Vec3{-1, -1, left}, Vec3{1, -1, right}, Vec3{1, 1, right}, Vec3{-1, 1, left}});
    RenderOptions options = written_options(DepthFormat::d32f, DepthPath::packed_rgba8);
    options.raster.clip_depth = strata::rasterizer::ClipDepth::zero_to_one;  // z of clip space is the depth
    options.max_passes = 6;
    const auto peeled = [&](DepthPath compared) {
        options.reference_path = compared;
        return render(list, {}, {"geforce8", "shadow_map"}, options);
    };
    const RenderResult right = peeled(DepthPath::packed_rgba8), wrong = peeled(DepthPath::float32);
    CHECK(right.audit.order_errors == 0u);
    CHECK(right.audit.layers_max == 2);
    CHECK((wrong.frame.color != right.frame.color));
    CHECK(wrong.frame.passes.geometry > right.frame.passes.geometry);
}

TEST_CASE("logarithms need a far plane, a program, LESS and another logarithm to be compared with") {
    const DrawList list = ground();
    const RenderOptions options = written_options(DepthFormat::d24, DepthPath::logarithmic);
    CHECK(refused(list, eye_view(), "geforce8", options) == "drawn");
    CHECK(
        refused(list, {}, "geforce8", options) ==
        "profile geforce8 has no logarithmic depth for a parallel projection, whose w is 1 everywhere; use depth path "
        "float32, or a camera with perspective");
    View endless = eye_view();
    endless.projection[2][2] = -1;
    endless.projection[3][2] = -2 * written_near;
    CHECK(
        refused(list, endless, "geforce8", options) ==
        "profile geforce8 has no logarithmic depth for a projection without a far plane; use depth path float32, or a "
        "camera with a far plane");
    CHECK(refused(list, eye_view(), "geforce3", options) ==
          "profile geforce3 has no fragment programs that write a depth (ARB_fragment_program); use geforce8, "
          "geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
    RenderOptions compared = options;
    compared.reference_path = DepthPath::float32;
    CHECK(refused(list, eye_view(), "geforce8", compared) ==
          "profile geforce8 has no comparison of a logarithm with a depth; use logarithmic for both: --depth-path "
          "logarithmic --reference-path logarithmic");
    RenderOptions reversed = written_options(DepthFormat::d32f, DepthPath::logarithmic);
    reversed.raster.depth_order = strata::rasterizer::DepthOrder::greater;
    CHECK(
        refused(list, eye_view(), "geforce8", reversed) ==
        "profile geforce8 has no logarithmic depth with GREATER, because it grows with the distance; use --depth-order "
        "less");
}
