// Tests every rule on a list of five fragments. The expected layers are written by hand.
#include "tools/oracle/rules/rules.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "pipeline/vertices/draw_list.h"
#include "tools/oracle/rules/structure.h"

using namespace strata;
using namespace strata::oracle::verdict;

namespace {

// Five fragments from near to far; the red of each is its index, and `submitted` has its submission index.
struct Five {
    std::vector<Fragment> all{};
    Setting setting{};
    Five() {
        constexpr std::uint32_t submitted[] = {3, 0, 4, 1, 2};
        constexpr float depths[] = {0.1f, 0.12f, 0.4f, 0.6f, 0.9f};  // the first two are equal in three bits
        for (std::size_t i = 0; i < 5; ++i)
            all.push_back({.color = {static_cast<float>(i), 0.25f, 0.75f, 0.125f * static_cast<float>(i + 1)},
                           .code = static_cast<std::uint32_t>(100 * (i + 1)),
                           .shader_z = depths[i],
                           .primitive = submitted[i]});
    }
    [[nodiscard]] Stack with(const Rule& rule, bool has_opaque = false) const {
        StackMaker maker{setting};
        const std::span<const Fragment> list{all};
        const std::size_t visible = std::min<std::size_t>(all.size(), 4);
        return maker.with({&rule, 1},
                          {.visible = list.first(visible),
                           .hidden = list.subspan(visible),
                           .behind = {0.5f, 0.5f, 0.5f, 1},
                           .opaque = 450,
                           .has_opaque = has_opaque},
                          {});
    }
    [[nodiscard]] std::vector<int> reds(const Rule& rule, bool has_opaque = false) const {
        std::vector<int> found;
        for (const Layer& layer : with(rule, has_opaque).layers) found.push_back(static_cast<int>(layer.color[0]));
        return found;
    }
};

using Reds = std::vector<int>;

}  // namespace

TEST_CASE("rules that choose and order layers leave the described layers from near to far") {
    using enum RuleKind;
    const Five list;
    const auto reds = [&](RuleKind kind, std::uint32_t n = 0) { return list.reds({.kind = kind, .n = n}, true); };
    CHECK(reds(ordered_in_bits, 3) == Reds{1, 0, 2, 3});
    CHECK(reds(sorted_once) == Reds{1, 0, 2, 3});  // in submission order: 1, 3, 0, 2
    CHECK(reds(hidden_alone) == Reds{4});
    CHECK(list.reds({.kind = hidden_alone}) == Reds{0, 1, 2, 3, 4});
}

TEST_CASE("rules of colours and of the background change the described values") {
    using enum RuleKind;
    const Five list;
    CHECK(list.with({.kind = channel_lost, .n = 2}).layers[1].color == Rgba{1, 0.25f, 0, 0.25f});
    CHECK(list.with({.kind = multiplied}).background == Rgba{0, 0.001953125f, 0.158203125f, 1});
    Five seen;
    seen.setting.seen_background = Rgba{1, 0, 1, 1};
    CHECK(seen.with({.kind = background_other}).background == Rgba{1, 0, 1, 1});
    CHECK(seen.with({.kind = background_other}, true).background == Rgba{0.5f, 0.5f, 0.5f, 1});
}

TEST_CASE("rules of submission and of single layers change the described layers") {
    using enum RuleKind;
    const Five list;  // four visible fragments, from near to far submitted as 1, 3, 0, 2
    const auto reds = [&](RuleKind kind, std::uint32_t n = 0) { return list.reds({.kind = kind, .n = n}, true); };
    CHECK(reds(colors_as_submitted) == Reds{1, 3, 0, 2});
    CHECK(list.with({.kind = alphas_as_submitted}, true).layers[0].color[3] == 0.25f);
    CHECK(list.reds({.kind = nearest_alone, .n = 1, .region = {5, 5, 9, 9}}, true) == Reds{0, 1, 2, 3});
    const Stack second = list.with({.kind = alpha_ignored, .scope = Scope::layer, .of = 1}, true);
    CHECK(second.layers[1].color[3] == 1);
    CHECK(second.layers[0].color[3] == 0.125f);
    const Stack last = list.with({.kind = solid, .scope = Scope::layer_from_far}, true);
    CHECK(last.layers[3].color == Rgba{1.5f, 0.125f, 0.375f, 1});
    CHECK(last.layers[2].color[3] == 0.375f);
}

TEST_CASE("rules of the blend set their mixing and few_bits sets its numbers of bits") {
    using enum RuleKind;
    const Five list;
    CHECK(list.with({.kind = through_summed}).mixing.through == Mixing::Through::summed);
    CHECK(list.with({.kind = not_attenuated}).mixing.attenuates == false);
    const Mixing few = list.with({.kind = few_bits, .n = 5 | 1 << 8 | 1 << 16}).mixing;
    CHECK(few.color_bits == 5);
    CHECK(few.weight_bits == 1);
    CHECK(few.picture_too);
    CHECK(list.with({.kind = surface_mixed, .value = 0.5f}, true).background == Rgba{0.25f, 0.25f, 0.25f, 1});
    CHECK(list.with({.kind = surface_mixed, .value = 0.5f}).background == Rgba{0.5f, 0.5f, 0.5f, 1});
}

TEST_CASE("layers that are composited twice as a whole have the alpha of all of them") {
    Five list;
    list.all.resize(2);
    list.all[0].color = {1, 0, 0, 0.5f};
    list.all[1].color = {0, 1, 0, 0.5f};
    StackMaker maker{list.setting};
    const Rule rule{.kind = RuleKind::composed_twice};
    const Stack& stack = maker.with({&rule, 1}, {.visible = list.all, .hidden = {}, .behind = {0, 0, 0, 1}}, {});
    REQUIRE(stack.layers.size() == 1);
    CHECK(stack.layers[0].color == Rgba{0.5f, 0.25f, 0, 0.75f});
}

TEST_CASE("every kind of rule has a unique name and a sentence") {
    SceneFacts facts{.most_layers = 6};
    pipeline::DrawList list;
    list.meshes.resize(1);
    list.materials.resize(1);
    list.instances.resize(1);
    std::set<std::string> names, descriptions;
    for (std::size_t k = 0; k < rule_kind_count; ++k) {
        const Rule rule{.kind = static_cast<RuleKind>(k), .n = 2, .value = 0.5f};
        names.emplace(name(rule.kind));
        if (rule.kind == RuleKind::right) continue;
        descriptions.insert(description(rule, facts, list));
    }
    CHECK(names.size() == rule_kind_count);
    CHECK(descriptions.size() == rule_kind_count - 1);
    CHECK_FALSE(descriptions.contains(""));
}
