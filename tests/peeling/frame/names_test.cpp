// Tests the registry's entry of each algorithm against tests/peeling/expectations.h, and against its passes on devices
// that lack one feature.
#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "pipeline/region/region.h"
#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Algorithm;
using strata::peeling::Outcome;

FragmentScene two_layers() {
    FragmentScene scene{2, 2};
    for (GivenPixel& pixel : scene.pixels) pixel.fragments = {{0.25f, {1, 0, 0, 0.5f}}, {0.5f, {0, 1, 0, 0.5f}}};
    return scene;
}

// True if a device that lacks only this feature rejects a pass of the algorithm; the features in the entry are cleared.
bool passes_need(Algorithm algorithm, bool DeviceProfile::*has) {
    algorithm.features.clear();
    DeviceProfile profile = *find_profile("ideal");
    profile.*has = false;
    const DrawList list = draw_list(two_layers());
    strata::peeling::RenderOptions options = options_for(two_layers());
    options.execution = Execution::literal;
    options.color_format = Format::rgba8;
    strata::peeling::Renderer renderer{list, {}, profile, options};
    return renderer.render(algorithm).outcome == Outcome::refused;
}

}  // namespace

TEST_CASE(
    "each algorithm has a row of expectations and renders to as many targets as its entry states and names them") {
    CHECK(expectations().size() == strata::peeling::algorithms().size());
    for (const Algorithm& algorithm : strata::peeling::algorithms()) {
        INFO(algorithm.name);
        REQUIRE(std::ranges::count(expectations(), algorithm.name, &Expectation::algorithm) == 1);
        const Expectation& expected = expected_of(algorithm.name);
        std::set<std::string> names;
        int render_targets = 1, samples = 1;
        const Observer observer{.named = [&](Target, std::string_view name) { names.emplace(name); },
                                .step =
                                    [&](const Region& region, const StepEvent& step) {
                                        if (step.state == nullptr) return;
                                        int targets = 0;
                                        for (const Target target : step.state->color)
                                            if (target.exists()) {
                                                ++targets;
                                                samples = std::max(samples, region.storage(target).samples());
                                            }
                                        render_targets = std::max(render_targets, targets);
                                    }};
        const auto result = render(draw_list(two_layers()), {}, {"ideal", algorithm.name}, options_for(two_layers()),
                                   {.observer = &observer});
        CHECK(result.outcome == Outcome::done);
        CHECK(names == expected.targets);
        CHECK(render_targets == expected.render_targets);
        CHECK(samples == expected.samples);
        CHECK(algorithm.render_targets == expected.render_targets);
        CHECK(algorithm.samples == expected.samples);
    }
}

TEST_CASE("an entry lists each feature without which a pass of its algorithm is rejected") {
    constexpr std::pair<Feature, bool DeviceProfile::*> checked_by_passes[]{
        {Feature::float_targets, &DeviceProfile::has_float_targets},
        {Feature::separate_alpha_blend, &DeviceProfile::has_separate_alpha_blend},
        {Feature::independent_blend, &DeviceProfile::has_independent_blend},
        {Feature::sequential_depth_units, &DeviceProfile::has_sequential_depth_units},
        {Feature::ordered_rmw, &DeviceProfile::has_ordered_rmw}};
    for (const Algorithm& algorithm : strata::peeling::algorithms())
        for (const auto& [feature, has] : checked_by_passes) {
            const bool is_listed = std::ranges::find(algorithm.features, feature) != algorithm.features.end();
            INFO(algorithm.name << ", feature " << static_cast<int>(feature));
            CHECK(is_listed == passes_need(algorithm, has));
        }
}
