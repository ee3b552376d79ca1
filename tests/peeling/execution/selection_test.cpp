// Tests passes that visit only selected fragments, against visiting all fragments, pass by pass, from the same targets;
// and against the scene's known number of layers.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <tuple>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;

RenderOptions frame_of_many_tiles() {
    RenderOptions options;
    options.width = 76;
    options.height = 52;
    options.tile_size = 16;
    options.threads = 1;
    options.background = {0.1f, 0.2f, 0.3f, 1};
    return options;
}

enum class Arrival : std::uint8_t { shuffled, near_to_far, far_to_near, nearly_sorted };

// `layers` at every pixel, by default in a submission order unrelated to depth.
FragmentScene deep_scene(std::uint32_t layers, Arrival arrival = Arrival::shuffled, int side = 16) {
    FragmentScene scene{side, side};
    Random random{5};
    for (auto& pixel : scene.pixels) {
        std::vector<std::uint32_t> order(layers);
        for (std::uint32_t k = 0; k < layers; ++k) order[k] = k;
        if (arrival == Arrival::shuffled) std::shuffle(order.begin(), order.end(), random);
        // Some neighbours are swapped; and below, every fifth fragment has the depth of the previous one.
        const bool is_nearly_sorted = arrival == Arrival::nearly_sorted;
        for (std::uint32_t k = 1; k < layers && is_nearly_sorted;
             k += static_cast<std::uint32_t>(random_int(random, 2, 60)))
            std::swap(order[k - 1], order[k]);
        if (arrival == Arrival::far_to_near) std::reverse(order.begin(), order.end());
        for (const std::uint32_t k : order)
            pixel.fragments.push_back({static_cast<float>(is_nearly_sorted && k % 5 == 4 ? k : k + 1) / 2048.0f,
                                       {random_channel(random), 0.5f, 0.25f, 0.5f}});
    }
    return scene;
}

const std::vector<Machine> one_layer_peels{{"geforce3", "depth_units"},
                                           {"geforce3", "shadow_map_depth_replace"},
                                           {"geforce8", "layer_peel"},
                                           {"geforce8", "hybrid"},
                                           {"geforce8", "batched"},
                                           {"ideal", "shadow_map"},
                                           {"geforce8_dx101", "dual_independent"}};

}  // namespace

TEST_CASE("every selection keeps the contract with its program for every algorithm and format", "[slow]") {
    const TriangleScene scene = random_triangles(91, 24);
    for (const auto& algorithm : strata::peeling::algorithms())
        for (const char* profile : {"geforce3", "geforce8", "geforce8_dx101", "ideal"})
            for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
                for (const int max_passes : {0, 7}) {
                    if (refusal(algorithm, *find_profile(profile))) continue;
                    if (check(*find_profile(profile), format)) continue;
                    RenderOptions options = frame_of_many_tiles();
                    options.color_format = format;
                    options.max_passes = max_passes;
                    INFO(algorithm.name << " on " << profile << ", at most " << max_passes << " passes");
                    strata::peeling::Algorithm by_passes = algorithm;
                    by_passes.resolve_loop = nullptr;
                    strata::peeling::Renderer renderer{scene.list, scene.view, *find_profile(profile), options};
                    CHECK_NOTHROW(renderer.render(by_passes, {}, {.check_selections = true}));
                }
}

TEST_CASE("selections by another depth and with spare codes and as published keep their contract", "[slow]") {
    const TriangleScene scene = random_triangles(92, 24);
    const auto check = [&](const char* algorithm, const RenderOptions& options, const char* what) {
        for (const char* profile : {"geforce3", "geforce8_dx101", "ideal"}) {
            if (refusal(*strata::peeling::find_algorithm(algorithm), *find_profile(profile))) continue;
            INFO(algorithm << " on " << profile << ", " << what);
            CHECK_NOTHROW(render(scene.list, scene.view, {profile, algorithm}, options, {.check_selections = true}));
        }
    };
    for (const char* algorithm : {"depth_units", "shadow_map", "front_to_back", "dual", "dual_independent"}) {
        RenderOptions by_reference = frame_of_many_tiles();
        by_reference.reference_path = strata::rasterizer::DepthPath::perspective_rq;
        check(algorithm, by_reference, "by a reference path");
        RenderOptions raised = by_reference;
        raised.compare_epsilon.ulps = 3;
        check(algorithm, raised, "by a reference path and three codes more");
        RenderOptions own = frame_of_many_tiles();
        own.depth = DepthFormat::d24;
        own.compare_epsilon.ulps = 2;
        check(algorithm, own, "two codes more");
        own.compare_epsilon.absolute = 0x1p-12;
        check(algorithm, own, "a part of the range more");
        RenderOptions unrounded = by_reference;
        unrounded.quantize_reference = false;
        check(algorithm, unrounded, "by a reference path that is not rounded");
        unrounded.vertex_paths.second = VertexPath::fused;
        check(algorithm, unrounded, "by other vertices and a reference path that is not rounded");
        RenderOptions wide = by_reference;
        wide.compare_epsilon.absolute = 0.05;  // several fragments at either end of a pass
        wide.color_format = Format::rgba16f;
        check(algorithm, wide, "by a twentieth of the range, in halves");
    }
    for (const char* algorithm : {"layer_peel", "hybrid", "coherent_stencil", "coherent_blend", "coherent_ideal"}) {
        RenderOptions published = frame_of_many_tiles();
        published.formulation = Formulation::published;
        check(algorithm, published, "as published");
    }
}

