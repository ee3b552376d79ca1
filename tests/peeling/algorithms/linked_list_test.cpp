// Tests linked_list and its limits of nodes against lists in real numbers. peeling/reference/algorithms.md 20.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::Overflow;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Fault;

const ExpectedRow expected_linked_list{
    {.algorithm = "linked_list", .devices = Devices::buffers, .passes = [](int) { return 1; }, .targets = {"result"}}};

struct Limits {
    std::size_t pixel_nodes = 0, frame_nodes = 0;  // 0: none
    Overflow rule{};
};

struct GivenLists {
    std::vector<std::vector<GivenFragment>> listed, left_over;  // by pixel, in submission order
    std::size_t overflowing = 0;
};

// Fragments are submitted in rounds, one per pixel and round, as draw_list does. A fragment takes a node if the pixel
// and the frame have one left.
GivenLists lists_model(const FragmentScene& scene, const Limits& limits) {
    GivenLists lists{std::vector<std::vector<GivenFragment>>(scene.pixels.size()),
                     std::vector<std::vector<GivenFragment>>(scene.pixels.size()), 0};
    std::size_t taken = 0;
    for (std::size_t round = 0; round < 6; ++round)
        for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
            const float limit = scene.pixels[p].opaque ? scene.pixels[p].opaque->depth : 1.0f;
            if (round >= scene.pixels[p].fragments.size()) continue;
            const GivenFragment& f = scene.pixels[p].fragments[round];
            if (f.depth >= limit) continue;
            auto& listed = lists.listed[p];
            const bool has_node = (limits.pixel_nodes == 0 || listed.size() < limits.pixel_nodes) &&
                                  (limits.frame_nodes == 0 || taken < limits.frame_nodes);
            if (has_node) {
                listed.push_back(f);
                ++taken;
                continue;
            }
            lists.left_over[p].push_back(f);
            if (limits.rule != Overflow::drop_far || listed.empty()) continue;
            // The farthest fragment is removed; of equal ones, the last submitted.
            auto farthest = std::max_element(listed.begin(), listed.end(),
                                             [](const auto& a, const auto& b) { return a.depth <= b.depth; });
            if (f.depth < farthest->depth) {
                listed.erase(farthest);
                listed.push_back(f);
            }
        }
    for (const auto& left : lists.left_over) lists.overflowing += left.empty() ? 0 : 1;
    return lists;
}

Color3 list_color(const FragmentScene& scene, const GivenLists& lists, std::size_t p, Overflow rule) {
    auto sorted = lists.listed[p];
    std::ranges::stable_sort(sorted, {}, &GivenFragment::depth);
    RealLayer all;
    for (const GivenFragment& f : sorted) all = joined(all, layer_of(f));
    Color3 color = behind(scene.pixels[p]);
    if (rule == Overflow::blend)
        for (const GivenFragment& f : lists.left_over[p]) color = over(layer_of(f), color);
    return over(all, color);
}

}  // namespace

TEST_CASE(
    "linked_list composites the fragments that have nodes with the exact result for each limit and rule in every "
    "execution") {
    const FragmentScene scene = eighths_scene(21, 6);
    std::size_t overflowing = 0;
    for (const Overflow rule : {Overflow::drop_new, Overflow::drop_far, Overflow::blend})
        for (const Limits& limits : {Limits{0, 0, rule}, Limits{1, 0, rule}, Limits{3, 0, rule}, Limits{0, 200, rule},
                                     Limits{2, 300, rule}, Limits{0, 1, rule}, Limits{0, 5000, rule}}) {
            RenderOptions options = eighths_options(scene);
            options.algorithm.pixel_nodes = static_cast<int>(limits.pixel_nodes);
            options.algorithm.frame_nodes = static_cast<int>(limits.frame_nodes);
            options.algorithm.overflow = rule;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "linked_list", options, are_alike);
            const GivenLists lists = lists_model(scene, limits);
            INFO(limits.pixel_nodes << " nodes a pixel, " << limits.frame_nodes << " a frame, rule "
                                    << static_cast<int>(rule));
            CHECK(first_unlike(result.frame.color, [&](std::size_t p) { return list_color(scene, lists, p, rule); }) ==
                  "");
            CHECK(are_alike);
            CHECK(diagnosed(result, Fault::buffer_overflow) == lists.overflowing);
            CHECK((result.audit.order_errors == 0u) == (lists.overflowing == 0));
            overflowing += lists.overflowing;
        }
    CHECK(overflowing > 1000);
}

TEST_CASE("linked_list with a limit of nodes per frame runs literally and loses fragments") {
    const FragmentScene scene = eighths_scene(22, 6);
    RenderOptions options = eighths_options(scene);
    options.audit = false;
    const RenderResult whole = render(scene, {"ideal", "linked_list"}, options);
    options.algorithm.frame_nodes = 250;
    const RenderResult limited = render(scene, {"ideal", "linked_list"}, options);
    CHECK(limited.frame.color != whole.frame.color);
    CHECK(limited.frame.work.why == "a limit of nodes counts across the frame");
}
