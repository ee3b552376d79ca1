// Tests reversed depth (GREATER, near at 1) and clip space from 0 to 1, against the same fragments with depth 1 - d,
// where d and 1 - d are exact in binary32; fragments sorted by a plain loop; and the real depths of a perspective
// projection.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "peeling/programs/region_programs.h"
#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Outcome;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::rasterizer::ClipDepth;
using strata::rasterizer::DepthOrder;

// Depths k / 64 from 0 to 1 inclusive, with ties; some pixels have an opaque surface.
FragmentScene mixed_scene(unsigned seed) {
    std::mt19937 random{seed};
    FragmentScene scene{8, 8};
    const auto share = [&](unsigned steps) {
        return static_cast<float>(random() % (steps + 1)) / static_cast<float>(steps);
    };
    for (GivenPixel& pixel : scene.pixels) {
        const unsigned count = random() % 7;
        for (unsigned i = 0; i < count; ++i) {
            const float depth = share(64), red = share(8), green = share(8), alpha = share(8);
            pixel.fragments.push_back({depth, {red, green, 0.25f, alpha}});
        }
        if (random() % 3 == 0) {
            const float depth = share(64);
            pixel.opaque = GivenFragment{depth, {0, 0.5f, 1, 1}};
        }
    }
    return scene;
}

// A scene draws clip z = 2 d - 1. These projections convert it to the z of the convention, with every operation exact.
View view_under(ClipDepth clip, DepthOrder order) {
    View view;
    if (clip == ClipDepth::zero_to_one) {
        view.projection[2][2] = 0.5;
        view.projection[3][2] = 0.5;
    }
    if (order == DepthOrder::greater) {
        view.projection[2][2] = -view.projection[2][2];
        view.projection[3][2] = clip == ClipDepth::zero_to_one ? 0.5 : 0.0;
    }
    return view;
}

RenderOptions options_under(const FragmentScene& scene, ClipDepth clip, DepthOrder order,
                            DepthFormat format = DepthFormat::d32f) {
    RenderOptions options = options_for(scene);
    options.depth = format;
    options.raster.clip_depth = clip;
    options.raster.depth_order = order;
    return options;
}

// True if `reversed` is the code of 1 - d for the code of d. Of fixed point the codes of 1/2 and 1 - 1/2 are one code,
// which rounding chooses.
bool is_reversed_code(Format format, std::uint32_t code, std::uint32_t reversed) {
    if (format == Format::d32f) return 1.0f - std::bit_cast<float>(code) == std::bit_cast<float>(reversed);
    const std::uint32_t greatest = format == Format::d16 ? 0xffff : 0xffffff;
    if (code == reversed) return code == greatest / 2 || code == greatest / 2 + 1;
    return code + reversed == greatest;
}

// True if `reversed` is 1 - d wherever `forward` is d.
bool are_reversed(const Image& forward, const Image& reversed) {
    if (forward.codes.size() != reversed.codes.size() || forward.format != reversed.format) return false;
    for (std::size_t i = 0; i < forward.codes.size(); ++i)
        if (!is_reversed_code(forward.format, forward.codes[i], reversed.codes[i])) return false;
    return true;
}

// Two walls across the frame, the farther one first.
DrawList two_walls(float distance, float gap) {
    DrawList list;
    list.materials = {{.name = "wall", .alpha_mode = AlphaMode::blend, .double_sided = true, .unlit = true}};
    for (const float e : {distance + gap, distance}) {
        Mesh mesh;
        const float half = 2.0f * e;  // wider than the frame
        mesh.positions = {{-half, -half, -e}, {half, -half, -e}, {half, half, -e}, {-half, half, -e}};
        mesh.colors.assign(4, Rgba{0.5f, 0.5f, 0.5f, 0.5f});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        list.instances.push_back({.mesh = static_cast<std::uint32_t>(list.meshes.size()), .material = 0});
        list.meshes.push_back(std::move(mesh));
    }
    return list;
}

}  // namespace

