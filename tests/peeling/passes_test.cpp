// Tests how many passes each algorithm takes, and its result if they end too early.
#include <catch2/catch.hpp>

#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Fault;
using strata::pipeline::TerminationRule;

// Pixel i of the first row has min(i, layers) fragments, nearest last, of alpha 1/2 and random colours.
FragmentScene stairs(int layers, std::uint64_t seed = 5) {
    FragmentScene scene{16, 8};
    Random random{seed};
    for (std::size_t p = 0; p < 16; ++p)
        for (int i = std::min(static_cast<int>(p), layers); i-- > 0;) {
            Rgba color = random_color(random);
            color[3] = 0.5f;
            scene.pixels[p].fragments.push_back({static_cast<float>(i + 1) / 16.0f, color});
        }
    return scene;
}

RenderResult render_with(const FragmentScene& scene, const Machine& machine, TerminationRule rule, double ratio = 0,
                         int fixed = 0) {
    RenderOptions options = options_for(scene);
    options.termination = {.rule = rule, .ratio = ratio, .passes = fixed};
    return render(scene, machine, options);
}

// The groups of the first `count` depths.
DepthGroups nearest(const DepthGroups& groups, int count) {
    DepthGroups kept;
    for (const auto& group : groups)
        if (static_cast<int>(kept.size()) < count) kept.insert(group);
    return kept;
}

// Number of pixels whose 8-bit codes differ from `expected(groups)`.
template <class Model>
Differences against(const FragmentScene& scene, const RenderResult& result, Model&& expected) {
    const TargetModel target{Format::rgba8};
    return differences(result.frame.color, [&](std::size_t p) {
        const Rgba color = expected(target, groups_of(visible(scene.pixels[p])));
        return std::array{target.code(color[0]), target.code(color[1]), target.code(color[2]), 255u};
    });
}

constexpr Rgba black{0, 0, 0, 1};

// Number of fragments that pass `depth > peeled` and LESS in one pass over a pixel; moves `peeled` to the nearest of
// them.
std::uint64_t peel_once(const std::vector<GivenFragment>& fragments, float& peeled) {
    std::uint64_t passed = 0;
    float nearest_yet = 1.0f;
    for (const GivenFragment& f : fragments)
        if (f.depth > peeled && f.depth < nearest_yet) {
            ++passed;
            nearest_yet = f.depth;
        }
    peeled = nearest_yet;
    return passed;
}

}  // namespace

TEST_CASE("geometry passes follow the formula of every algorithm for 0 to 9 layers", "[slow]") {
    for (int n = 0; n <= 9; ++n) {
        for (const Expectation& expected : expectations()) {
            if (expected.passes == nullptr) continue;
            const Machine machine{expected.profile(), expected.algorithm};
            const int passes = expected.passes(n);
            for (const TerminationRule rule : {TerminationRule::exact, TerminationRule::any}) {
                const RenderResult result = render_with(stairs(n), machine, rule);
                INFO(machine.algorithm << ", " << n << " layers");
                CHECK(result.audit.layers_max == n);
                CHECK(result.frame.passes.geometry == passes);
                CHECK(strata::peeling::find_algorithm(machine.algorithm)->geometry_passes(n) == passes);
            }
        }
    }
}

TEST_CASE(
    "the paper's exit of dual peeling takes one more pass for even numbers of layers and gives the same picture") {
    for (int n = 0; n <= 9; ++n) {
        const FragmentScene scene = stairs(n);
        const RenderResult paper = render_with(scene, {"geforce8", "dual"}, TerminationRule::paper);
        CHECK(paper.frame.passes.geometry == n / 2 + 2);
        CHECK(paper.frame.color == render(scene, {"geforce8", "dual"}).frame.color);
        CHECK(paper.audit.order_errors == 0u);
        CHECK_FALSE(has_diagnostic(paper, Fault::early_end));
    }
}

TEST_CASE("E14: a pass whose back layers all have alpha 0 ends the paper's loop and loses the middle layer") {
    FragmentScene scene{8, 8};
    const std::vector<GivenFragment> fragments{
        {0.125f, {0.9f, 0.9f, 0.9f, 0.5f}}, {0.25f, {0.4f, 0.4f, 0.4f, 0.5f}}, {0.5f, {1, 1, 1, 0}}};
    scene.pixels[27].fragments = fragments;  // x = 3, y = 3
    RenderOptions options = options_for(scene);
    options.background = {0.25f, 0.25f, 0.25f, 1};
    const auto red = [](const RenderResult& r) { return std::bit_cast<float>(r.frame.color.codes[4 * 27]); };
    const RenderResult exact = render(scene, {"ideal", "dual"}, options);
    options.termination.rule = TerminationRule::paper;
    const RenderResult paper = render(scene, {"ideal", "dual"}, options);
    CHECK(red(exact) == Approx(0.6125));  // .5 x .9 + .25 x .4 + .25 x .25
    CHECK(red(paper) == Approx(0.575));   // .5 x .9 + .5 x .25
    CHECK(exact.frame.passes.geometry == 3);
    CHECK(paper.frame.passes.geometry == 2);
    CHECK(exact.audit.order_errors == 0u);
    CHECK(paper.audit.order_errors == 2u);  // expected 1 2 3, found 1 3
    CHECK(diagnosed(paper, Fault::early_end) == 1);
    CHECK(paper.audit.misordered == strata::peeling::PixelCount{1, 3, 3});
    CHECK_FALSE(has_diagnostic(exact, Fault::early_end));
}

