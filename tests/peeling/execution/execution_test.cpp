// Tests that results do not depend on how a frame is executed; literal execution is the definition.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/execution/execution_ways.h"
#include "tests/peeling/expectations.h"
#include "tests/support/host_environment.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Execution;
using strata::pipeline::Termination;
using strata::pipeline::TerminationRule;

struct Ending {
    const char* name;
    Termination termination;
    int max_passes;
};

const std::vector<Ending> endings{{"exact", {}, 0},
                                  {"paper", {.rule = TerminationRule::paper}, 0},
                                  {"any", {.rule = TerminationRule::any}, 0},
                                  {"ratio", {.rule = TerminationRule::ratio, .ratio = 0.125}, 0},
                                  {"a ratio above the first count", {.rule = TerminationRule::ratio, .ratio = 40}, 0},
                                  {"fixed", {.rule = TerminationRule::fixed, .passes = 4}, 0},
                                  {"fixed beyond the last layer", {.rule = TerminationRule::fixed, .passes = 12}, 0},
                                  {"max_passes", {}, 3},
                                  {"the first pass", {}, 1}};

std::vector<Machine> machines() {
    auto all = machines_of(Kind::loop);
    all.push_back({"ideal", "dual"});
    return all;
}

// Compares all executions on every machine, for each of these ways to end a frame.
void check_endings(const FragmentScene& scene, const std::vector<Ending>& chosen) {
    const TriangleScene triangles{draw_list(scene), {}};
    for (const Ending& ending : chosen)
        for (const Machine& machine : machines()) {
            RenderOptions options = options_for(scene);
            options.termination = ending.termination;
            options.max_passes = ending.max_passes;
            INFO("ended by " << ending.name);
            check_all_ways(triangles, machine, options);
        }
}

}  // namespace

TEST_CASE("algorithms of a partial order execute alike resolved and as published for any ending of their queries",
          "[slow]") {
    TriangleScene scene = random_triangles(79, 12);
    scene.list.instances[0].arrives_sorted = true;  // false, but this must not change any execution
    const std::vector<ExecutionWay> few{ways[0], ways[1], ways[3], ways[8], ways[12]};
    for (const Ending& ending : endings)
        for (const Machine& machine : machines_of(Kind::partial_order))
            for (const auto formulation :
                 {strata::pipeline::Formulation::resolved, strata::pipeline::Formulation::published}) {
                RenderOptions options = small_frame();
                options.termination = ending.termination;
                options.max_passes = ending.max_passes;
                options.formulation = formulation;
                INFO("ended by " << ending.name
                                 << (formulation == strata::pipeline::Formulation::published ? ", as published" : ""));
                if (formulation == strata::pipeline::Formulation::published && machine.algorithm.ends_with("buffer"))
                    continue;
                check_all_ways(scene, machine, options, few);
            }
}

TEST_CASE("no tile size or thread count or other setting changes an algorithm's result for any ending of its queries",
          "[slow]") {
    const TriangleScene scene = random_triangles(71, 16);
    for (const Ending& ending : endings)
        for (const Machine& machine : machines()) {
            RenderOptions options = small_frame();
            options.termination = ending.termination;
            options.max_passes = ending.max_passes;
            INFO("ended by " << ending.name);
            check_all_ways(scene, machine, options);
        }
}

TEST_CASE("scenes in one corner and without triangles and with opaque surfaces only execute alike", "[slow]") {
    for (const TriangleScene& scene : {random_triangles(72, 12, 0.25f), random_triangles(73, 0), opaque_only(74, 8)})
        for (const Machine& machine : machines()) {
            RenderOptions options = small_frame();
            check_all_ways(scene, machine, options);
            options.termination.rule = TerminationRule::paper;
            check_all_ways(scene, machine, options);
        }
}

TEST_CASE("a tile that ends early with fragments exactly at its opaque surface counts like the frame that continues",
          "[slow]") {
    FragmentScene scene{16, 16};  // four tiles of 8 x 8
    const strata::pipeline::Rgba glass{1, 0.5f, 0.25f, 0.5f};
    scene.pixels[0] = {{{0.5f, glass}}, GivenFragment{0.5f, glass}};
    scene.pixels[3] = {{{0.25f, glass}, {0.5f, glass}, {0.75f, glass}, {0.5f, glass}}, GivenFragment{0.5f, glass}};
    for (const float depth : {0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.625f})
        scene.pixels[255].fragments.push_back({depth, glass});
    check_endings(scene, endings);
}