TEST_CASE("a program reads the window depth under either depth order") {
    FragmentScene scene{2, 1};
    scene.pixels[0].fragments = {{0.25f, {1, 1, 1, 0.5f}}};
    scene.pixels[1].fragments = {{0.875f, {1, 1, 1, 0.5f}}};
    for (const DepthOrder order : {DepthOrder::less, DepthOrder::greater}) {
        strata::peeling::Algorithm algorithm;
        algorithm.name = "depths";
        algorithm.body = [](Region& region) {
            const Target depths = region.make(Format::rgba32f);
            PassState state;
            state.color[0] = depths;
            static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                    for (Lanes<float>& channel : out.color[0])
                        channel[i] = strata::peeling::window_z(region.frame(), in.shader_z[i]);
            }));
            region.publish(depths);
        };
        const auto clip = ClipDepth::zero_to_one;
        RenderOptions options = options_under(scene, clip, order);
        options.color_format = Format::rgba32f;
        const DrawList list = draw_list(scene);
        strata::peeling::Renderer renderer{list, view_under(clip, order), *find_profile("ideal"), options};
        const RenderResult result = renderer.render(algorithm);
        const auto depth = [&](std::size_t pixel) { return std::bit_cast<float>(result.frame.color.codes[4 * pixel]); };
        CHECK(depth(0) == (order == DepthOrder::less ? 0.25f : 0.75f));
        CHECK(depth(1) == (order == DepthOrder::less ? 0.875f : 0.125f));
    }
}

TEST_CASE("under GREATER every algorithm composites the same as under LESS and its depths are 1 - d", "[slow]") {
    int ran = 0, refused = 0;
    for (const unsigned seed : {1u, 2u}) {
        const FragmentScene scene = mixed_scene(seed);
        const DrawList list = draw_list(scene);
        for (const char* profile : {"ideal", "geforce8", "llvmpipe"})
            for (const auto& algorithm : strata::peeling::algorithms())
                for (const auto& [clip, format] : {std::pair{ClipDepth::minus_one_to_one, DepthFormat::d32f},
                                                   std::pair{ClipDepth::zero_to_one, DepthFormat::d32f},
                                                   std::pair{ClipDepth::zero_to_one, DepthFormat::d24},
                                                   std::pair{ClipDepth::minus_one_to_one, DepthFormat::d16}})
                    for (const Running& running : all_ways_of_running) {
                        INFO(profile << ' ' << algorithm.name << ' ' << static_cast<int>(clip) << ' '
                                     << static_cast<int>(format));
                        RenderOptions forward = options_under(scene, clip, DepthOrder::less, format);
                        RenderOptions reversed = options_under(scene, clip, DepthOrder::greater, format);
                        forward.keep_layers = reversed.keep_layers = algorithm.makes_layers;
                        running.apply(forward);
                        running.apply(reversed);
                        const Machine machine{profile, algorithm.name};
                        const RenderResult a = render(list, view_under(clip, DepthOrder::less), machine, forward);
                        const RenderResult b = render(list, view_under(clip, DepthOrder::greater), machine, reversed);
                        CHECK(a.refusal == b.refusal);
                        if (a.refusal) {
                            ++refused;
                            continue;
                        }
                        ++ran;
                        CHECK(a.frame.color == b.frame.color);
                        CHECK(are_reversed(a.frame.depth, b.frame.depth));
                        CHECK(a.frame.passes == b.frame.passes);
                        CHECK(a.audit == b.audit);
                        REQUIRE(a.frame.layers.size() == b.frame.layers.size());
                        for (std::size_t i = 0; i < a.frame.layers.size(); ++i) {
                            CHECK(a.frame.layers[i].color == b.frame.layers[i].color);
                            CHECK(are_reversed(a.frame.layers[i].depth, b.frame.layers[i].depth));
                        }
                    }
    }
    CHECK(ran > 200);
    CHECK(refused > 0);
}

TEST_CASE("clip space from 0 to 1 gives the bits of clip space from -1 to 1 where both projections are exact") {
    const FragmentScene scene = mixed_scene(3);
    const DrawList list = draw_list(scene);
    for (const char* profile : {"ideal", "geforce8", "geforce8_dx101"})
        for (const char* algorithm : {"front_to_back", "dual", "depth_units", "weighted_average", "a_buffer"}) {
            RenderOptions symmetric = options_for(scene), half = options_for(scene);
            half.raster.clip_depth = ClipDepth::zero_to_one;
            const RenderResult a = render(list, {}, {profile, algorithm}, symmetric);
            const RenderResult b =
                render(list, view_under(ClipDepth::zero_to_one, DepthOrder::less), {profile, algorithm}, half);
            CHECK(a.refusal == b.refusal);
            CHECK(a.frame.color == b.frame.color);
            CHECK(a.frame.depth == b.frame.depth);
        }
}

