// Tests the layers of lists with equal depths. The expected layers are written by hand from
// peeling/reference/keys-and-counts.md 2.2.
#include "tools/oracle/rules/structure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace strata;
using namespace strata::oracle::verdict;

namespace {

// Fragments with these depth codes; the red of each is its index.
std::vector<Fragment> fragments(const std::vector<std::uint32_t>& codes) {
    std::vector<Fragment> all;
    for (const std::uint32_t code : codes)
        all.push_back({.color = {static_cast<float>(all.size()), 0, 0, 0.5f},
                       .code = code,
                       .shader_z = static_cast<float>(code),
                       .primitive = static_cast<std::uint32_t>(all.size())});
    return all;
}

struct Layers {
    std::vector<int> reds;
    std::size_t near, near_without_middle;
    bool operator==(const Layers&) const = default;
};

Layers layers(const std::vector<std::uint32_t>& codes, TieHandling rule) {
    const std::vector<Fragment> all = fragments(codes);
    const Setting setting;
    StackMaker maker{setting};
    const Stack& stack = maker.right({.visible = all}, {rule, ComparedDepth::code});
    Layers found{{}, stack.near, stack.near_without_middle};
    for (const Layer& layer : stack.layers) found.reds.push_back(static_cast<int>(layer.color[0]));
    return found;
}

}  // namespace

TEST_CASE("of fragments at equal depths a rule keeps the first or the last or all in its order") {
    const std::vector<std::uint32_t> codes{1, 1, 2, 3, 3};  // of three depths the middle one may belong to either half
    CHECK(layers(codes, TieHandling::first) == Layers{{0, 1, 2, 3, 4}, 3, 2});
    CHECK(layers(codes, TieHandling::last) == Layers{{1, 0, 2, 4, 3}, 3, 2});
    CHECK(layers(codes, TieHandling::unique) == Layers{{0, 2, 3}, 2, 1});
    CHECK(layers(codes, TieHandling::unique_last) == Layers{{1, 2, 4}, 2, 1});
    CHECK(layers(codes, TieHandling::first_then_last) == Layers{{0, 1, 2, 4, 3}, 3, 2});
    CHECK(layers({}, TieHandling::first) == Layers{{}, 0, 0});
}

TEST_CASE("fragments at equal depths merge by MAX premultiplied in the near half and straight in the far half") {
    std::vector<Fragment> all = fragments({1, 1, 2, 2});
    all[0].color = {1.0f, 0.25f, 0, 0.25f};
    all[1].color = {0.5f, 0.5f, 0, 0.75f};
    all[2].color = {1.0f, 0.25f, 0, 0.25f};
    all[3].color = {0.5f, 0.5f, 0, 0.75f};
    const Setting setting;
    StackMaker maker{setting};
    const Stack& stack = maker.right({.visible = all}, {TieHandling::merged, ComparedDepth::code});
    REQUIRE(stack.layers.size() == 2);
    CHECK(stack.layers[0].color == Rgba{0.5f, 0.5f, 0, 0.75f});  // (0.375, 0.375, 0) premultiplied
    CHECK(stack.layers[1].color == Rgba{1.0f, 0.5f, 0, 0.75f});
    CHECK(stack.near == 1);
}

TEST_CASE("depths are compared as stored codes or as binary32 and a pixel has ties if these order it differently") {
    std::vector<Fragment> all = fragments({5, 5});
    all[0].shader_z = 0.75f;
    all[1].shader_z = 0.5f;
    const Setting setting;
    StackMaker maker{setting};
    CHECK(maker.right({.visible = all}, {TieHandling::unique, ComparedDepth::code}).layers.size() == 1);
    const Stack& by_z = maker.right({.visible = all}, {TieHandling::unique, ComparedDepth::shader_z});
    REQUIRE(by_z.layers.size() == 2);
    CHECK(by_z.layers[0].color[0] == 1);
    CHECK(has_ties(all));
    CHECK(has_ties(fragments({1, 1})));
    CHECK_FALSE(has_ties(fragments({1, 2, 3})));
    all[1].code = 6;  // stored in the opposite order
    CHECK(has_ties(all));
}

namespace {

// Few different depths, so that most lists have ties by one key or both; submission order is random.
std::vector<Fragment> random_fragments(std::size_t count, std::mt19937& random) {
    std::vector<Fragment> all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto code = static_cast<std::uint32_t>(random() % 4);
        all.push_back({.color = {static_cast<float>(i), 0, 0, 0.5f},
                       .code = code,
                       .shader_z = static_cast<float>(code) +
                                   static_cast<float>(random() % 2) * 0.75f * (random() % 2 == 0 ? 1.0f : 2.0f),
                       .primitive = static_cast<std::uint32_t>(i)});
    }
    std::ranges::stable_sort(all, {}, &Fragment::code);
    return all;
}

}  // namespace

TEST_CASE("omitted rules for ties give the same structures as the rules that represent them") {
    std::mt19937 random{7};
    const Setting setting;
    StackMaker maker{setting}, other{setting};
    std::size_t left_out = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::vector<Fragment> all = random_fragments(random() % 8, random);
        const PixelList list{.visible = all};
        const TieChoices choices = tie_choices({}, list);
        for (std::size_t n = 0; n < ties_count; ++n) {
            REQUIRE(choices.same_as[n] <= n);
            REQUIRE(choices.same_as[choices.same_as[n]] == choices.same_as[n]);
            left_out += choices.same_as[n] == n ? 0 : 1;
            REQUIRE(maker.right(list, ties_number(n)) == other.right(list, ties_number(choices.same_as[n])));
        }
        std::vector<Stack> kept{maker.right(list, {})};
        for (std::uint32_t p = 1; p < choices.permutations; ++p)
            kept.push_back(maker.right(list, {TieHandling::other, ComparedDepth::code, p}));
        for (std::uint32_t p = 0; p < permutations; ++p)
            REQUIRE(std::ranges::find(kept, maker.right(list, {TieHandling::other, ComparedDepth::code, p})) !=
                    kept.end());
    }
    CHECK(left_out > 0);
}
