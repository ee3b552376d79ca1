// tests/peeling/expectations.h - properties that tests expect of each algorithm, one row per algorithm, written from
// the papers and the pages and not read from the registry. Later algorithms have their rows in their own tests
// (algorithms/NAME_test.cpp), as an `ExpectedRow`.
#pragma once
#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/peeling/rendering.h"

namespace strata::testing {

// Which execution tests draw the algorithm: those of single loops, those with queries inside an iteration, those of
// lists of objects.
enum class Kind { loop, partial_order, objects };
// The least capable devices on which an algorithm runs: pipeline/reference/devices.md 10.
enum class Devices {
    everything,
    programmable,
    independent_blending,
    many_samples,
    texture_shaders,
    buffers,
    ideal_alone
};

struct Expectation {
    std::string algorithm;
    Devices devices = Devices::everything;
    int (*passes)(int layers) = nullptr;  // number of geometry passes; null if it does not depend on the layers alone
    std::set<std::string> targets;        // names of its targets
    int render_targets = 1;               // in its widest pass
    int samples = 1;
    bool loses_ties = false;  // loses fragments at a depth that it has composited
    Kind kind = Kind::loop;
    // The least capable device that runs it.
    [[nodiscard]] std::string profile() const {
        if (devices == Devices::everything || devices == Devices::texture_shaders) return "geforce3";
        if (devices == Devices::independent_blending) return "geforce8_dx101";
        return devices == Devices::ideal_alone || devices == Devices::buffers ? "ideal" : "geforce8";
    }
    [[nodiscard]] bool runs_on(std::string_view device) const {
        constexpr std::string_view drivers[]{"llvmpipe", "llvmpipe_sse", "softpipe", "swiftshader"};
        const bool is_driver = std::ranges::find(drivers, device) != std::end(drivers);
        switch (devices) {
            case Devices::everything: return true;
            case Devices::programmable: return device != "geforce3";
            case Devices::independent_blending: return device != "geforce3" && device != "geforce8";
            case Devices::many_samples: return device != "geforce3" && !is_driver;
            case Devices::texture_shaders: return device == "geforce3" || device == "ideal";
            case Devices::buffers:
                return device == "ideal" || device == "llvmpipe" || device == "llvmpipe_sse" || device == "direct3d11";
            case Devices::ideal_alone: return device == "ideal" || device == "direct3d11";
        }
        return false;
    }
};

// The rows of single tests are added before main; until then the list is incomplete.
[[nodiscard]] inline std::vector<Expectation>& rows_of_expectations() {
    using enum Devices;
    constexpr auto once = [](int) { return 1; };
    constexpr auto layers_and_one = [](int n) { return n + 1; };
    static std::vector<Expectation> rows{
        {.algorithm = "unsorted", .devices = everything, .passes = once, .targets = {"color"}},
        {.algorithm = "painter", .devices = everything, .passes = once, .targets = {"color"}},
        {.algorithm = "depth_units",
         .devices = everything,
         .passes = layers_and_one,
         .targets = {"layer", "nearest", "result"},
         .loses_ties = true},
        // Only where both depths are equal, as in scenes of given depths.
        {.algorithm = "shadow_map",
         .devices = everything,
         .passes = layers_and_one,
         .targets = {"color", "depth", "map", "layer", "result"},
         .loses_ties = true},
        {.algorithm = "shadow_map_depth_replace",
         .devices = texture_shaders,
         .passes = layers_and_one,
         .targets = {"color", "depth", "map", "layer", "result"},
         .loses_ties = true},
        {.algorithm = "front_to_back",
         .devices = programmable,
         .passes = layers_and_one,
         .targets = {"accumulated", "layer", "nearest", "result"},
         .loses_ties = true},
        {.algorithm = "dual",
         .devices = programmable,
         .passes = [](int n) { return n < 2 ? 2 : 1 + (n + 1) / 2; },
         .targets = {"min_max", "front", "back_layer", "back", "result"},
         .render_targets = 3,
         .loses_ties = true},
        {.algorithm = "dual_independent",
         .devices = independent_blending,
         .passes = [](int n) { return (n + 1) / 2 + 2; },
         .targets = {"min_max", "front", "back", "result"},
         .render_targets = 3},
        {.algorithm = "weighted_average",
         .devices = programmable,
         .passes = once,
         .targets = {"sums", "count", "result"},
         .render_targets = 2},
        {.algorithm = "weighted_sum", .devices = programmable, .passes = once, .targets = {"sums", "result"}},
        {.algorithm = "layer_peel",
         .devices = programmable,
         .passes = [](int n) { return 2 * n + 1; },
         .targets = {"accumulated", "layer", "result"},
         .kind = Kind::partial_order},
        {.algorithm = "hybrid",
         .devices = programmable,
         .targets = {"accumulated", "layer", "result"},
         .kind = Kind::partial_order},
        {.algorithm = "coherent_stencil",
         .devices = programmable,
         .targets = {"accumulated", "stencil", "nearest", "previous", "breaker", "reached", "last_in_order", "result"},
         .kind = Kind::partial_order},
        {.algorithm = "coherent_blend",
         .devices = programmable,
         .targets = {"accumulated", "stencil", "nearest", "previous", "breaker", "reached", "last_in_order", "shifted",
                     "result"},
         .kind = Kind::partial_order},
        {.algorithm = "coherent_ideal",
         .devices = ideal_alone,
         .targets = {"accumulated", "registers", "peel", "result"},
         .render_targets = 2,
         .kind = Kind::partial_order},
        {.algorithm = "stencil_routed_k_buffer",
         .devices = many_samples,
         .targets = {"samples_color", "samples_depth", "stencil", "result"},
         .samples = 8,
         .kind = Kind::partial_order},
        {.algorithm = "k_buffer",
         .devices = ideal_alone,
         .passes = once,
         .targets = {"accumulated", "depths", "entry", "result"},
         .render_targets = 6,
         .kind = Kind::partial_order},
        {.algorithm = "batched",
         .devices = programmable,
         .targets = {"layer", "nearest", "accumulated", "result"},
         .loses_ties = true,
         .kind = Kind::objects},
        {.algorithm = "object_sorted",
         .devices = programmable,
         .targets = {"accumulated", "nearest", "result"},
         .kind = Kind::objects},
        {.algorithm = "a_buffer", .devices = everything, .passes = once, .targets = {"result"}},
    };
    return rows;
}

struct ExpectedRow {
    explicit ExpectedRow(Expectation row) { rows_of_expectations().push_back(std::move(row)); }
};

// The rows of all algorithms.
[[nodiscard]] inline const std::vector<Expectation>& expectations() { return rows_of_expectations(); }

// The algorithms of one kind, each on its least capable device.
[[nodiscard]] inline std::vector<Machine> machines_of(Kind kind) {
    std::vector<Machine> machines;
    for (const Expectation& expected : expectations())
        if (expected.kind == kind) machines.push_back({expected.profile(), expected.algorithm});
    return machines;
}

[[nodiscard]] inline const Expectation& expected_of(std::string_view algorithm) {
    return *std::ranges::find(expectations(), algorithm, &Expectation::algorithm);
}

}  // namespace strata::testing
