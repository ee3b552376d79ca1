// Tests rare frames: sums and counts that stop growing, colours that MAX cannot order, depths that blending flushes,
// limits of one or two passes, lists in parts, fragments that are equal in everything. The expected results are those
// of literal execution, counts of pixels made by hand, or the same frame with enough memory.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "peeling/programs/average.h"
#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_order.h"
#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

// `layers` fragments at one pixel of 8 x 8, one at some others.
FragmentScene one_deep_pixel(int layers) {
    FragmentScene scene{8, 8};
    for (int i = 0; i < layers; ++i) scene.pixels[19].fragments.push_back({0.5f, {0.25f, 0.5f, 1, 0.25f}});
    for (const std::size_t p : {2u, 40u, 41u}) scene.pixels[p].fragments = {{0.25f, {1, 0, 0, 0.5f}}};
    return scene;
}

RenderResult on(const DeviceProfile& profile, const DrawList& list, const char* algorithm, const RenderOptions& options,
                const View& view = {}) {
    Renderer renderer{list, view, profile, options};
    return renderer.render(*find_algorithm(algorithm));
}

// Draws one_deep_pixel(40) with memory for one pixel's fragments, for two more, and for all: the results are equal.
template <class Composited>
FrameResult check_parts(Composited&& composited) {
    FrameResult whole = composited(~std::uint64_t{0});
    for (const std::uint64_t bytes : {40 * sizeof(KeyedFragment), 42 * sizeof(KeyedFragment)}) {
        const FrameResult parts = composited(bytes);
        CHECK(parts.color == whole.color);
        CHECK(parts.passes == whole.passes);
        CHECK(parts.counters == whole.counters);
        CHECK(parts.diagnostics == whole.diagnostics);
    }
    return whole;
}

// Draws the same frame literally and in tiles and compares pictures, statistics and audits.
void check_both_ways(const DeviceProfile& profile, const DrawList& list, const char* algorithm, RenderOptions options,
                     const View& view = {}) {
    options.execution = Execution::literal;
    const RenderResult literal = on(profile, list, algorithm, options, view);
    options.execution = Execution::replay;
    options.tile_size = 8;
    const RenderResult tiled = on(profile, list, algorithm, options, view);
    INFO(algorithm << " on " << profile.name);
    REQUIRE(literal.refusal.has_value() == tiled.refusal.has_value());
    CHECK(literal.frame.color == tiled.frame.color);
    CHECK(literal.frame.passes == tiled.frame.passes);
    CHECK(literal.frame.diagnostics == tiled.frame.diagnostics);
    CHECK(literal.audit == tiled.audit);
}

}  // namespace

TEST_CASE("a count of 2048 and a sum that is infinite are reported at their pixels on every instruction set") {
    const DeviceProfile& profile = *find_profile("geforce8");
    for (const strata::Simd simd : strata::available_simd())
        for (const Execution execution : {Execution::literal, Execution::replay}) {
            RenderOptions options = options_for(one_deep_pixel(1));
            options.simd = simd;
            options.execution = execution;
            options.tile_size = 8;
            const auto stuck = [&](int layers) {
                return on(profile, draw_list(one_deep_pixel(layers)), "weighted_average", options);
            };
            INFO("set " << static_cast<int>(simd));
            CHECK(diagnosed(stuck(2047), Fault::half_saturated) == 0);
            const RenderResult full = stuck(2048);
            CHECK(diagnosed(full, Fault::half_saturated) == 1);
            for (const Diagnostic& d : full.frame.diagnostics)
                if (d.fault == Fault::half_saturated) CHECK((d.first_x == 3 && d.first_y == 2));
            options.alpha = 3e5f;  // the sum of one such alpha, 75,000, exceeds a half
            CHECK(diagnosed(stuck(1), Fault::half_saturated) == 4);
            options.average_count = Format::r32f;
            CHECK(diagnosed(stuck(1), Fault::half_saturated) == 4);
            options.alpha.reset();
            CHECK(diagnosed(stuck(2048), Fault::half_saturated) == 0);
        }
}

