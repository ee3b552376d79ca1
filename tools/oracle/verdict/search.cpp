#include "tools/oracle/verdict/search.h"

#include <algorithm>
#include <set>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

namespace {

constexpr std::size_t most_of_a_kind = 64;  // instances, materials, alphas: beyond that no rule is made for each

template <class T>
std::vector<T> few(const std::set<T>& all) {
    if (all.size() > most_of_a_kind) return {};
    return {all.begin(), all.end()};
}

}  // namespace

SceneFacts facts_of(const SceneFragments& scene, const Sample& sample) {
    SceneFacts facts{.most_layers = scene.most_visible()};
    std::set<std::uint32_t> instances, materials;
    std::set<float> alphas;
    std::set<bool> facings;
    for (const SampledPixel& pixel : sample.pixels()) {
        facts.has_opaque |= pixel.list.has_opaque;
        facts.has_hidden |= !pixel.list.hidden.empty();
        for (const Fragment& f : pixel.fragments) {
            instances.insert(f.instance);
            materials.insert(f.material);
            facings.insert(f.is_front_facing);
            if (alphas.size() <= most_of_a_kind) alphas.insert(f.color[3]);
        }
    }
    facts.has_two_facings = facings.size() == 2;
    facts.instances = few(instances);
    facts.materials = few(materials);
    facts.alphas = few(alphas);
    return facts;
}

std::vector<Rule> rules_for(const SceneFacts& facts) {
    using enum RuleKind;
    std::vector<Rule> all;
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(facts.most_layers, 64));
    const auto numbered = [&](std::initializer_list<RuleKind> kinds, std::uint32_t first, std::uint32_t last) {
        for (const RuleKind kind : kinds)
            for (std::uint32_t n = first; n < last; ++n) all.push_back({.kind = kind, .n = n});
    };
    numbered({nearest_alone}, 0, most);
    numbered({ends_alone}, 1, (most + 1) / 2);
    numbered({farthest_alone, nearest_lost, farthest_lost, rest_averaged, rest_as_submitted, first_submitted,
              last_submitted},
             1, most);
    for (const RuleKind kind :
         {reversed, as_submitted, as_submitted_reversed, behind_submitted, before_submitted, averaged, added,
          weighted_sum, alpha_squared, alpha_inverted, alpha_ignored, premultiplied_twice, not_premultiplied,
          all_doubled, background_lost, background_twice, surface_lost})
        all.push_back({kind});
    if (facts.has_two_facings)
        for (const RuleKind kind :
             {back_faces_lost, front_faces_lost, back_faces_behind, back_faces_behind_as_submitted})
            all.push_back({kind});
    if (facts.has_hidden) all.push_back({hidden_shown});
    if (facts.has_opaque)
        for (const RuleKind kind : {opaque_lost, opaque_ignored, opaque_in_front}) all.push_back({kind});
    if (facts.instances.size() > 1) {
        for (const RuleKind kind : {by_instance, by_instance_reversed, nearest_of_instance}) all.push_back({kind});
        for (const std::uint32_t i : facts.instances)
            for (const RuleKind kind : {instance_lost, instance_doubled}) all.push_back({.kind = kind, .n = i});
    }
    if (facts.materials.size() > 1)
        for (const std::uint32_t m : facts.materials)
            for (const RuleKind kind : {material_lost, material_doubled}) all.push_back({.kind = kind, .n = m});
    for (std::size_t i = 1; i < facts.alphas.size(); ++i)
        for (const RuleKind kind : {alpha_below_lost, alpha_below_kept})
            all.push_back({.kind = kind, .value = facts.alphas[i]});
    for (const std::uint32_t codes : {0u, 1u, 2u, 3u, 4u, 8u, 16u, 32u, 64u, 256u, 1024u, 4096u})
        for (const RuleKind kind : {close_lost, close_merged, close_swapped, at_opaque_shown, near_opaque_lost}) {
            const bool is_of_opaque = kind == at_opaque_shown || kind == near_opaque_lost;
            if (is_of_opaque ? facts.has_opaque : codes > 0) all.push_back({.kind = kind, .n = codes});
        }
    for (float power = 1e-8f; power < 0.05f; power *= 10)
        for (const float times : {1.0f, 2.0f, 5.0f}) all.push_back({.kind = within_lost, .value = power * times});
    numbered({lost, lost_from_far, doubled, doubled_from_far}, 0, most);
    if (most > 1) numbered({swapped, swapped_from_far, merged, mixed, color_of_next, color_of_previous}, 0, most - 1);
    return all;
}

