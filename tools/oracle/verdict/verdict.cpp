#include "tools/oracle/verdict/verdict.h"

#include <algorithm>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

namespace {

struct Choices {
    Families definite{}, loose{};
};

// Colours and alpha are off by as much, of values in [0, 1]: nothing, or some units in the last place of binary32. Loose ones are interpolated in
// fewer bits, or over positions that are snapped otherwise.
Choices choices(Storage storage) {
    return {families(storage, {0, 0x1p-20}, Looseness::definite),
            families(storage, {0x1p-17, 0x1p-14, 0x1p-11}, Looseness::loose)};
}

double bits_of(const Checked& c, Storage storage) {
    return c.bits + static_cast<double>(c.wrong_pixels.size()) * Pricing{storage}.of_wrong();
}

// Of the rules, those that reach every pixel of the sample, too.
std::vector<Rule> alike_in(const Sample& sample, const std::vector<Rule>& rules, const Hypothesis& hypothesis) {
    std::vector<std::uint8_t> is_alike(rules.size(), 1);
    parallel_for(rules.size(), 0, [&](std::size_t i) {
        const Compositor compositor{hypothesis};
        StackMaker maker{sample.setting()};
        for (const SampledPixel& pixel : sample.pixels())
            if (ties_that_hold(compositor, {&rules[i], 1}, pixel.list, pixel.value, maker).mask == 0) {
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

namespace {

// A right account that leaves little open needs no other one beside it: bits of a covered pixel, and codes (of floats: parts of 255).
constexpr double few_bits = 1, few_codes = 1;

// What explains the picture in much fewer bits than a right account that leaves much open: then the room that it leaves is no evidence.
std::vector<Checked> told_better(const SceneFragments& scene, const Colors& candidate, const Choices& all,
                                 const Checked& right, const Sample& sample) {
    if (right.bits <= few_bits * static_cast<double>(right.covered) || right.possible <= few_codes) return {};
    // Deep pixels tell the most, and are enough.
    constexpr std::size_t most = 512;
    std::vector<const SampledPixel*> deep;
    for (const SampledPixel& pixel : sample.pixels()) deep.push_back(&pixel);
    std::ranges::stable_sort(deep, std::ranges::greater{},
                             [](const SampledPixel* p) { return p->list.visible.size(); });
    Sample deepest{scene.setting()};
    for (std::size_t i = 0; i < std::min(most, deep.size()); ++i) deepest.add(deep[i]->list, deep[i]->value);
    std::vector<Checked> better = search(scene, candidate, all.definite, right, deepest).explanations;
    std::erase_if(better, [&](const Checked& c) { return c.bits > 0.5 * right.bits; });
    return better;
}

}  // namespace

Verdict judge(const SceneFragments& scene, const Colors& candidate) {
    constexpr std::size_t most_sampled = 2048;
    const Storage storage = storage_of(candidate.code());
    const Choices all = choices(storage);
    const Sample even = sampled(scene, candidate, most_sampled);
    Verdict verdict{.width = scene.width(), .facts = facts_of(scene, even)};
    Sample sample = even;
    std::optional<Checked> right = account_for(all.definite, {}, scene, candidate, sample);
    Sample examples{scene.setting()};
    if (!right) {
        verdict.right = check_all(scene, candidate, {{}, *best_of(all.definite, {}, even, Wrong::some)}, examples);
        right = account_for(all.loose, {}, scene, candidate, sample);
        if (right && right->bits >= bits_of(verdict.right, storage)) right.reset();
    }
    if (right) {
        verdict.right = *std::move(right);
        verdict.explanations = told_better(scene, candidate, all, verdict.right, even);
        verdict.is_right = verdict.explanations.empty();
        if (verdict.is_right) find_alike(scene, candidate, verdict);
        return verdict;
    }
    for (const SampledPixel& pixel : examples.pixels()) sample.add(pixel.list, pixel.value);
    Findings found = search(scene, candidate, all.definite, verdict.right, sample);
    verdict.explanations = std::move(found.explanations);
    verdict.leads = std::move(found.leads);
    return verdict;
}

}  // namespace strata::oracle::verdict
