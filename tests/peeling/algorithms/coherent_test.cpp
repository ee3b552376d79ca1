// Tests coherent layer peeling pass by pass: the paper's Figure 2, its limits of 128 and 255, and the number of
// iterations.
#include "peeling/loops/coherent.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "pipeline/region/region_shortcuts.h"
#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

// One pixel with these depths in units of 1/128, in submission order, before a surface at `opaque`.
FragmentScene one_pixel(const std::vector<int>& depths, int opaque = 0) {
    FragmentScene scene{4, 4};
    Random random{7};
    const auto depth = [](int units) { return static_cast<float>(units) / 128.0f; };
    for (const int units : depths) scene.pixels[0].fragments.push_back({depth(units), random_color(random)});
    if (opaque > 0) scene.pixels[0].opaque = GivenFragment{depth(opaque), {0, 0, 0, 1}};
    return scene;
}

// The passes of an iteration, run one at a time over the frame; depths are in units of 1/128.
struct Passes {
    TestFrame test;
    strata::pipeline::RegionStatistics statistics;
    Region region;
    CoherentPeel peel;

    explicit Passes(const FragmentScene& scene)
        : test{scene, "geforce8"}, region{test.frame, {test.frame.rect()}, statistics}, peel{region} {
        test.frame.trace = true;
    }
    [[nodiscard]] double depth(Target target) const {
        return 128.0 * std::bit_cast<float>(region.storage(target).depth(0)[0]);
    }
    [[nodiscard]] std::uint32_t stencil() const { return region.storage(peel.stencil).stencil(0)[0]; }
    // Depths of pixel 0 that were composited since the last call, in units of 1/128.
    std::vector<double> composited() {
        std::vector<double> depths;
        for (std::size_t i = 0; i < RegionShortcuts{region}.trace().size(); ++i)
            if (const TraceEntry& e = RegionShortcuts{region}.trace()[i]; e.pixel == 0)
                depths.push_back(128.0 * std::bit_cast<float>(e.key));
        RegionShortcuts{region}.trace().clear();
        return depths;
    }
};

using Depths = std::vector<double>;

FragmentScene stack(int count, bool ascending) {
    FragmentScene scene{4, 4};
    Random random{11};
    for (int i = 0; i < count; ++i)
        scene.pixels[5].fragments.push_back(
            {static_cast<float>(ascending ? i + 1 : count - i) / 1024.0f, random_color(random)});
    return scene;
}

int iterations(const Machine& machine, const FragmentScene& scene, TerminationRule rule = TerminationRule::exact) {
    RenderOptions options = options_for(scene);
    options.termination.rule = rule;
    const RenderResult result = render(scene, machine, options);
    CHECK(result.audit.order_errors == 0u);
    const int first = machine.algorithm == "coherent_stencil" ? 6 : machine.algorithm == "coherent_blend" ? 5 : 2;
    const bool asks_first = rule == TerminationRule::exact && first > 2;
    CHECK(result.frame.passes.geometry == result.frame.iterations * first + (asks_first ? 1 : first == 2 ? -1 : 0));
    return result.frame.iterations;
}

const Machine stencil{"geforce8", "coherent_stencil"}, blend{"geforce8", "coherent_blend"},
    ideal{"ideal", "coherent_ideal"};

}  // namespace

// s1 to s10 are submitted at depths 90, 80, 20, 10, 30, 40, 70, 95, 60, 50; s4 at 10 is peeled; the opaque surface is
// at 100.
TEST_CASE("Figure 2: every stencil and depth value of the passes including the inverted count of 4") {
    for (const FirstPasses* first : {&listing::coherent_stencil::passes, &listing::coherent_blend::passes}) {
        Passes passes{one_pixel({90, 80, 20, 10, 30, 40, 70, 95, 60, 50}, 100)};
        CoherentPeel& peel = passes.peel;
        passes.region.clear(peel.reached, {.depth = 10.0f / 128});
        peel.from_the_start = false;
        static_cast<void>(first->find_nearest(peel));
        CHECK(passes.depth(peel.nearest) == 20);                                        // D(s3)
        if (first == &listing::coherent_stencil::passes) CHECK(passes.stencil() == 3);  // s1, s2, s3
        first->find_previous(peel);
        CHECK(passes.depth(peel.previous) == 80);  // D(s2)
        if (first == &listing::coherent_stencil::passes) CHECK(passes.stencil() == 1);
        count_run(peel);
        CHECK(passes.depth(peel.last_in_order) == 70);  // D(s7): s9 fails the depth test and writes nothing (E17)
        CHECK(passes.stencil() == 251);                 // s3, s5, s6, s7 count 4; s9 inverts it
        find_breaker(peel);
        CHECK(passes.depth(peel.breaker) == 50);  // D(s10)
        CHECK(passes.stencil() == 255);
        find_reached(peel);
        CHECK(passes.depth(peel.reached) == 50);
        static_cast<void>(composite_run(peel));
        CHECK(passes.composited() == Depths{20, 30, 40});  // s3, s5, s6
        static_cast<void>(composite_end(peel));
        CHECK(passes.composited() == Depths{50});  // s10
    }
}

TEST_CASE("regression: A on depths 1 1 2: pass 3 leaves 254 and ends the run at 1 so that pass 6 composites both") {
    Passes passes{one_pixel({1, 1, 2})};
    CoherentPeel& peel = passes.peel;
    static_cast<void>(listing::coherent_stencil::passes.find_nearest(peel));
    listing::coherent_stencil::passes.find_previous(peel);
    CHECK(passes.depth(peel.previous) == 128);  // none found
    count_run(peel);
    CHECK(passes.stencil() == 254);
    find_breaker(peel);
    find_reached(peel);
    CHECK(passes.depth(peel.reached) == 1);
    static_cast<void>(composite_run(peel));
    CHECK(passes.composited().empty());
    static_cast<void>(composite_end(peel));
    CHECK(passes.composited() == Depths{1, 1});
}