TEST_CASE("E14 does not occur in a tile whose back layers have alpha 0 while those of another tile do not") {
    FragmentScene scene{16, 16};  // four tiles of 8 x 8
    const Rgba white{1, 1, 1, 0.5f};
    scene.pixels[0].fragments = {{0.125f, white}, {0.25f, {1, 0, 0, 0.5f}}, {0.5f, {1, 1, 1, 0}}};
    scene.pixels[255].fragments = {{0.125f, white}, {0.25f, white}, {0.375f, white}, {0.5f, white}};
    RenderOptions options = options_for(scene);
    options.tile_size = 8;
    const RenderResult exact = render(scene, {"geforce8", "dual"}, options);
    options.termination.rule = TerminationRule::paper;
    for (const Running& running : all_ways_of_running) {
        running.apply(options);
        const RenderResult paper = render(scene, {"geforce8", "dual"}, options);
        CHECK(paper.frame.color == exact.frame.color);
        CHECK(paper.frame.passes.geometry == 4);
        CHECK(paper.audit.order_errors == 0u);
    }
}

TEST_CASE("front_to_back stopped by max_passes shows exactly the nearest layers and reports the truncation") {
    const FragmentScene scene = stairs(7);
    for (int k = 1; k <= 9; ++k) {
        RenderOptions options = options_for(scene);
        options.max_passes = k;
        for (const Machine& machine : {Machine{"geforce8", "front_to_back"}, {"geforce8", "depth_units"}}) {
            const RenderResult result = render(scene, machine, options);
            const Differences wrong = against(scene, result, [&](const TargetModel& target, const DepthGroups& groups) {
                return machine.algorithm == "depth_units" ? depth_units_model(target, nearest(groups, k), black)
                                                          : front_to_back_model(target, nearest(groups, k), black);
            });
            INFO(machine.algorithm << ", " << k << " passes, " << wrong.first);
            CHECK(wrong.pixels == 0);
            CHECK(result.frame.passes.geometry == std::min(k, 8));
            // Pixels of more than k layers: min(i, 7) > k for i = k + 1 to 15.
            CHECK(diagnosed(result, Fault::truncated) == static_cast<std::uint64_t>(k < 7 ? 15 - k : 0));
        }
    }
}

TEST_CASE("no algorithm takes more geometry passes than max_passes for any number of passes per iteration", "[slow]") {
    const FragmentScene scene = stairs(14);
    for (const strata::peeling::Algorithm& algorithm : strata::peeling::algorithms())
        for (const char* const profile : {"geforce3", "geforce8", "ideal"}) {
            RenderOptions options = options_for(scene);
            const RenderResult whole = render(scene, {profile, std::string{algorithm.name}}, options);
            if (whole.outcome != strata::peeling::Outcome::done) continue;
            const int all = whole.frame.passes.geometry;
            int before = 0;
            for (int most = 1; most <= 19; ++most) {
                options.max_passes = most;
                const int found = render(scene, {profile, std::string{algorithm.name}}, options).frame.passes.geometry;
                INFO(algorithm.name << " on " << profile << ", at most " << most << " of " << all);
                // An algorithm without iterations is complete or rejected; one more allowed pass never reduces the
                // number of passes.
                CHECK((found <= most || (found == all && all <= 2)));
                CHECK(found >= before);
                CHECK(found <= all);
                before = found;
            }
        }
}

TEST_CASE("fixed:N runs N geometry passes without a query even if layers are left or none were left long before") {
    const FragmentScene scene = stairs(5);
    for (int passes = 1; passes <= 8; ++passes) {
        const RenderResult peel = render_with(scene, {"geforce8", "front_to_back"}, TerminationRule::fixed, 0, passes);
        const RenderResult dual = render_with(scene, {"geforce8", "dual"}, TerminationRule::fixed, 0, passes);
        CHECK(peel.frame.passes.geometry == passes);
        CHECK(dual.frame.passes.geometry == passes);
        CHECK(peel.frame.iterations == passes);
        CHECK(dual.frame.iterations == passes - 1);  // its first pass initialises
        CHECK(against(scene, peel, [&](const TargetModel& target, const DepthGroups& groups) {
                  return front_to_back_model(target, nearest(groups, passes), black);
              }).pixels == 0);
        CHECK(against(scene, dual, [&](const TargetModel& target, const DepthGroups& groups) {
                  return dual_model(target, groups, black, passes - 1);
              }).pixels == 0);
    }
}

