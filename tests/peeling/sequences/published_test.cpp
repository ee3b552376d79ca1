// Tests the listings of Carr, Mech and Miller as printed: which fragments each loses or repeats, and where it never
// ends, by erratum; and hybrid peeling, whose input is two sets.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/peeling/sequences/disordered_sequences.h"
#include "tests/peeling/sequences/short_sequences.h"
#include "tests/support/partial_order_model.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::DrawList;
using strata::pipeline::Fault;
using strata::pipeline::Formulation;

constexpr Rgba background{0.25f, 0.5f, 0.75f, 1};

// A binary fraction near n / 7 for which 2 z - 1 is exact.
float sevenths(int n) { return std::round(static_cast<float>(n) / 7.0f * 0x1p23f) * 0x1p-23f; }
float eighths(int n) { return static_cast<float>(n) / 8.0f; }

std::vector<GivenFragment> fragments_at(const std::vector<int>& depths, float (*unit)(int), Random& random) {
    std::vector<GivenFragment> fragments;
    for (const int d : depths) {
        fragments.push_back({unit(d), random_color(random)});
        fragments.back().color[3] = 0.5f;
    }
    return fragments;
}

RenderResult run(const DrawList& list, const FragmentScene& scene, const Machine& machine, Formulation formulation,
                 const Running& running = {}) {
    RenderOptions options = options_for(scene);
    options.tile_size = 8;
    options.background = background;
    options.color_format = Format::rgba32f;
    options.formulation = formulation;
    running.apply(options);
    return render(list, {}, machine, options);
}

RenderResult published(const FragmentScene& scene, const Machine& machine, const Running& running = {}) {
    return run(draw_list(scene), scene, machine, Formulation::published, running);
}

// True if pixel p composites these fragments, near to far.
bool shows(const RenderResult& result, std::size_t p, const std::vector<GivenFragment>& near_to_far) {
    std::vector<Rgba> colors;
    for (const GivenFragment& f : near_to_far) colors.push_back(f.color);
    const TargetModel target{Format::rgba32f};
    const Rgba expected = under_model(target, colors, background);
    for (std::size_t c = 0; c < 3; ++c)
        if (result.frame.color.codes[4 * p + c] != target.code(expected[c])) return false;
    return true;
}

// Both sets as one list, the ordered one last; its instance is marked as submitted front to back.
DrawList two_sets(const FragmentScene& unordered, const FragmentScene& ordered) {
    DrawList list = draw_list(unordered), second = draw_list(ordered);
    list.meshes.push_back(second.meshes.front());
    if (!second.meshes.front().indices.empty())
        list.instances.push_back(
            {.mesh = static_cast<std::uint32_t>(list.meshes.size()) - 1, .material = 0, .arrives_sorted = true});
    return list;
}

// The two sets of every pixel in hybrid's order: of equal depths the ordered set first, then submission order.
std::vector<Rgba> hybrid_order(const GivenPixel& unordered, const GivenPixel& ordered) {
    GivenPixel both = unordered;
    both.fragments = ordered.fragments;
    both.fragments.insert(both.fragments.end(), unordered.fragments.begin(), unordered.fragments.end());
    return in_first_order(visible(both));
}

const Machine layer_peel{"geforce8", "layer_peel"}, hybrid{"geforce8", "hybrid"},
    stencil{"geforce8", "coherent_stencil"}, blend{"geforce8", "coherent_blend"}, ideal{"ideal", "coherent_ideal"};

}  // namespace