TEST_CASE("a binary32 count is a whole number up to 2^30") {
    CHECK(strata::peeling::scalar::OneAverage::whole(0x1p31f) == 1u << 30);
    CHECK(strata::peeling::scalar::OneAverage::whole(7.0f) == 7);
    CHECK(strata::peeling::scalar::OneAverage::whole(-1.0f) == 0);
}

TEST_CASE("tiles give the frame's result where colours are signed zeros or depths are flushed", "[slow]") {
    FragmentScene signed_zeros{16, 8};
    Random random{19};
    for (GivenPixel& pixel : signed_zeros.pixels)
        for (int i = random_int(random, 0, 5); i-- > 0;) {
            const auto depth = static_cast<float>(random_int(random, 0, 7)) / 8.0f;
            const float zero = random_int(random, 0, 1) == 0 ? 0.0f : -0.0f;
            pixel.fragments.push_back({depth, {zero, -zero, 0.5f, 0.5f}});
        }
    const DrawList list = draw_list(signed_zeros);
    for (const char* algorithm : {"dual", "dual_independent", "front_to_back", "depth_units"})
        for (const char* profile : {"geforce8", "geforce8_dx101", "ideal"})
            for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
                for (const float far : {1.0f, 0x1p-127f}) {
                    RenderOptions options = options_for(signed_zeros);
                    options.color_format = format;
                    options.raster.depth_far = far;
                    check_both_ways(*find_profile(profile), list, algorithm, options);
                }
}

TEST_CASE("a resolve rounds blended colours like its profile") {
    DeviceProfile cuts = *find_profile("geforce8");
    cuts.blend_rounding = BlendRounding::truncate;
    const TriangleScene scene = random_triangles(23, 20);
    RenderOptions options;
    options.width = options.height = 32;
    options.threads = 1;
    for (const char* algorithm : {"dual", "front_to_back", "batched", "weighted_average", "layer_peel"}) {
        check_both_ways(cuts, scene.list, algorithm, options, scene.view);
        check_both_ways(*find_profile("geforce8"), scene.list, algorithm, options, scene.view);
    }
    CHECK(on(cuts, scene.list, "dual", options, scene.view).frame.color !=
          on(*find_profile("geforce8"), scene.list, "dual", options, scene.view).frame.color);
}

TEST_CASE("a limit of any number of passes ends every algorithm at that number in tiles and in the whole frame",
          "[slow]") {
    const TriangleScene scene = random_triangles(24, 14);
    RenderOptions options;
    options.width = options.height = 24;
    options.threads = 1;
    for (const Algorithm& algorithm : algorithms())
        for (const int most : {1, 2, 3, 5, 8}) {
            options.max_passes = most;
            if (refusal(algorithm, *find_profile("ideal"))) continue;
            check_both_ways(*find_profile("ideal"), scene.list, algorithm.name.c_str(), options, scene.view);
            CHECK(on(*find_profile("ideal"), scene.list, algorithm.name.c_str(), options, scene.view)
                      .frame.passes.geometry <= std::max(most, 2));
        }
}

TEST_CASE("masked materials that --alpha makes transparent are dropped by every peel and the rest is in order") {
    const TriangleScene scene = random_triangles(25, 20);
    RenderOptions options;
    options.width = options.height = 32;
    options.threads = 1;
    options.alpha = 0.5f;
    for (const char* algorithm :
         {"coherent_ideal", "coherent_stencil", "coherent_blend", "depth_units", "front_to_back"}) {
        check_both_ways(*find_profile("ideal"), scene.list, algorithm, options, scene.view);
        INFO(algorithm);
        CHECK(on(*find_profile("ideal"), scene.list, algorithm, options, scene.view).audit.order_errors == 0u);
    }
}

TEST_CASE(
    "an A-buffer with memory for a few pixels' lists at a time has the result and counts of one with memory for all") {
    const FragmentScene scene = one_deep_pixel(40);
    const auto composited = [&](std::uint64_t bytes) {
        TestFrame test{scene, "geforce8"};
        test.frame.list_bytes = bytes;
        return run(test.frame, find_algorithm("a_buffer")->run, Execution::literal, 1);
    };
    check_parts(composited);
}

