#include "tools/oracle/verdict/verdict.h"

#include <algorithm>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

namespace {

// How far colours and alpha may be off, of values in [0, 1].
struct Choices {
    Families definite{};  // nothing, or some units in the last place of binary32
    Families coarse{};  // interpolated or kept in fewer bits, or interpolated over positions that are snapped otherwise
    Families loose{};   // the same, and blended with errors up to a code a layer
};

Choices choices(Storage storage) {
    const std::vector<double> coarse{0x1p-17, 0x1p-14, 0x1p-11, 0x1p-9};
    return {families(storage, {0, 0x1p-20}, Looseness::definite), families(storage, coarse, Looseness::definite),
            families(storage, coarse, Looseness::loose)};
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
bool leaves_little_open(const Checked& right) {
    constexpr double few_bits = 1, few_codes = 1;
    return right.bits <= few_bits * static_cast<double>(right.covered) || right.possible <= few_codes;
}

// What explains the picture in much fewer bits than a right account that leaves much open: then the room that it leaves is no evidence.
std::vector<Checked> told_better(const SceneFragments& scene, const Colors& candidate, const Choices& all,
                                 const Checked& right, const Sample& sample) {
    if (leaves_little_open(right)) return {};
    // Deep pixels tell the most, and are enough.
    constexpr std::size_t most = 512;
    std::vector<const SampledPixel*> deep;
    for (const SampledPixel& pixel : sample.pixels()) deep.push_back(&pixel);
    std::ranges::stable_sort(deep, std::ranges::greater{},
                             [](const SampledPixel* p) { return p->list.visible.size(); });
    Sample deepest{scene.setting()};
    for (std::size_t i = 0; i < std::min(most, deep.size()); ++i) deepest.add(deep[i]->list, deep[i]->value);
    std::vector<Checked> better = search(scene, candidate, all.definite, right, deepest, 1);
    std::erase_if(better, [&](const Checked& c) { return c.bits > 0.5 * right.bits; });
    return better;
}

}  // namespace

Verdict judge(SceneFragments& scene, const Colors& candidate) {
    constexpr std::size_t most_sampled = 2048;
    const Storage storage = storage_of(candidate.code());
    const Choices all = choices(storage);
    Verdict verdict{.width = scene.width()};
    const auto is_right = [&](Checked&& right, const Sample& even) {
        verdict.right = std::move(right);
        verdict.explanations = told_better(scene, candidate, all, verdict.right, even);
        verdict.is_right = verdict.explanations.empty();
        if (verdict.is_right) find_alike(scene, candidate, verdict);
        return verdict;
    };
    {
        const Sample even = sampled(scene, candidate, most_sampled);
        verdict.facts = facts_of(scene, even);
        Sample sample = even;
        auto right = account_for(all.definite, {}, scene, candidate, sample);
        if (right && leaves_little_open(*right)) return is_right(*std::move(right), even);
    }
    scene.find_coverages();
    const Sample even = sampled(scene, candidate, most_sampled);
    verdict.facts = facts_of(scene, even);
    Sample sample = even, examples{scene.setting()};
    verdict.right = check_all(scene, candidate, {{}, *best_of(all.definite, {}, even, Wrong::some)}, examples);
    if (verdict.right.is_whole()) return is_right(std::move(verdict.right), even);
    // What leaves more open than the closest account has to beat it.
    for (const Families* some : {&all.definite, &all.coarse, &all.loose}) {
        auto right = account_for(*some, {}, scene, candidate, sample);
        if (right && right->bits <= bits_of(verdict.right, storage)) return is_right(*std::move(right), even);
    }
    for (const SampledPixel& pixel : examples.pixels()) sample.add(pixel.list, pixel.value);
    for (const auto& [some, most_rules] : {std::pair{&all.definite, 1}, {&all.coarse, 1}, {&all.definite, 2}}) {
        verdict.explanations = search(scene, candidate, *some, verdict.right, sample, most_rules);
        if (!verdict.explanations.empty()) return verdict;
    }
    verdict.leads = leads(scene, verdict.right, sample);
    return verdict;
}

}  // namespace strata::oracle::verdict