namespace {

// The sample's pixels apart: those that the closest account of the right structure calls wrong, and the others.
struct Parted {
    std::vector<const SampledPixel*> wrong{}, right{};
};

Parted parted(const Sample& sample, const Hypothesis& closest) {
    const Compositor compositor{closest};
    StackMaker maker{sample.cleared()};
    Parted parts;
    for (const SampledPixel& pixel : sample.pixels())
        (reaching(compositor, stacked({}, pixel, maker)) == nullptr ? parts.wrong : parts.right).push_back(&pixel);
    return parts;
}

// Whether one of the hypotheses holds for all pixels under a rule.
bool survives(const Rule& rule, const Parted& parts, const std::vector<Compositor>& wide, const Rgba& cleared) {
    StackMaker maker{cleared};
    std::vector<const Compositor*> left;
    for (const Compositor& compositor : wide) left.push_back(&compositor);
    for (const auto* pixels : {&parts.wrong, &parts.right})
        for (const SampledPixel* pixel : *pixels) {
            const StackedPixel made = stacked({&rule, 1}, *pixel, maker);
            std::erase_if(left, [&](const Compositor* c) { return reaching(*c, made) == nullptr; });
            if (left.empty()) return false;
        }
    return true;
}

std::vector<Rule> survivors(const std::vector<Rule>& rules, const Parted& parts, const std::vector<Hypothesis>& wide,
                            const Rgba& cleared) {
    const std::vector<Compositor> compositors(wide.begin(), wide.end());
    std::vector<std::uint8_t> lives(rules.size());
    parallel_for(rules.size(), 0,
                 [&](std::size_t i) { lives[i] = survives(rules[i], parts, compositors, cleared) ? 1 : 0; });
    std::vector<Rule> left;
    for (std::size_t i = 0; i < rules.size(); ++i)
        if (lives[i] != 0) left.push_back(rules[i]);
    return left;
}

// How many of the pixels a rule does not reach.
std::size_t missed(const std::vector<const SampledPixel*>& pixels, const Rule& rule, const Compositor& compositor,
                   const Rgba& cleared) {
    StackMaker maker{cleared};
    return static_cast<std::size_t>(std::ranges::count_if(pixels, [&](const SampledPixel* pixel) {
        return reaching(compositor, stacked({&rule, 1}, *pixel, maker)) == nullptr;
    }));
}

double bits_of(const Checked& checked) {
    const Pricing pricing{checked.account.hypothesis.result.storage};
    return bits_of(checked.account.hypothesis) + checked.bits +
           static_cast<double>(checked.wrong_pixels.size()) * pricing.of_wrong();
}

std::vector<Lead> leads_of(const std::vector<Rule>& rules, const Parted& parts, const Hypothesis& hypothesis,
                           const Rgba& cleared) {
    constexpr std::size_t most_leads = 5;
    const Compositor compositor{hypothesis};
    std::vector<Lead> all(rules.size());
    parallel_for(rules.size(), 0, [&](std::size_t i) {
        Lead& lead = all[i];
        lead = {.rule = rules[i], .of = parts.wrong.size(), .right = parts.right.size()};
        lead.explained = lead.of - missed(parts.wrong, rules[i], compositor, cleared);
        lead.contradicted = missed(parts.right, rules[i], compositor, cleared);
    });
    std::erase_if(all, [](const Lead& l) { return l.explained == 0 || l.contradicted >= l.explained; });
    std::ranges::stable_sort(all, std::ranges::greater{}, [](const Lead& l) { return l.explained - l.contradicted; });
    all.resize(std::min(all.size(), most_leads));
    return all;
}

}  // namespace

Findings search(const SceneFragments& scene, const Colors& candidate, const std::vector<Hypothesis>& definite,
                const Checked& closest, const Sample& sample) {
    Findings findings;
    const SceneFacts facts = facts_of(scene, sample);
    const std::vector<Rule> rules = rules_for(facts);
    findings.tried = rules.size();
    const Parted parts = parted(sample, closest.account.hypothesis);
    std::vector<Hypothesis> wide = widest(hypotheses(storage_of(candidate.code())));
    for (Hypothesis& h : wide)
        for (const Hypothesis& d : definite) h.slack = std::max(h.slack, d.slack);
    for (const Rule& rule : survivors(rules, parts, wide, scene.cleared())) {
        // Of one kind with other numbers the first tells enough.
        if (std::ranges::any_of(findings.explanations,
                                [&](const Checked& c) { return c.account.rules[0].kind == rule.kind; }))
            continue;
        Sample own = sample;
        if (auto found = account_for(definite, {rule}, scene, candidate, own))
            findings.explanations.push_back(*std::move(found));
    }
    std::ranges::stable_sort(findings.explanations, {}, [](const Checked& c) { return bits_of(c); });
    // What leaves much more open has only room for the picture.
    if (!findings.explanations.empty()) {
        const double most = 1.05 * bits_of(findings.explanations[0]) + 64;
        std::erase_if(findings.explanations, [&](const Checked& c) { return bits_of(c) > most; });
        std::erase_if(findings.explanations, [&](const Checked& c) { return bits_of(c) >= bits_of(closest); });
    }
    if (findings.explanations.empty())
        findings.leads = leads_of(rules, parts, closest.account.hypothesis, scene.cleared());
    return findings;
}

}  // namespace strata::oracle::verdict
