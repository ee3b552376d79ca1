#include "tools/oracle/verdict/verdict.h"

#include <algorithm>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

namespace {

// Colours and alpha off by as much, of values in [0, 1]: to the bit; some units in the last place of binary32.
constexpr double own_slacks[] = {0, 0x1p-20};
// Interpolated in fewer bits, or over positions that are snapped otherwise.
constexpr double wide_slacks[] = {0x1p-17, 0x1p-14, 0x1p-11};

// What a device or a program may well do: one rounding, one format an end.
bool is_definite(const Hypothesis& h) noexcept {
    const auto is_any = [](const End& end) { return end.rounding == Rounding::any && end.storage == Storage::unorm8; };
    return !is_any(h.front) && !is_any(h.back) && !is_any(h.result);
}

struct Choices {
    std::vector<Hypothesis> definite{}, loose{};
};

Choices choices(Storage storage) {
    Choices all;
    const auto add = [&](double slack, auto& into, bool only_definite) {
        for (Hypothesis& h : hypotheses(storage)) {
            h.slack = slack;
            if (is_definite(h) || !only_definite) into.push_back(h);
        }
    };
    for (const double slack : own_slacks) add(slack, all.definite, true);
    for (const double slack : wide_slacks) add(slack, all.loose, false);
    return all;
}

double bits_of(const Checked& c, Storage storage) {
    return c.bits + static_cast<double>(c.wrong_pixels.size()) * Pricing{storage}.of_wrong();
}

// One rule a kind, where the kind has numbers that which shows the least.
std::vector<Rule> one_of_each_kind(const SceneFacts& facts) {
    std::vector<Rule> all(rule_kind_count);
    for (std::size_t k = 0; k < rule_kind_count; ++k) all[k].kind = static_cast<RuleKind>(k);
    const auto most = static_cast<std::uint32_t>(facts.most_layers);
    const auto least = [&](RuleKind kind, std::uint32_t n) { all[static_cast<std::size_t>(kind)].n = n; };
    for (const RuleKind kind : {RuleKind::nearest_alone, RuleKind::farthest_alone, RuleKind::rest_averaged,
                                RuleKind::rest_as_submitted, RuleKind::first_submitted, RuleKind::last_submitted})
        least(kind, most > 0 ? most - 1 : 0);
    least(RuleKind::ends_alone, most > 2 ? (most - 1) / 2 : 0);
    for (const RuleKind kind : {RuleKind::nearest_lost, RuleKind::farthest_lost, RuleKind::close_lost,
                                RuleKind::close_merged, RuleKind::close_swapped, RuleKind::near_opaque_lost})
        least(kind, 1);
    all[static_cast<std::size_t>(RuleKind::within_lost)].value = 1e-7f;
    for (const RuleKind kind : {RuleKind::instance_lost, RuleKind::instance_doubled})
        least(kind, facts.instances.empty() ? 0 : facts.instances[0]);
    for (const RuleKind kind : {RuleKind::material_lost, RuleKind::material_doubled})
        least(kind, facts.materials.empty() ? 0 : facts.materials[0]);
    for (const RuleKind kind : {RuleKind::alpha_below_lost, RuleKind::alpha_below_kept})
        all[static_cast<std::size_t>(kind)].value = facts.alphas.size() > 1 ? facts.alphas[1] : 0.5f;
    all.erase(all.begin());  // RuleKind::right
    return all;
}

// Of the rules, those that reach every pixel of the sample, too.
std::vector<Rule> alike_in(const Sample& sample, const std::vector<Rule>& rules, const Hypothesis& hypothesis) {
    std::vector<std::uint8_t> is_alike(rules.size(), 1);
    parallel_for(rules.size(), 0, [&](std::size_t i) {
        const Compositor compositor{hypothesis};
        StackMaker maker{sample.cleared()};
        for (const SampledPixel& pixel : sample.pixels())
            if (ties_that_hold(compositor, {&rules[i], 1}, pixel.list, pixel.value, maker) == 0) {
                is_alike[i] = 0;
                break;
            }
    });
    std::vector<Rule> alike;
    for (std::size_t i = 0; i < rules.size(); ++i)
        if (is_alike[i] != 0) alike.push_back(rules[i]);
    return alike;
}

void find_alike(const SceneFragments& scene, const Colors& candidate, Verdict& verdict) {
    constexpr std::size_t most = 16384;
    const std::vector<Rule> kinds = one_of_each_kind(verdict.facts);
    verdict.kinds = kinds.size();
    verdict.alike = alike_in(sampled(scene, candidate, most), kinds, verdict.right.account.hypothesis);
}

}  // namespace

Verdict judge(const SceneFragments& scene, const Colors& candidate) {
    constexpr std::size_t most_sampled = 2048;
    const Storage storage = storage_of(candidate.code());
    const Choices all = choices(storage);
    const Sample even = sampled(scene, candidate, most_sampled);
    Verdict verdict{.width = scene.width(), .facts = facts_of(scene, even)};
    Sample sample = even;
    const auto is_right = [&](Checked&& account) {
        verdict.is_right = true;
        verdict.right = std::move(account);
        find_alike(scene, candidate, verdict);
        return verdict;
    };
    if (auto right = account_for(all.definite, {}, scene, candidate, sample)) return is_right(*std::move(right));
    Sample examples{scene.cleared()};
    verdict.right = check_all(scene, candidate, {{}, *best_of(all.definite, {}, even, Wrong::some)}, examples);
    auto loose = account_for(all.loose, {}, scene, candidate, sample);
    if (loose && loose->bits < bits_of(verdict.right, storage)) return is_right(*std::move(loose));
    for (const SampledPixel& pixel : examples.pixels()) sample.add(pixel.list, pixel.value);
    Findings found = search(scene, candidate, all.definite, verdict.right, sample);
    verdict.explanations = std::move(found.explanations);
    verdict.leads = std::move(found.leads);
    return verdict;
}

}  // namespace strata::oracle::verdict