TEST_CASE("hybrid composites an ordered and an unordered set with and without shared depths in N + 1 iterations",
          "[slow]") {
    const FragmentScene unordered = all_short_sequences(20241130, short_depths);
    FragmentScene ordered{unordered.width, unordered.height};
    Random random{20241131};
    for (std::size_t p = 0; p < ordered.pixels.size(); ++p) {
        auto& fragments = ordered.pixels[p].fragments;
        for (int i = random_int(random, 0, 7); i > 0; --i) {
            const float shared = short_depths[static_cast<std::size_t>(random_int(random, 0, 4))];
            fragments.push_back({i % 2 == 0 ? shared : eighths(random_int(random, 0, 7)), random_color(random)});
        }
        std::stable_sort(fragments.begin(), fragments.end(), [](auto& a, auto& b) { return a.depth < b.depth; });
    }
    const RenderResult result = run(two_sets(unordered, ordered), unordered, hybrid, Formulation::resolved);
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.frame.iterations == 6);
    CHECK(result.frame.passes.geometry == 17);  // 3 per layer, 2 to find that nothing is left
    std::size_t wrong = 0;
    const TargetModel target{Format::rgba32f};
    for (std::size_t p = 0; p < ordered.pixels.size(); ++p) {
        const Rgba expected = under_model(target, hybrid_order(unordered.pixels[p], ordered.pixels[p]), background);
        for (std::size_t c = 0; c < 3; ++c)
            wrong += result.frame.color.codes[4 * p + c] != target.code(expected[c]) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

// Ordered sets of up to `longest` fragments over unordered ones of up to an eighth of that.
void check_two_deep_sets(std::uint64_t seed, int side, int longest) {
    const FragmentScene unordered = disordered(seed, side, side, longest / 8);
    FragmentScene ordered = disordered(seed + 1, side, side, longest);
    for (GivenPixel& pixel : ordered.pixels) {
        pixel.opaque.reset();
        std::stable_sort(pixel.fragments.begin(), pixel.fragments.end(),
                         [](auto& a, auto& b) { return a.depth < b.depth; });
    }
    const RenderResult result = run(two_sets(unordered, ordered), unordered, hybrid, Formulation::resolved);
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.frame.iterations <= longest / 8 + 1);
    const TargetModel target{Format::rgba32f};
    const Differences wrong = differences(result.frame.color, [&](std::size_t p) {
        const auto& surface = unordered.pixels[p].opaque;
        const Rgba expected = under_model(target, hybrid_order(unordered.pixels[p], ordered.pixels[p]),
                                          surface ? surface->color : background);
        return std::array{target.code(expected[0]), target.code(expected[1]), target.code(expected[2]),
                          target.code(1.0f)};
    });
    INFO(wrong.first);
    CHECK(wrong.pixels == 0);
}

TEST_CASE("deep ordered sets over unordered ones are composited in order by hybrid") {
    check_two_deep_sets(20241140, 16, 120);
}

TEST_CASE("10 times 1024 pairs of sets with ordered ones of up to 400 fragments are composited in order by hybrid",
          "[exhaustive]") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) check_two_deep_sets(20241160 + 2 * seed, 32, 400);
}

TEST_CASE("an ordered set that is not submitted front to back is composited as submitted and hybrid reports it") {
    FragmentScene unordered{8, 8}, ordered{8, 8};
    Random random{3};
    ordered.pixels[9].fragments = fragments_at({4, 2}, eighths, random);
    const RenderResult result = run(two_sets(unordered, ordered), unordered, hybrid, Formulation::resolved);
    CHECK(shows(result, 9, ordered.pixels[9].fragments));
    CHECK(diagnosed(result, Fault::out_of_order) == 1);
}

TEST_CASE("E16 regression: B's printed factors multiply depths 3 2 1 of 7 below 1 and the pixel makes no progress") {
    FragmentScene scene{8, 8};
    Random random{4};
    scene.pixels[0].fragments = fragments_at({3, 2, 1}, sevenths, random);
    const RenderResult result = published(scene, blend);
    CHECK(shows(result, 0, {}));
    CHECK(result.audit.order_errors == 3u);
    CHECK(result.frame.iterations == 1);
    CHECK(diagnosed(result, Fault::as_published) == 1);
}

TEST_CASE("E16: the printed factors lose layers of 2540 of the 19531 short sequences and the others are in order",
          "[slow]") {
    const FragmentScene scene =
        all_short_sequences(20241132, {sevenths(1), sevenths(2), sevenths(3), sevenths(4), sevenths(5)});
    const RenderResult result = published(scene, blend);
    CHECK(result.audit.misordered.pixels == 2540);
    CHECK(diagnosed(result, Fault::as_published) == 2540);
    CHECK(published(scene, stencil).audit.order_errors == 0u);
}

TEST_CASE("E22 regression: A as printed composites fragments at the opaque surface in every iteration and is stopped") {
    FragmentScene scene{8, 8};
    Random random{5};
    scene.pixels[3].fragments = fragments_at({3, 6}, eighths, random);
    scene.pixels[3].opaque = GivenFragment{eighths(6), {0, 0, 0, 1}};
    for (const Machine& machine : {stencil, blend}) {
        const RenderResult result = published(scene, machine);
        CHECK(diagnosed(result, Fault::endless) == 1);
        CHECK(diagnosed(result, Fault::as_published) == 1);
        CHECK(result.audit.misordered == strata::peeling::PixelCount{1, 3, 0});
        const RenderResult resolved = run(draw_list(scene), scene, machine, Formulation::resolved);
        CHECK(resolved.audit.order_errors == 0u);
        CHECK_FALSE(has_diagnostic(resolved, Fault::endless));
    }
}

