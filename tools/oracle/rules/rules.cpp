// tools/oracle/rules/rules.cpp - lists the rules that are tried on a scene: kinds times the parameters that the scene
// can distinguish, the simplest first.
#include "tools/oracle/rules/rules.h"

#include <algorithm>
#include <set>

#include "tools/oracle/fragments/coverages.h"
#include "tools/oracle/fragments/sample.h"

namespace strata::oracle::verdict {

namespace {

// Instances, materials: rules for single ones are made only up to this number.
constexpr std::size_t most_of_a_kind = 64;

template <class T>
std::vector<T> few(const std::set<T>& all) {
    if (all.size() > most_of_a_kind) return {};
    return {all.begin(), all.end()};
}

}  // namespace

SceneFacts facts_of(const SceneFragments& scene, const Sample& sample) {
    SceneFacts facts{.most_layers = scene.most_visible()};
    facts.has_other_background = scene.setting().seen_background.has_value();
    facts.background = scene.setting().seen_background.value_or(Rgba{});
    std::set<std::uint32_t> instances, materials;
    std::set<bool> facings;
    for (const SampledPixel& pixel : sample.pixels()) {
        facts.has_opaque |= pixel.list.has_opaque;
        facts.has_hidden |= !pixel.list.hidden.empty();
        const Rgba& behind = pixel.list.behind;
        facts.is_dark_behind &= behind[0] == 0 && behind[1] == 0 && behind[2] == 0;
        facts.has_centres_on_edges |= pixel.list.edge != nullptr && pixel.list.edge->has_centre_on_edge;
        for (const Fragment& f : pixel.fragments) {
            instances.insert(f.instance);
            materials.insert(f.material);
            facings.insert(f.is_front_facing);
        }
    }
    facts.has_two_facings = facings.size() == 2;
    facts.instances = few(instances);
    facts.materials = few(materials);
    return facts;
}

namespace {

using Rules = std::vector<Rule>;

void add(Rules& all, std::initializer_list<RuleKind> kinds) {
    for (const RuleKind kind : kinds) all.push_back({.kind = kind});
}
void add_numbered(Rules& all, std::initializer_list<RuleKind> kinds, std::uint32_t first, std::uint32_t last) {
    for (const RuleKind kind : kinds)
        for (std::uint32_t n = first; n < last; ++n) all.push_back({.kind = kind, .n = n});
}

void add_counts(Rules& all, std::uint32_t most) {
    using enum RuleKind;
    add_numbered(all, {nearest_alone}, 0, most);
    add_numbered(all, {ends_alone, ends_rest_as_submitted}, 1, (most + 1) / 2);
    add_numbered(all,
                 {farthest_alone, nearest_lost, farthest_lost, rest_averaged, rest_as_submitted, first_submitted,
                  last_submitted},
                 1, most);
    for (std::uint32_t n = 1; n < most; ++n) all.push_back({.kind = rest_averaged, .n = n, .value = 1});
    for (const float through : {1.0f / 255, 0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.25f, 0.5f})
        all.push_back({.kind = ended_early, .value = through});
}

void add_orders(Rules& all, const SceneFacts& facts) {
    using enum RuleKind;
    add(all, {reversed});
    if (facts.most_layers > 1) {
        add_numbered(all, {by_centroid}, 0, triangle_point_count);
        add_numbered(all, {alphas_as_submitted, colors_as_submitted}, 0, 2);
        add(all, {sorted_once});
        add_numbered(all, {ordered_in_bits}, 6, 24);
    }
    const std::uint32_t orders = facts.instances.size() > 1 ? instance_order_count : 1;
    const std::uint32_t faces = facts.has_two_facings ? face_order_count : 1;
    for (const RuleKind kind : {as_submitted, behind_drawn})
        for (std::uint32_t i = 0; i < orders; ++i)
            for (std::uint32_t f = 0; f < faces; ++f) all.push_back({.kind = kind, .n = i * face_order_count + f});
    add(all, {before_drawn});
    if (facts.instances.size() > 1) {
        add_numbered(all, {by_instance}, 0, instance_order_count);
        add(all, {nearest_of_instance});
    }
}

// The scopes of a scene: instances, materials and facings.
std::vector<Rule> scopes_of(const SceneFacts& facts) {
    std::vector<Rule> scopes;
    if (facts.instances.size() > 1)
        for (const std::uint32_t i : facts.instances) scopes.push_back({.scope = Scope::instance, .of = i});
    if (facts.materials.size() > 1)
        for (const std::uint32_t m : facts.materials) scopes.push_back({.scope = Scope::material, .of = m});
    if (facts.has_two_facings)
        for (const Scope scope : {Scope::back_faces, Scope::front_faces}) scopes.push_back({.scope = scope});
    return scopes;
}

void add_scoped(Rules& all, const SceneFacts& facts) {
    using enum RuleKind;
    constexpr RuleKind colors[] = {alpha_squared,     alpha_inverted, alpha_ignored, premultiplied_twice,
                                   not_premultiplied, red_for_blue,   decoded,       encoded};
    constexpr float factors[] = {0.25f, 0.5f, 0.75f, 0.8f, 0.9f, 1.25f, 1.5f, 2.0f};
    const auto add_colors = [&](const Rule& scope) {
        for (const RuleKind kind : colors) all.push_back({.kind = kind, .scope = scope.scope, .of = scope.of});
        for (const float factor : factors)
            all.push_back({.kind = alpha_times, .value = factor, .scope = scope.scope, .of = scope.of});
        for (std::uint32_t channel = 0; channel < 3; ++channel)
            all.push_back({.kind = channel_lost, .n = channel, .scope = scope.scope, .of = scope.of});
    };
    add_colors({});
    add(all, {blended_linear});
    add_numbered(all, {decoded}, facts.has_opaque ? 1 : 2, 3);
    for (const Rule& scope : scopes_of(facts)) {
        for (const RuleKind kind : {some_lost, some_doubled})
            all.push_back({.kind = kind, .scope = scope.scope, .of = scope.of});
        add_colors(scope);
    }
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(facts.most_layers, 16));
    for (std::uint32_t n = 0; n < most; ++n)
        for (const Scope scope : {Scope::layer, Scope::layer_from_far}) add_colors({.scope = scope, .of = n});
    for (const Scope scope : {Scope::layer, Scope::layer_from_far}) all.push_back({.kind = solid, .scope = scope});
}

void add_depths(Rules& all, const SceneFacts& facts) {
    using enum RuleKind;
    for (const std::uint32_t codes : {0u, 1u, 2u, 3u, 4u, 8u, 16u, 32u, 64u, 256u, 1024u, 4096u}) {
        if (codes > 0) add_numbered(all, {close_lost, close_merged, close_swapped}, codes, codes + 1);
        if (facts.has_opaque) add_numbered(all, {at_opaque_shown, near_opaque_lost}, codes, codes + 1);
    }
    // Values with one significant digit, or two from 1e-3 on, where epsilons have a visible effect.
    for (const double power : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1})
        for (int times = 10; times < 100; times += power < 1e-3 ? 10 : 1)
            for (const RuleKind kind : {within_lost, within_merged})
                if (times * power < 5) all.push_back({.kind = kind, .value = static_cast<float>(times * power / 10)});
}