// As published, a run begins by ending at the value to which the registers are cleared, depth 0, and fragments there
// are composited although they are not before the opaque surface.
TEST_CASE("as published coherent_ideal composites fragments at depth 0 at an opaque surface there") {
    FragmentScene scene{8, 8};
    for (auto& pixel : scene.pixels) {
        pixel.opaque = GivenFragment{0.0f, {0, 0, 1, 1}};
        pixel.fragments = {{0.0f, {1, 0, 0, 0.5f}}, {0.25f, {0, 1, 0, 0.5f}}, {0.5f, {0, 1, 0, 0.5f}}};
    }
    RenderOptions options = options_for(scene);
    options.formulation = Formulation::published;
    const DrawList list = draw_list(scene);
    const Machine machine{"ideal", "coherent_ideal"};
    CHECK_NOTHROW(render(list, {}, machine, options, {.check_selections = true}));
    options.execution = Execution::literal;
    const Image literal = render(list, {}, machine, options).frame.color;
    options.execution = Execution::replay;
    CHECK(render(list, {}, machine, options).frame.color.codes == literal.codes);
}

// In a range up to 2^-120 the depths between these ends are denormal: a profile that flushes them stores 0. Ends that
// are normal in every pixel write no range, and so do not flush it again.
TEST_CASE("fragments between a peel's ends give the result of its blend including denormal depths") {
    FragmentScene scene{8, 8};
    Random random{93};
    for (auto& pixel : scene.pixels)
        for (const float depth : {0.0f, 0x1p-10f, 0x1p-8f, 0.5f})
            pixel.fragments.push_back({depth, random_color(random)});
    RenderOptions options = options_for(scene);
    options.max_passes = 6;
    options.raster.depth_far = 0x1p-120f;
    const DrawList list = draw_list(scene);
    for (const char* profile : {"geforce8_dx101", "ideal"}) {
        INFO(profile);
        CHECK_NOTHROW(render(list, {}, {profile, "dual_independent"}, options, {.check_selections = true}));
    }
}

TEST_CASE("a selection whose contract its program breaks is detected where selections are checked") {
    TestFrame frame{deep_scene(5), "geforce8"};
    frame.frame.replay = {std::uint64_t{1} << 20, {}};
    bool drops_the_nearest = false;
    const Body body = [&](Region& region) {
        const Target nearest = region.make_depth();
        region.copy(region.opaque_depth(), nearest);
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = nearest;
        state.color[0] = region.make_color();
        state.selection = {.keeps = KeptFragments::nearest};
        static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
            out.color[0] = in.color;
            for (int i = 0; drops_the_nearest && i < in.count; ++i)
                if (in.shader_z[static_cast<std::size_t>(i)] <= 1.5f / 2048.0f) out.discard(i);
        }));
        region.publish(state.color[0]);
    };
    const auto run_with = [&](const Instruments& instruments) {
        return run(frame.frame, body, Execution::replay, 1, {}, instruments);
    };
    CHECK_NOTHROW(run_with({.check_selections = true}));
    drops_the_nearest = true;
    CHECK_THROWS_AS(run_with({.check_selections = true}), std::logic_error);
    CHECK_NOTHROW(run_with({}));
}