TEST_CASE(
    "E23: fragments exactly on the near plane are lost as printed and only Algorithm 2 composites them by equality") {
    FragmentScene scene{8, 8};
    Random random{6};
    scene.pixels[0].fragments = fragments_at({2, 0}, eighths, random);
    CHECK(published(scene, ideal).audit.order_errors == 0u);
    for (const Machine& machine : {layer_peel, hybrid, stencil, blend}) {
        INFO(machine.algorithm);
        const RenderResult result = published(scene, machine);
        CHECK(shows(result, 0, {scene.pixels[0].fragments[0]}));
        CHECK(diagnosed(result, Fault::as_published) == 1);
        CHECK(run(draw_list(scene), scene, machine, Formulation::resolved).audit.order_errors == 0u);
    }
}

TEST_CASE("E24 regression: Algorithm 1 as printed with U = 3 3 1 and S = 3 4 5 loses the ordered fragment at 3") {
    FragmentScene unordered{8, 8}, ordered{8, 8};
    Random random{7};
    auto& u = unordered.pixels[0].fragments = fragments_at({3, 3, 1}, eighths, random);
    auto& s = ordered.pixels[0].fragments = fragments_at({3, 4, 5}, eighths, random);
    const RenderResult result = run(two_sets(unordered, ordered), unordered, hybrid, Formulation::published);
    CHECK(shows(result, 0, {u[2], u[0], u[1], s[1], s[2]}));
    CHECK(diagnosed(result, Fault::as_published) == 1);
}

TEST_CASE(
    "E24 regression: Algorithm 1 as printed repeats fragments at the opaque surface while another pixel is peeled") {
    FragmentScene scene{16, 8};  // the other pixel is in another tile
    Random random{8};
    auto& first = scene.pixels[0].fragments = fragments_at({6, 0, 6}, eighths, random);
    auto& second = scene.pixels[9].fragments = fragments_at({1, 2}, eighths, random);
    scene.pixels[0].opaque = scene.pixels[9].opaque = GivenFragment{eighths(6), background};
    for (const Running& running : all_ways_of_running) {
        const RenderResult result =
            run(two_sets(scene, FragmentScene{16, 8}), scene, hybrid, Formulation::published, running);
        CHECK(shows(result, 0, {first[0], first[2], first[0], first[2]}));
        CHECK(shows(result, 9, second));
        CHECK(diagnosed(result, Fault::as_published) == 1);
    }
}

TEST_CASE("E25 regression: Algorithm 2 as printed composites a finished pixel's last layer again in every iteration") {
    FragmentScene scene{16, 8};
    Random random{9};
    auto& first = scene.pixels[0].fragments = fragments_at({1}, eighths, random);
    auto& second = scene.pixels[9].fragments = fragments_at({2, 4, 2, 1}, eighths, random);
    scene.pixels[0].opaque = scene.pixels[9].opaque = GivenFragment{eighths(6), background};
    for (const Running& running : all_ways_of_running) {
        const RenderResult result = published(scene, ideal, running);
        CHECK(shows(result, 0, {first[0], first[0], first[0]}));
        CHECK(shows(result, 9, {second[3], second[0], second[2], second[1]}));
        CHECK(diagnosed(result, Fault::as_published) == 1);
    }
}

TEST_CASE("a listing as printed differs from the exact order only at the pixels that its diagnostics count", "[slow]") {
    const FragmentScene scene = all_short_sequences(20241133, short_depths);
    for (const Machine& machine : {layer_peel, stencil, blend, ideal}) {
        const RenderResult result = published(scene, machine);
        const RenderResult resolved = run(draw_list(scene), scene, machine, Formulation::resolved);
        std::uint64_t different = 0;
        for (std::size_t p = 0; p < scene.pixels.size(); ++p)
            different += std::equal(&result.frame.color.codes[4 * p], &result.frame.color.codes[4 * p] + 3,
                                    &resolved.frame.color.codes[4 * p])
                             ? 0
                             : 1;
        INFO(machine.algorithm);
        CHECK(different > 1000);
        CHECK(different <= diagnosed(result, Fault::as_published));
        CHECK(resolved.audit.order_errors == 0u);
    }
}

TEST_CASE("dual regression: depths .1 .1 .3 .3 merge into one layer in front and one behind") {
    FragmentScene scene{8, 8};
    Random random{10};
    scene.pixels[0].fragments = fragments_at({1, 1, 3, 3}, eighths, random);
    const RenderResult result = render(scene, {"geforce8", "dual"});
    CHECK(result.audit.lost_by_ties == 2);
    CHECK(result.audit.layers_max == 2);
    CHECK(result.frame.passes.geometry == 2);
    CHECK(diagnosed(result, Fault::merged_ties) == 1);
}