TEST_CASE("E18 regression: the GPU's passes order 1 2 3 1 2 and section 4.2 taken literally does not") {
    const std::vector<int> arrival{1, 2, 3, 1, 2};
    // As the text says: the run is interrupted by s if s is after sn, not before D(sn), and not behind its predecessor
    // in the whole list.
    const auto literal = [&](int peeled) {
        int nearest = 99, least = 99;
        for (const int d : arrival) nearest = d > peeled ? std::min(nearest, d) : nearest;
        const auto n = static_cast<std::size_t>(std::ranges::find(arrival, nearest) - arrival.begin());
        for (std::size_t i = 0; i < n; ++i) least = arrival[i] > nearest ? std::min(least, arrival[i]) : least;
        for (std::size_t i = n + 1; i < arrival.size(); ++i)
            if (arrival[i] >= nearest && arrival[i] <= arrival[i - 1]) least = std::min(least, arrival[i]);
        return std::pair{nearest, least};
    };
    std::vector<int> composited;
    for (int peeled = 0; peeled < 3;) {
        const auto [from, to] = literal(peeled);
        for (const int d : arrival)
            if (d >= from && d < to) composited.push_back(d);
        for (const int d : arrival)
            if (d == to) composited.push_back(d);
        peeled = to;
    }
    CHECK(composited == std::vector<int>{1, 1, 2, 3, 2});
    for (const Machine& machine : {stencil, blend, ideal})
        CHECK(render(one_pixel(arrival), machine).audit.order_errors == 0u);
}

TEST_CASE("layers in order take one iteration up to 127 and then one for every 128") {
    for (const int n : {1, 2, 17, 126, 127, 128, 129, 255, 256, 257, 300}) {
        const FragmentScene scene = stack(n, true);
        INFO(n << " layers");
        CHECK(iterations(stencil, scene) == (n + 127) / 128);
        CHECK(iterations(blend, scene) == (n + 127) / 128);
        CHECK(iterations(ideal, scene) == 2);
        CHECK(iterations(stencil, scene, TerminationRule::paper) == (n + 127) / 128 + 1);  // and an empty one
    }
}

TEST_CASE("reversed layers take one iteration for every two as in the paper's worst case", "[slow]") {
    for (const int n : {1, 2, 3, 4, 31, 64, 127, 254, 255}) {
        const FragmentScene scene = stack(n, false);
        INFO(n << " layers");
        CHECK(iterations(stencil, scene) == (n + 1) / 2);
        CHECK(iterations(blend, scene) == (n + 1) / 2);
        CHECK(iterations(ideal, scene) == n + 1);
    }
}

TEST_CASE(
    "E19 regression: 300 reversed layers saturate A's stencil and take 174 iterations and B's 151 with an empty one",
    "[slow]") {
    const FragmentScene scene = stack(300, false);
    CHECK(iterations(stencil, scene, TerminationRule::paper) == 174);
    CHECK(iterations(blend, scene, TerminationRule::paper) == 151);
    CHECK(iterations(stencil, scene) == 173);
    CHECK(diagnosed(render(scene, stencil), Fault::stencil_saturated) == 1);
    CHECK(diagnosed(render(scene, blend), Fault::stencil_saturated) == 0);
}

TEST_CASE("E20: a count of 128 in pass 3 is reported and that of a shorter run is not") {
    for (const Machine& machine : {stencil, blend}) {
        CHECK(diagnosed(render(stack(126, true), machine), Fault::count_limit) == 0);
        CHECK(diagnosed(render(stack(128, true), machine), Fault::count_limit) == 1);
        CHECK(diagnosed(render(stack(300, true), machine), Fault::count_limit) == 1);
    }
}

TEST_CASE("E20: fragments that are submitted in short runs never count to 128 in any number") {
    std::vector<int> zigzag;  // 100 to 1, then 200 to 101: two descending sequences, so no run is longer than 2
    for (const int start : {100, 200})
        for (int depth = start; depth > start - 100; --depth) zigzag.push_back(depth);
    for (const Machine& machine : {stencil, blend}) {
        CHECK(diagnosed(render(stack(300, false), machine), Fault::count_limit) == 0);
        CHECK(diagnosed(render(one_pixel(zigzag), machine), Fault::count_limit) == 0);
    }
}

TEST_CASE("E21: equal depths at the bound of a peel are composited in submission order and reported") {
    for (const Machine& machine : {stencil, blend, ideal, Machine{"geforce8", "layer_peel"}}) {
        const RenderResult tied = render(one_pixel({3, 2, 2, 1}), machine);
        INFO(machine.algorithm);
        CHECK(tied.audit.order_errors == 0u);
        CHECK(diagnosed(tied, Fault::equal_at_bound) == 1);
        CHECK(diagnosed(render(one_pixel({3, 2, 1}), machine), Fault::equal_at_bound) == 0);
    }
}

TEST_CASE("random permutations take about 0.45 n iterations") {
    Random random{20241120};
    for (const int n : {16, 32, 64}) {
        double sum = 0;
        for (int round = 0; round < 20; ++round) {
            std::vector<int> depths(static_cast<std::size_t>(n));
            std::iota(depths.begin(), depths.end(), 1);
            for (std::size_t i = depths.size(); i > 1; --i)
                std::swap(depths[i - 1],
                          depths[static_cast<std::size_t>(random_int(random, 0, static_cast<int>(i) - 1))]);
            sum += iterations(blend, one_pixel(depths));
        }
        CHECK(sum / 20 / n == Approx(0.45).margin(0.05));
    }
}