TEST_CASE("layers of a reversed peel are the fragments of each pixel from the greatest depth down") {
    std::mt19937 random{11};
    FragmentScene scene{4, 4};
    for (GivenPixel& pixel : scene.pixels)
        for (unsigned i = random() % 6; i-- > 0;) {
            const float depth = static_cast<float>(1 + random() % 4095) * 0x1p-12f;
            pixel.fragments.push_back({depth, {0.5f, 0.25f, 0, 0.5f}});
        }
    RenderOptions options = options_under(scene, ClipDepth::zero_to_one, DepthOrder::greater);
    options.keep_layers = true;
    // The scene's d is stored without reversal.
    const View as_drawn = view_under(ClipDepth::zero_to_one, DepthOrder::less);
    for (const char* name : {"front_to_back", "depth_units"}) {
        const RenderResult result = render(draw_list(scene), as_drawn, {"ideal", name}, options);
        REQUIRE(result.outcome == Outcome::done);
        for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
            std::vector<float> depths;
            for (const GivenFragment& f : scene.pixels[p].fragments) depths.push_back(f.depth);
            std::ranges::sort(depths, std::greater{});
            depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
            depths.resize(result.frame.layers.size(),
                          0.0f);  // a pixel without a further layer keeps the clear value, 0
            for (std::size_t layer = 0; layer < depths.size(); ++layer) {
                INFO(name << " pixel " << p << " layer " << layer);
                CHECK(std::bit_cast<float>(result.frame.layers[layer].depth.codes[p]) == depths[layer]);
            }
        }
    }
}

TEST_CASE("reversed float depth distinguishes walls that forward depth merges") {
    // Near 1, far at infinity: clip z is e - 1 under LESS and 1 under GREATER, w is e; all exact for these distances.
    for (const float distance : {0x1p10f, 0x1p14f, 0x1p20f}) {
        const float gap = distance * 0x1p-8f;
        INFO(distance);
        // 1 / e - 1 / (e + gap) in steps of binary32 below 1, which are 2^-24.
        const double forward_steps = (1 / double{distance} - 1 / (double{distance} + double{gap})) * 0x1p24;
        const DrawList list = two_walls(distance, gap);
        const auto layers = [&](DepthOrder order) {
            View view;
            view.projection[2][3] = -1;
            view.projection[3][3] = 0;
            const bool is_reversed = order == DepthOrder::greater;
            view.projection[2][2] = is_reversed ? 0 : -1;
            view.projection[3][2] = is_reversed ? 1 : -1;
            RenderOptions options;
            options.width = options.height = 8;
            options.threads = 1;
            options.depth = DepthFormat::d32f;
            options.raster.clip_depth = ClipDepth::zero_to_one;
            options.raster.depth_order = order;
            return render(list, view, {"geforce8", "front_to_back"}, options).audit.layers_max;
        };
        CHECK(layers(DepthOrder::greater) == 2);
        // 1 - 2^-20 is a binary32, and is the nearest one for depths less than half a step away.
        CHECK(layers(DepthOrder::less) == (forward_steps < 0.5 ? 1 : 2));
        CHECK((forward_steps < 0.5) == (distance == 0x1p20f));
    }
}

TEST_CASE("reversed depth is rejected by name over short floats or with a comparison between codes or with a light") {
    const FragmentScene scene = mixed_scene(4);
    const auto refusal_of = [&](const auto& change, const char* profile = "ideal") {
        RenderOptions options = options_under(scene, ClipDepth::minus_one_to_one, DepthOrder::greater);
        change(options);
        const RenderResult result = render(draw_list(scene), {}, {profile, "depth_units"}, options);
        return result.refusal ? result.refusal->message(*find_profile(profile)) : std::string{};
    };
    using Catch::Contains;
    CHECK(refusal_of([](RenderOptions&) {}).empty());
    CHECK(refusal_of([](RenderOptions& o) { o.depth = DepthFormat::d24; }).empty());
    CHECK(refusal_of([](RenderOptions& o) { o.depth.reset(); }, "geforce3").empty());
    for (const DepthFormat format : {DepthFormat::d16f, DepthFormat::d24f})
        CHECK_THAT(refusal_of([&](RenderOptions& o) { o.depth = format; }, "geforce3"),
                   Contains("float depth of 16 or 24 bits"));
    CHECK_THAT(refusal_of([](RenderOptions& o) { o.quantize_reference = false; }),
               Contains("absolute compare epsilon"));
    CHECK_THAT(refusal_of([](RenderOptions& o) { o.compare_epsilon.absolute = 1e-3; }),
               Contains("absolute compare epsilon"));
    CHECK(refusal_of([](RenderOptions& o) { o.compare_epsilon.ulps = 2; }).empty());
    CHECK(refusal_of([](RenderOptions& o) { std::swap(o.raster.depth_near, o.raster.depth_far); }).empty());
}