// Adds rules that read layers of other pixels.
void add_elsewhere(Rules& all, const SceneFacts& facts) {
    using enum RuleKind;
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(facts.most_layers, 3));
    for (std::uint32_t n = 0; n <= most; ++n) {
        for (const int by : {-1, 1, -2, 2})
            for (const bool is_x : {true, false})
                all.push_back({.kind = shifted, .n = n, .dx = is_x ? by : 0, .dy = is_x ? 0 : by});
        for (const int x : {-1, 1})
            for (const int y : {-1, 1}) all.push_back({.kind = shifted, .n = n, .dx = x, .dy = y});
        for (int i = 0; i < 4; ++i) all.push_back({.kind = halved, .n = n, .dx = i % 2, .dy = i / 2});
    }
}

void add_mixings(Rules& all) {
    using enum RuleKind;
    add(all, {through_squared, through_summed, not_attenuated, behind_squared, behind_inverted});
    for (const std::uint32_t picture : {0u, 1u})
        for (const auto& [colors, weight] :
             {std::pair{10, 2}, {7, 7}, {6, 6}, {5, 5}, {5, 1}, {4, 4}, {3, 3}, {2, 2}, {8, 4}, {8, 2}, {8, 1}})
            all.push_back({.kind = few_bits, .n = static_cast<std::uint32_t>(colors | weight << 8) | picture << 16});
}

}  // namespace