TEST_CASE("stencil routing visits every fragment once for any number of passes", "[slow]") {
    for (const std::uint32_t layers : {7u, 16u, 64u, 240u}) {
        const FragmentScene scene = deep_scene(layers);
        RenderOptions options = options_for(scene);
        options.tile_size = 8;
        const auto result = render(scene, {"geforce8", "stencil_routed_k_buffer"}, options);
        CHECK(result.frame.passes.geometry == static_cast<int>((layers + 7) / 8));
        CHECK(result.frame.work.visited == std::uint64_t{layers} * scene.pixels.size());
    }
}

TEST_CASE("coherent peeling in its intended order visits each fragment once per pass of its iteration", "[slow]") {
    for (const auto& [profile, algorithm, passes] :
         {std::tuple{"geforce8", "coherent_stencil", 6u}, std::tuple{"geforce8", "coherent_blend", 5u},
          std::tuple{"ideal", "coherent_ideal", 2u}})
        for (const std::uint32_t layers : {16u, 64u, 128u}) {
            const FragmentScene scene = deep_scene(layers, Arrival::near_to_far);
            RenderOptions options = options_for(scene);
            options.tile_size = 8;
            options.audit = false;
            const auto frame = render(scene, {profile, algorithm}, options).frame;
            INFO(algorithm << ", " << layers << " layers, " << frame.iterations << " iterations");
            CHECK(frame.iterations <= 2);
            CHECK(frame.work.visited >= std::uint64_t{layers} * scene.pixels.size());
            CHECK(frame.work.visited <= (std::uint64_t{passes} * layers + 1) * scene.pixels.size());
        }
}

TEST_CASE("runs in deep pixels are those that visiting everything finds in every submission order", "[slow]") {
    for (const auto& [profile, algorithm] :
         {std::pair{"geforce8", "coherent_stencil"}, std::pair{"geforce8", "coherent_blend"},
          std::pair{"ideal", "coherent_ideal"}})
        for (const Arrival arrival :
             {Arrival::far_to_near, Arrival::near_to_far, Arrival::shuffled, Arrival::nearly_sorted}) {
            const FragmentScene scene = deep_scene(300, arrival, 4);
            const DrawList list = draw_list(scene);
            RenderOptions options = options_for(scene);
            options.audit = false;
            INFO(algorithm << ", arrival " << static_cast<int>(arrival));
            CHECK_NOTHROW(render(list, {}, {profile, algorithm}, options, {.check_selections = true}));
        }
}

TEST_CASE("the number of fragments that a peel visits grows with its layers and not with their square for any memory",
          "[slow]") {
    for (const Machine& machine : one_layer_peels)
        for (const std::uint32_t layers : {16u, 64u, 256u, 1024u}) {
            const FragmentScene scene = deep_scene(layers);
            RenderOptions options = options_for(scene);
            options.tile_size = 8;
            options.audit = false;
            const std::uint64_t fragments = std::uint64_t{layers} * scene.pixels.size();
            const auto visited = [&](std::uint64_t memory) {
                options.fragment_memory = memory;
                return render(scene, machine, options).frame.work.visited;
            };
            const std::uint64_t in_much = visited(std::uint64_t{256} << 20);
            INFO(machine.algorithm << ", " << layers << " layers: " << in_much << " of " << fragments);
            CHECK(in_much >= fragments);
            CHECK(in_much <= 2 * fragments + 8 * scene.pixels.size());
            CHECK(visited(std::uint64_t{1} << 20) == in_much);
        }
}

TEST_CASE("peels that count ties visit a few fragments for each that they take, and a depth's at most once a pass",
          "[slow]") {
    for (const char* algorithm : {"front_to_back_ties", "dual_ties"})
        for (const std::uint32_t tied : {1u, 2u, 5u})
            for (const std::uint32_t layers : {20u, 100u}) {
                FragmentScene scene = deep_scene(layers);
                for (auto& pixel : scene.pixels)
                    for (std::uint32_t k = 0; k < layers * (tied - 1); ++k)
                        pixel.fragments.push_back(pixel.fragments[k % layers]);
                RenderOptions options = options_for(scene);
                options.tile_size = 8;
                options.audit = false;
                INFO(algorithm << ", " << layers << " depths of " << tied << " fragments");
                const std::uint64_t fragments = std::uint64_t{layers} * tied * scene.pixels.size();
                const std::uint64_t visited = render(scene, {"geforce8", algorithm}, options).frame.work.visited;
                CHECK(visited >= 2 * fragments);
                CHECK(visited <= (tied + 4) * fragments + 8 * scene.pixels.size());
            }
}