TEST_CASE("ratio:R stops at the first count below R times the frame's pixels") {
    FragmentScene scene{16, 16};
    Random random{11};
    for (GivenPixel& pixel : scene.pixels)
        for (int i = random_int(random, 0, 9); i > 0; --i)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 1, 15)) / 16.0f, random_color(random)});
    for (const double ratio : {0.0, 0.05, 0.25, 0.5, 1.0, 1.25, 4.0}) {
        std::vector<float> peeled(scene.pixels.size(), -1.0f);
        int passes = 0;
        for (bool more = true; more; ++passes) {
            std::uint64_t count = 0;
            for (std::size_t p = 0; p < peeled.size(); ++p) count += peel_once(scene.pixels[p].fragments, peeled[p]);
            more = count > 0 && static_cast<double>(count) >= ratio * 256;
        }
        const RenderResult result = render_with(scene, {"geforce8", "front_to_back"}, TerminationRule::ratio, ratio);
        INFO("ratio " << ratio);
        CHECK(result.frame.passes.geometry == passes);
        CHECK(against(scene, result, [&](const TargetModel& target, const DepthGroups& groups) {
                  return front_to_back_model(target, nearest(groups, passes), black);
              }).pixels == 0);
    }
}

TEST_CASE("counters of front_to_back are those of one fragment after another") {
    FragmentScene scene{8, 8};
    Random random{12};
    std::size_t fragments = 0;
    for (GivenPixel& pixel : scene.pixels)
        for (int i = random_int(random, 0, 9); i > 0; --i, ++fragments)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 0, 16)) / 16.0f, random_color(random)});
    RenderOptions options = options_for(scene);
    options.counters = true;
    const RenderResult result = render(draw_list(scene), {}, {"geforce8", "front_to_back"}, options);
    const int passes = result.audit.layers_max + 1;
    std::vector<float> peeled(scene.pixels.size(), -1.0f);
    std::uint64_t discarded = 0, blended = 0;
    for (int pass = 0; pass < passes; ++pass)
        for (std::size_t p = 0; p < peeled.size(); ++p) {
            for (const GivenFragment& f : scene.pixels[p].fragments) discarded += f.depth <= peeled[p] ? 1 : 0;
            blended += peel_once(scene.pixels[p].fragments, peeled[p]);
        }
    const strata::pipeline::Counters& found = *result.frame.counters;
    CHECK(found.fragments_rasterized == fragments * static_cast<std::uint64_t>(passes));
    CHECK(found.discarded == discarded);
    CHECK(found.blended == blended);
    CHECK(found.depth_killed == found.fragments_rasterized - discarded - blended);
    CHECK(found.alpha_killed + found.stencil_killed == 0);
}

TEST_CASE("dual peeling of depths .1 .1 .3 .3 mixes each tie by MAX in one pass and loses two fragments") {
    FragmentScene scene{8, 8};
    const float near = 0x1.99999ap-4f - 0x1p-28f, far = 0.3125f;  // 2 near - 1 is exact
    scene.pixels[9].fragments = {{near, {1, 0, 0.25f, 0.5f}},
                                 {near, {0, 1, 0.5f, 0.25f}},
                                 {far, {0.5f, 0, 1, 0.75f}},
                                 {far, {0.25f, 1, 0, 0.5f}}};
    const RenderResult result = render(scene, {"geforce8", "dual"});
    CHECK(result.frame.passes.geometry == 2);
    CHECK(result.audit.layers_max == 2);
    CHECK(result.audit.fragments_max == 4);
    CHECK(result.audit.lost_by_ties == 2);
    CHECK(result.audit.order_errors == 0u);
    CHECK(diagnosed(result, Fault::merged_ties) == 1);
    // front: max(1 x .5, 0), max(0, 1 x .25), max(.25 x .5, .5 x .25) and max(.5, .25); back: max of each channel.
    const Rgba front{128 / 255.0f, 64 / 255.0f, 32 / 255.0f, 128 / 255.0f};
    const TargetModel target{Format::rgba8};
    const Rgba back{target.over(0.5f, 0.75f, 0), target.over(1, 0.75f, 0), target.over(1, 0.75f, 0), 0};
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(result.frame.color.codes[4 * 9 + c] == target.code(target.stored(front[c] + (1 - front[3]) * back[c])));
}