std::vector<Rule> rules_for(const SceneFacts& facts) {
    using enum RuleKind;
    Rules all;
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(facts.most_layers, 64));
    add_counts(all, most);
    add_orders(all, facts);
    add_numbered(all, {averaged}, 0, 7);
    add_mixings(all);
    add(all, {added, weighted_sum, multiplied, composed_twice, surface_lost, picture_encoded, picture_decoded});
    if (!facts.is_dark_behind) {
        add(all, {background_lost, background_twice});
        all.push_back({.kind = background_lost, .n = 1});
    }
    if (facts.has_other_background) add(all, {background_other});
    if (facts.has_centres_on_edges) add(all, {edges_twice, edges_never});
    if (facts.has_hidden) add(all, {hidden_shown, hidden_alone});
    if (facts.has_opaque) add(all, {opaque_lost, opaque_ignored, opaque_in_front});
    for (int i = 1; i < 20 && facts.has_opaque; ++i)
        all.push_back({.kind = surface_mixed, .value = static_cast<float>(i) / 20});
    add_depths(all, facts);
    add_scoped(all, facts);
    add_elsewhere(all, facts);
    add_numbered(all, {lost, lost_from_far}, 0, most);
    if (most > 1) add_numbered(all, {mixed}, 0, most - 1);
    return all;
}

std::vector<Rule> one_of_each_kind(const SceneFacts& facts) {
    Rules all(rule_kind_count);
    for (std::size_t k = 0; k < rule_kind_count; ++k) all[k].kind = static_cast<RuleKind>(k);
    const auto most = static_cast<std::uint32_t>(facts.most_layers);
    const auto of = [&](RuleKind kind) -> Rule& { return all[static_cast<std::size_t>(kind)]; };
    for (const RuleKind kind : {RuleKind::nearest_alone, RuleKind::farthest_alone, RuleKind::rest_averaged,
                                RuleKind::rest_as_submitted, RuleKind::first_submitted, RuleKind::last_submitted})
        of(kind).n = most > 0 ? most - 1 : 0;
    for (const RuleKind kind : {RuleKind::ends_alone, RuleKind::ends_rest_as_submitted})
        of(kind).n = most > 2 ? (most - 1) / 2 : 0;
    for (const RuleKind kind : {RuleKind::nearest_lost, RuleKind::farthest_lost, RuleKind::close_lost,
                                RuleKind::close_merged, RuleKind::close_swapped, RuleKind::near_opaque_lost})
        of(kind).n = 1;
    for (const RuleKind kind : {RuleKind::within_lost, RuleKind::within_merged}) of(kind).value = 1e-7f;
    for (const RuleKind kind : {RuleKind::some_lost, RuleKind::some_doubled}) {
        of(kind).scope = Scope::instance;
        of(kind).of = facts.instances.empty() ? 0 : facts.instances[0];
    }
    of(RuleKind::alpha_times).value = 0.9f;
    of(RuleKind::surface_mixed).value = 0.9f;
    of(RuleKind::few_bits).n = 7 | 7 << 8;
    of(RuleKind::shifted).dx = 1;
    of(RuleKind::solid).scope = Scope::layer_from_far;
    of(RuleKind::ended_early).value = 1.0f / 255;
    of(RuleKind::ordered_in_bits).n = 16;
    // Removes kinds that depend on the picture, and those that do not change the structure.
    std::erase_if(all, [](const Rule& rule) {
        return rule.kind == RuleKind::right || rule.kind == RuleKind::background_other ||
               rule.kind >= RuleKind::picture_encoded;
    });
    return all;
}

}  // namespace strata::oracle::verdict