TEST_CASE("rows of pixels whose fragments are all behind the opaque surface execute alike", "[slow]") {
    FragmentScene scene{32, 16};
    const strata::pipeline::Rgba glass{1, 0.5f, 0.25f, 0.5f};
    for (std::size_t pixel = 0; pixel < scene.pixels.size(); ++pixel) {
        GivenPixel& given = scene.pixels[pixel];
        const std::size_t row = pixel / 32;
        given.opaque = GivenFragment{0.5f, glass};
        for (std::size_t k = 0; k <= row % 3; ++k)
            given.fragments.push_back({0.5f + 0.125f * static_cast<float>(k), glass});
        if (row % 4 == 3) given.fragments.push_back({0.25f, glass});
    }
    check_endings(scene, {endings[0], endings[1], endings[5], endings[8]});
}

TEST_CASE("kept layers are those of literal execution for any max_passes", "[slow]") {
    const TriangleScene scene = random_triangles(75, 24, 0.4f);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"},
                                   {"geforce3", "depth_units"},
                                   {"geforce3", "shadow_map"},
                                   {"geforce8", "dual"},
                                   {"geforce8_dx101", "dual_independent"}}) {
        RenderOptions options = small_frame();
        options.keep_layers = true;
        const int layers = render(scene.list, scene.view, machine, options).audit.layers_max;
        REQUIRE(layers > 3);
        for (const int max_passes : {0, 1, layers - 1, layers, layers + 1, layers + 2}) {
            options.max_passes = max_passes;
            INFO(layers << " layers, " << max_passes << " passes at most");
            check_all_ways(scene, machine, options);
        }
        options.max_passes = 0;
        options.termination = {.rule = TerminationRule::ratio, .ratio = 0.05};
        check_all_ways(scene, machine, options);
    }
}

TEST_CASE("an algorithm that keeps layers keeps one for each distinct depth of the deepest pixel") {
    const TriangleScene scene = random_triangles(76, 24);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"}, {"geforce3", "depth_units"}})
        for (const Execution execution : {Execution::literal, Execution::replay}) {
            RenderOptions options = small_frame();
            options.keep_layers = true;
            options.execution = execution;
            options.fragment_memory = 0;
            const RenderResult result = render(scene.list, scene.view, machine, options);
            CHECK(result.frame.layers.size() == static_cast<std::size_t>(result.audit.layers_max));
        }
}

TEST_CASE("a host with flush-to-zero or another rounding mode gets the same bits and its environment is restored",
          "[slow]") {
    TriangleScene scene = random_triangles(78, 30);
    scene.view.view = {0.95, 0.02, 0.1, 0, -0.03, 0.99, 0.05, 0, -0.1, -0.04, 0.97, 0, 0.01, 0.02, -0.03, 1};
    for (auto& instance : scene.list.instances) instance.model[0][0] = 1.1;  // makes the matrix product inexact
    for (const Machine& machine : machines()) {
        RenderOptions options = small_frame();
        options.threads = 2;
        const RenderResult expected = render(scene.list, scene.view, machine, options);
        for (const unsigned host : host_environments) {
            const HostEnvironment environment{host};
            strata::peeling::Renderer renderer{scene.list, scene.view, *strata::pipeline::find_profile(machine.profile),
                                               options};
            const bool kept_by_constructor = environment.is_in_force();
            const RenderResult found = renderer.render(*strata::peeling::find_algorithm(machine.algorithm));
            const bool kept_by_render = environment.is_in_force();
            const std::size_t fragments =
                renderer.fragments(*strata::peeling::find_algorithm(machine.algorithm)).all.size();
            INFO(machine.algorithm << ", host " << std::hex << host);
            CHECK(kept_by_constructor);
            CHECK(kept_by_render);
            CHECK(environment.is_in_force());
            CHECK(difference(found, expected) == "");
            CHECK(fragments > 100);
        }
    }
}

TEST_CASE("one renderer bins triangles into the tiles that each algorithm requests and every size gives the same bits",
          "[slow]") {
    const TriangleScene scene = random_triangles(79, 20);
    RenderOptions options = small_frame();
    options.width = 1024;
    options.height = 512;
    options.threads = 2;
    options.audit = false;
    const auto renderer = [&] {
        return strata::peeling::Renderer{scene.list, scene.view, *strata::pipeline::find_profile("geforce8_dx101"),
                                         options};
    };
    strata::peeling::Renderer automatic = renderer();
    options.tile_size = 32;
    strata::peeling::Renderer small = renderer();
    for (const auto& [name, tile_size] : {std::pair{"weighted_average", 128},
                                          {"dual_independent", 32},
                                          {"front_to_back", 64},
                                          {"weighted_average", 128}}) {
        const auto& algorithm = *strata::peeling::find_algorithm(name);
        const RenderResult found = automatic.render(algorithm), expected = small.render(algorithm);
        CHECK(found.frame.work.tile_size == tile_size);
        CHECK(expected.frame.work.tile_size == 32);
        CHECK(found.frame.color == expected.frame.color);
        CHECK(found.frame.counters == expected.frame.counters);
    }
}
