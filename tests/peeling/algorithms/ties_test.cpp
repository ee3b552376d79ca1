// Tests front_to_back_ties and dual_ties against lists sorted by depth and submission, in real numbers.
// peeling/reference/algorithms.md 25.
#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

const ExpectedRow expected_front_to_back_ties{
    {.algorithm = "front_to_back_ties",
     .devices = Devices::programmable,
     .targets = {"nearest", "ties", "layer", "group", "accumulated", "result"},
     .render_targets = 3}};
const ExpectedRow expected_dual_ties{{.algorithm = "dual_ties",
                                      .devices = Devices::programmable,
                                      .targets = {"min_max", "ties", "layer", "group", "front", "back", "result"},
                                      .render_targets = 5}};

std::vector<GivenFragment> sorted(const GivenPixel& pixel) {
    auto fragments = visible(pixel);
    std::ranges::stable_sort(fragments, {}, &GivenFragment::depth);
    return fragments;
}

Color3 composited(const std::vector<GivenFragment>& near_to_far, const GivenPixel& pixel) {
    RealLayer all;
    for (const GivenFragment& f : near_to_far) all = joined(all, layer_of(f));
    return over(all, behind(pixel));
}

// A peel of one pixel whose fragments are sorted near to far: every iteration takes the first and the last fragment
// left at the nearest depth, and, in a dual peel, at the farthest.
struct PixelPeel {
    std::vector<std::pair<std::size_t, std::size_t>> groups{};  // at each depth left: the indices [first, second)
    std::vector<bool> is_taken{};
    explicit PixelPeel(const std::vector<GivenFragment>& fragments) : is_taken(fragments.size()) {
        for (std::size_t i = 0; i < fragments.size(); ++i)
            if (i > 0 && fragments[i].depth == fragments[i - 1].depth)
                ++groups.back().second;
            else
                groups.emplace_back(i, i + 1);
    }
    void take_from(std::pair<std::size_t, std::size_t>& group) {
        is_taken[group.first++] = true;
        if (group.first < group.second) is_taken[--group.second] = true;
    }
    void iterate(bool is_dual) {
        if (groups.empty()) return;
        if (is_dual && groups.size() > 1) take_from(groups.back());
        take_from(groups.front());
        std::erase_if(groups, [](const auto& group) { return group.first == group.second; });
    }
};

int passes_of(const FragmentScene& scene, bool is_dual) {
    int most = 1;
    for (const GivenPixel& pixel : scene.pixels) {
        PixelPeel peel{sorted(pixel)};
        int iterations = 0;
        for (; !peel.groups.empty(); ++iterations) peel.iterate(is_dual);
        most = std::max(most, iterations);
    }
    return 1 + 2 * most;
}

// Scenes with up to 6 fragments at 6 depths, at one depth, and at two.
FragmentScene tied_scene(unsigned seed, int depths) {
    FragmentScene scene = eighths_scene(seed, 6);
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        for (std::size_t i = 0; i < scene.pixels[p].fragments.size(); ++i)
            if (depths < 6) scene.pixels[p].fragments[i].depth = static_cast<float>((i * 5 + p) % 7 % depths) / 8.0f;
    return scene;
}

}  // namespace

TEST_CASE("front_to_back_ties and dual_ties composite every fragment of equal depth in every execution") {
    for (const bool is_dual : {false, true})
        for (const int depths : {1, 2, 3, 6}) {
            const FragmentScene scene = tied_scene(static_cast<unsigned>(70 + depths), depths);
            const char* const algorithm = is_dual ? "dual_ties" : "front_to_back_ties";
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, algorithm, eighths_options(scene), are_alike);
            INFO(algorithm << " at " << depths << " depths");
            REQUIRE_FALSE(result.refusal);
            CHECK(first_unlike(result.frame.color, [&](std::size_t p) {
                      return composited(sorted(scene.pixels[p]), scene.pixels[p]);
                  }) == "");
            CHECK(are_alike);
            CHECK(result.audit.order_errors == 0u);
            CHECK(result.audit.lost_by_ties == 0u);
            CHECK(result.frame.passes.geometry == passes_of(scene, is_dual));
        }
}

TEST_CASE("front_to_back_ties and dual_ties under a limit of passes composite the fragments that they have taken") {
    for (const bool is_dual : {false, true})
        for (const int iterations : {0, 1, 2, 3}) {
            const FragmentScene scene = tied_scene(81, 2);
            RenderOptions options = eighths_options(scene);
            options.max_passes = 1 + 2 * iterations;
            const char* const algorithm = is_dual ? "dual_ties" : "front_to_back_ties";
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, algorithm, options, are_alike);
            INFO(algorithm << " after " << iterations << " iterations");
            CHECK(are_alike);
            CHECK(first_unlike(result.frame.color, [&](std::size_t p) {
                      const auto all = sorted(scene.pixels[p]);
                      PixelPeel peel{all};
                      for (int i = 0; i < iterations; ++i) peel.iterate(is_dual);
                      std::vector<GivenFragment> taken;
                      for (std::size_t i = 0; i < all.size(); ++i)
                          if (peel.is_taken[i]) taken.push_back(all[i]);
                      return composited(taken, scene.pixels[p]);
                  }) == "");
        }
}

TEST_CASE("peels that count ties agree with layer_peel on a device with rgba8 within the roundings of their blends") {
    const FragmentScene scene = tied_scene(91, 3);
    RenderOptions options = eighths_options(scene);
    for (const char* const algorithm : {"front_to_back_ties", "dual_ties"}) {
        const RenderResult result = render(scene, {"geforce8", algorithm}, options);
        REQUIRE_FALSE(result.refusal);
        CHECK(result.audit.order_errors == 0u);
        CHECK(result.audit.max_difference <= 7);
    }
}
