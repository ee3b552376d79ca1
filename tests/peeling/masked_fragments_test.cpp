// Tests that fragments which the alpha test removes (glTF's MASK) change nothing: pictures, diagnostics and audits must
// be those of a scene in which their triangles have no area (pipeline/reference/fragment-stages.md 2).
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::AlgorithmOptions;
using strata::peeling::Overflow;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::Tail;
using strata::pipeline::AlphaMode;
using strata::pipeline::DrawList;

constexpr float cutoff = 0.5f;

struct MaskedLists {
    DrawList masked;   // with fragments that the test removes, fragments that it keeps, and surfaces without a test
    DrawList without;  // no test; triangles of removed fragments have no area, the others are as in `masked`
    std::size_t removed = 0;
};

// The order of submission is that of draw_list: round k has each pixel's fragment k, first those without a test, then
// the others. Both lists have the same triangle numbers.
MaskedLists masked_lists(const FragmentScene& scene, unsigned seed) {
    std::mt19937 random{seed};
    MaskedLists lists;
    lists.masked.materials = {
        {.name = "blended", .alpha_mode = AlphaMode::blend, .double_sided = true, .unlit = true},
        {.name = "tested", .alpha_mode = AlphaMode::mask, .alpha_cutoff = cutoff, .double_sided = true, .unlit = true}};
    lists.without.materials = lists.masked.materials;
    lists.without.materials[1].alpha_mode = AlphaMode::blend;
    for (std::size_t round = 0; round < 6; ++round)
        for (const bool is_tested : {false, true}) {
            strata::pipeline::Mesh masked, without;
            for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
                const auto& fragments = scene.pixels[p].fragments;
                if (round >= fragments.size() || (random() % 2 == 0) != is_tested) continue;
                add_fragment(masked, scene, p, fragments[round]);
                add_fragment(without, scene, p, fragments[round]);
                if (!is_tested || fragments[round].color[3] >= cutoff) continue;
                ++lists.removed;
                const std::size_t last = without.positions.size() - 1;
                without.positions[last] = without.positions[last - 1] = without.positions[last - 2];
            }
            const auto number = static_cast<std::uint32_t>(lists.masked.meshes.size());
            lists.masked.meshes.push_back(std::move(masked));
            lists.without.meshes.push_back(std::move(without));
            for (DrawList* list : {&lists.masked, &lists.without})
                list->instances.push_back({.mesh = number, .material = is_tested ? 1u : 0u});
        }
    return lists;
}

// The algorithm's default options, and options under which its lists, entries or tails overflow.
std::vector<AlgorithmOptions> choices_of(const std::string& algorithm) {
    std::vector<AlgorithmOptions> choices(1);
    const auto add = [&](auto&& change) { change(choices.emplace_back()); };
    if (algorithm == "linked_list")
        for (const Overflow rule : {Overflow::drop_new, Overflow::drop_far, Overflow::blend}) {
            add([&](AlgorithmOptions& o) { o.pixel_nodes = 2, o.overflow = rule; });
            add([&](AlgorithmOptions& o) { o.frame_nodes = 200, o.overflow = rule; });
        }
    if (algorithm == "atomic_loop" || algorithm == "hybrid_transparency")
        for (const Tail tail : {Tail::none, Tail::blend, Tail::average, Tail::weighted})
            add([&](AlgorithmOptions& o) { o.nodes = 2, o.tail = tail; });
    if (algorithm == "multi_layer" || algorithm == "adaptive") add([](AlgorithmOptions& o) { o.nodes = 2; });
    return choices;
}

}  // namespace

TEST_CASE("fragments that the alpha test removes leave no trace in any algorithm and in every execution") {
    const FragmentScene scene = eighths_scene(71, 6);
    const MaskedLists lists = masked_lists(scene, 72);
    REQUIRE(lists.removed > 100);
    for (const auto& algorithm : strata::peeling::algorithms()) {
        if (algorithm.order == strata::peeling::ListOrder::objects) continue;  // sorts objects by all their triangles
        for (const AlgorithmOptions& choice : choices_of(algorithm.name))
            for (const Running& running : all_ways_of_running) {
                RenderOptions options = eighths_options(scene);
                options.alpha = 1.0f;  // masked materials become transparent, too, after their test
                options.algorithm = choice;
                running.apply(options);
                const Machine machine{"ideal", algorithm.name};
                const RenderResult found = render(lists.masked, {}, machine, options),
                                   wanted = render(lists.without, {}, machine, options);
                INFO(algorithm.name << ", nodes " << choice.nodes << ", a pixel " << choice.pixel_nodes << ", a frame "
                                    << choice.frame_nodes);
                REQUIRE(found.outcome == strata::peeling::Outcome::done);
                CHECK(found.frame.color == wanted.frame.color);
                CHECK(found.frame.depth == wanted.frame.depth);
                CHECK(found.frame.diagnostics == wanted.frame.diagnostics);
                CHECK(found.frame.passes.geometry == wanted.frame.passes.geometry);
                CHECK(found.audit == wanted.audit);
            }
    }
}
