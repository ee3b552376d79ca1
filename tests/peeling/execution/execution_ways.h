// tests/peeling/execution/execution_ways.h - ways of executing a frame, and their comparison with literal execution.
#pragma once
#include <array>
#include <catch2/catch.hpp>
#include <span>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/random_triangles.h"

namespace strata::testing {

struct ExecutionWay {
    pipeline::Execution execution;
    int tile_size, threads;
    pipeline::Effects effects;
    bool trust_idle;
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
};

inline constexpr std::array<ExecutionWay, 13> ways{
    {{pipeline::Execution::literal, 64, 4, pipeline::Effects::all, false},
     {pipeline::Execution::replay, 8, 1, pipeline::Effects::needed, true, 0},
     {pipeline::Execution::replay, 16, 4, pipeline::Effects::all, true, 0},
     {pipeline::Execution::replay, 16, 2, pipeline::Effects::needed, false, 0},
     {pipeline::Execution::replay, 32, 4, pipeline::Effects::needed, true, 0},
     {pipeline::Execution::replay, 64, 2, pipeline::Effects::all, false, 0},
     {pipeline::Execution::replay, 128, 1, pipeline::Effects::needed, true, 0},
     {pipeline::Execution::replay, 8, 1, pipeline::Effects::needed, true},
     {pipeline::Execution::replay, 32, 4, pipeline::Effects::needed, false},
     {pipeline::Execution::replay, 64, 2, pipeline::Effects::all, true},
     {pipeline::Execution::replay, 128, 2, pipeline::Effects::needed, true},
     {pipeline::Execution::replay, 64, 1, pipeline::Effects::needed, true, std::uint64_t{300} << 10},
     {pipeline::Execution::replay, 16, 2, pipeline::Effects::needed, true, std::uint64_t{4} << 10}}};

[[nodiscard]] inline peeling::RenderOptions with(peeling::RenderOptions options, const ExecutionWay& way) {
    options.execution = way.execution;
    options.tile_size = way.tile_size;
    options.threads = way.threads;
    options.effects = way.effects;
    options.fragment_memory = way.fragment_memory;
    return options;
}

// Compares every way with literal execution in one thread and reports the first difference.
inline void check_all_ways(const TriangleScene& scene, const Machine& machine, peeling::RenderOptions options,
                           std::span<const ExecutionWay> chosen = ways) {
    options.execution = pipeline::Execution::literal;
    options.threads = 1;
    const peeling::RenderResult expected = render(scene.list, scene.view, machine, options);
    REQUIRE(expected.outcome == peeling::Outcome::done);
    // the literal run is reproducible
    CHECK(difference(render(scene.list, scene.view, machine, options), expected).empty());
    for (const ExecutionWay& way : chosen) {
        const peeling::RenderResult found =
            render(scene.list, scene.view, machine, with(options, way), {.trust_idle = way.trust_idle});
        INFO(machine.algorithm << " on " << machine.profile << ", tile " << way.tile_size << ", threads " << way.threads
                               << ", literal " << (way.execution == pipeline::Execution::literal) << ", trusts idle "
                               << way.trust_idle << ", fragment memory " << way.fragment_memory);
        CHECK(difference(found, expected) == "");
    }
}

// Draws with a profile that is not a built-in one.
[[nodiscard]] inline peeling::RenderResult drawn_on(const pipeline::DeviceProfile& profile, const TriangleScene& scene,
                                                    const char* algorithm, const peeling::RenderOptions& options) {
    peeling::Renderer renderer{scene.list, scene.view, profile, options};
    return renderer.render(*peeling::find_algorithm(algorithm), {}, {});
}

[[nodiscard]] inline peeling::RenderOptions small_frame() {
    peeling::RenderOptions options;
    options.width = 76;  // neither is a multiple of a tile
    options.height = 52;
    options.background = {0.1f, 0.2f, 0.3f, 1};
    return options;
}

}  // namespace strata::testing