TEST_CASE("a fragment at depth 0 is a layer and one at depth 1 is invisible in every algorithm") {
    FragmentScene scene{8, 8};
    const Rgba red{1, 0, 0, 1}, green{0, 1, 0, 1};
    scene.pixels[0].fragments = {{0.0f, red}};
    scene.pixels[1].fragments = {{1.0f, green}};
    scene.pixels[2].fragments = {{1.0f, green}, {0.0f, red}};
    scene.pixels[3].fragments = {{-0.0f, red}, {0.5f, green}};
    for (const auto& algorithm : strata::peeling::algorithms()) {
        const RenderResult result = render(scene, {"ideal", algorithm.name});
        const auto color = [&](std::size_t p) {
            return std::array{std::bit_cast<float>(result.frame.color.codes[4 * p]),
                              std::bit_cast<float>(result.frame.color.codes[4 * p + 1])};
        };
        INFO(algorithm.name);
        CHECK(color(0) == std::array{1.0f, 0.0f});
        CHECK(color(1) == std::array{0.0f, 0.0f});
        CHECK(color(2) == std::array{1.0f, 0.0f});
        if (algorithm.exact) CHECK(color(3) == std::array{1.0f, 0.0f});
        CHECK(result.audit.layers_max == 2);
    }
}

TEST_CASE("depths that one D24 code holds are one layer of a program that compares with the stored depth") {
    FragmentScene scene{4, 4};
    const float depth = 0.25f, same_code = 0.25f + 0x1p-25f;  // 2^22 - 1/4 and 2^22 + 1/4
    scene.pixels[5].fragments = {{same_code, {1, 0, 0, 0.5f}}, {depth, {0, 1, 0, 0.5f}}};
    RenderOptions options = options_for(scene);
    const RenderResult wide = render(scene, {"geforce8", "front_to_back"}, options);
    options.depth = strata::pipeline::DepthFormat::d24;
    const RenderResult fixed = render(scene, {"geforce8", "front_to_back"}, options);
    const RenderResult dual = render(scene, {"geforce8", "dual"}, options);
    CHECK(wide.audit.layers_max == 2);
    CHECK(fixed.audit.layers_max == 1);
    CHECK(fixed.audit.lost_by_ties == 1);
    CHECK(fixed.audit.order_errors == 0u);
    CHECK(has_diagnostic(fixed, Fault::depth_quantized));
    CHECK_FALSE(has_diagnostic(wide, Fault::depth_quantized));
    CHECK(dual.audit.layers_max == 2);  // it orders by the program's own z, which no buffer quantizes
}

TEST_CASE("depth_units reports the emulator's extension") {
    CHECK(has_diagnostic(render(stairs(2), {"geforce3", "depth_units"}), Fault::emulator_extension));
    CHECK_FALSE(has_diagnostic(render(stairs(2), {"geforce8", "front_to_back"}), Fault::emulator_extension));
}

TEST_CASE("the audit is null where an algorithm has no order and the approximations are exact for equal fragments") {
    FragmentScene scene{4, 4};
    for (int i = 1; i <= 4; ++i)
        scene.pixels[3].fragments.push_back({static_cast<float>(i) / 8.0f, {0.75f, 0.5f, 0.25f, 0.5f}});
    const RenderResult average = render(scene, {"ideal", "weighted_average"});
    CHECK_FALSE(average.audit.order_errors);
    CHECK(average.audit.max_difference < 1e-4);
    CHECK_FALSE(render(scene, {"ideal", "weighted_sum"}).audit.order_errors);
    CHECK_FALSE(render(scene, {"ideal", "unsorted"}).audit.order_errors);
    CHECK(render(scene, {"ideal", "weighted_sum"}).audit.max_difference > 10);  // sum of alphas 2: darkens the picture
}

TEST_CASE("a limit that a peel does not reach runs no tile twice and any limit ends tiles where it ends the frame") {
    const FragmentScene scene = stairs(8);  // tiles of 7 and of 8 layers
    for (const char* algorithm : {"layer_peel", "hybrid", "coherent_ideal"})
        for (int limit = 1; limit <= 28; ++limit) {
            RenderOptions options = options_for(scene);
            options.tile_size = 8;
            options.max_passes = limit;
            const RenderResult tiles = render(scene, {"ideal", algorithm}, options);
            options.execution = strata::pipeline::Execution::literal;
            const RenderResult whole = render(scene, {"ideal", algorithm}, options);
            INFO(algorithm << ", " << limit << " passes at most");
            CHECK(tiles.frame.color == whole.frame.color);
            CHECK(tiles.frame.passes.geometry == whole.frame.passes.geometry);
            CHECK(tiles.frame.passes.full_screen == whole.frame.passes.full_screen);
            CHECK(tiles.audit.order_errors == whole.audit.order_errors);
            if (whole.frame.passes.geometry + 3 <= limit) CHECK(tiles.frame.work.reruns == 0);
        }
}