// A list keeps its first fragments or its nearest, and blends the others behind, whatever part of the region it is in.
TEST_CASE("linked lists in parts have the result and counts and faults of those in one part for every overflow rule") {
    FragmentScene scene = one_deep_pixel(40);
    for (std::size_t i = 0; i < 40; ++i) {
        scene.pixels[19].fragments[i].depth = static_cast<float>(i * 7 % 40) / 64;
        scene.pixels[19].fragments[i].color[0] = static_cast<float>(i) / 64;
    }
    const Algorithm& algorithm = *find_algorithm("linked_list");
    for (const Overflow rule : {Overflow::drop_new, Overflow::drop_far, Overflow::blend})
        for (const auto& [pixel_nodes, frame_nodes] :
             {std::pair{0, 0}, std::pair{5, 0}, std::pair{0, 20}, std::pair{9, 11}}) {
            const auto composited = [&, &limit = pixel_nodes, &all = frame_nodes](std::uint64_t bytes) {
                TestFrame test{scene, "ideal"};
                test.frame.list_bytes = bytes;
                const ListingInputs inputs{.options = {.pixel_nodes = limit, .frame_nodes = all, .overflow = rule},
                                           .eye = {}};
                return run(
                    test.frame, [&](Region& region) { algorithm.run_with(region, inputs); }, Execution::literal, 1);
            };
            const FrameResult whole = check_parts(composited);
            CHECK(whole.diagnostics.empty() == (pixel_nodes + frame_nodes == 0));
        }
}

TEST_CASE("batches have no bounds for a w buffer's depths and peel it like any other") {
    DeviceProfile w_peels = *find_profile("ideal");
    w_peels.raster = find_profile("geforce3")->raster;
    const TriangleScene scene = random_triangles(27, 16);
    RenderOptions options;
    options.width = options.height = 32;
    options.threads = 1;
    options.depth = DepthFormat::d24;
    options.depth_path = strata::rasterizer::DepthPath::w_buffer;
    const RenderResult by_w = on(w_peels, scene.list, "batched", options, scene.view);
    REQUIRE(by_w.outcome == Outcome::done);
    CHECK(by_w.audit.order_errors == 0u);
    CHECK(by_w.frame.color == on(w_peels, scene.list, "front_to_back", options, scene.view).frame.color);
}

TEST_CASE("fragments that are equal in everything are interchangeable in the audit") {
    FragmentScene equal_tiles{4, 4};
    for (GivenPixel& pixel : equal_tiles.pixels)
        for (const float depth : {0.5f, 0.25f, 0.5f, 0.25f, 0.5f})
            pixel.fragments.push_back({depth, {depth, depth, 0.5f, 0.5f}});
    for (const Algorithm& algorithm : algorithms()) {
        const RenderResult result =
            on(*find_profile("ideal"), draw_list(equal_tiles), algorithm.name.c_str(), options_for(equal_tiles));
        INFO(algorithm.name);
        if (algorithm.exact) CHECK(result.audit.order_errors == 0u);
    }
}

TEST_CASE("an order that is far from sorted is sorted as well and tie policy none leaves an order unchanged") {
    std::vector<KeyedFragment> fragments(300);
    FragmentOrder near_order;
    for (std::uint32_t i = 0; i < fragments.size(); ++i) {
        fragments[i].key = i / 3;
        fragments[i].exact_code = 299 - i;  // reversed: more steps than the insertion sort is allowed
        near_order.push_back(std::uint64_t{fragments[i].key} << 32 | i);
    }
    FragmentOrder sorted;
    sort_almost(&KeyedFragment::exact_code, fragments, near_order, sorted);
    REQUIRE(sorted.size() == 300);
    for (std::uint32_t k = 0; k < 300; ++k) CHECK(submission_index(sorted[k]) == 299 - k);
    FragmentOrder by_key = near_order;
    apply(TiePolicy::none, by_key);
    CHECK(by_key == near_order);
}

TEST_CASE("depths and stencils have no colour") {
    for (const Format format : {Format::d24, Format::d32f, Format::s8}) {
        Image image = Image::for_overwrite(format, 1, 1, 1);
        std::fill(image.codes.begin(), image.codes.end(), 7u);
        CHECK(channel_value(image, 0, 0, 0) == 0.0);
    }
}
