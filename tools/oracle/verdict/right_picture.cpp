// tools/oracle/verdict/right_picture.cpp - decides whether a picture that a hypothesis reaches everywhere is right:
// tries mistakes that explain it in fewer bits, rounding, and alpha (right_picture.h).
#include "tools/oracle/verdict/right_picture.h"

#include <algorithm>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/rounding/doubt.h"
#include "tools/oracle/search/search.h"

namespace strata::oracle::verdict {

Choices choices(const Colors& candidate) {
    const std::vector<double> fine{0, 0x1p-20}, coarse{0x1p-17, 0x1p-14, 0x1p-11, 0x1p-9};
    const auto with = [&](const std::vector<double>& slacks, Looseness looseness) {
        return families(storage_of(candidate.code()), slacks, looseness, candidate.use().is_divided);
    };
    return {with(fine, Looseness::definite), with(coarse, Looseness::definite), with(coarse, Looseness::loose)};
}

bool leaves_little_open(const CheckedAccount& right) {
    const bool is_in_codes = has_codes(right.account.hypothesis.result.storage);
    if (!is_in_codes && right.bits <= 4 * static_cast<double>(right.covered)) return true;
    return right.possible <= 1 || (is_in_codes && right.observed <= 1);
}

namespace {

// The rules that also reach every pixel of the sample.
std::vector<Rule> alike_in(const Sample& sample, const std::vector<Rule>& rules, const Hypothesis& hypothesis) {
    std::vector<std::uint8_t> is_alike(rules.size(), 1);
    parallel_for(rules.size(), 0, [&](std::size_t i) {
        const Compositor compositor{hypothesis};
        StackMaker maker{sample.setting()};
        for (const SampledPixel& pixel : sample.pixels())
            if (matching_ties(compositor, {&rules[i], 1}, pixel.list, pixel.value, maker).mask == 0) {
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

// The pixels with the most layers, which contain the most information.
Sample deepest(const Sample& sample, std::size_t most) {
    std::vector<const SampledPixel*> deep;
    for (const SampledPixel& pixel : sample.pixels()) deep.push_back(&pixel);
    std::ranges::stable_sort(deep, std::ranges::greater{},
                             [](const SampledPixel* p) { return p->list.visible.size(); });
    Sample some{sample.setting()};
    for (std::size_t i = 0; i < std::min(most, deep.size()); ++i) some.add(deep[i]->list, deep[i]->value);
    some.sort();
    return some;
}

// True if the intervals are at most two codes wide, as after another order of the same blends.
bool is_narrow(const CheckedAccount& right) {
    return has_codes(right.account.hypothesis.result.storage) && right.possible <= 2;
}

// Finds mistakes that explain the picture in fewer bits than a right account with wide intervals. If there are any,
// fitting these intervals is no evidence that the picture is right.
std::vector<CheckedAccount> told_better(const SceneFragments& scene, const Colors& candidate, const Choices& all,
                                        const CheckedAccount& right, const Sample& even) {
    // Another order of the same blends can change a value by two codes. Intervals so narrow fit few mistakes, and few
    // pixels and hypotheses are enough to find these.
    const bool is_few = is_narrow(right);
    const std::size_t most = is_few ? 128 : 512, most_structures = is_few ? 512 : 4096;
    AgainstRight against{.bits = right.bits};
    if (is_few) against.most_rejected = 3;
    constexpr double share = 0.95, least_bits = 64;
    if (leaves_little_open(right)) return {};
    const Sample deep = deepest(even, most).with_few_structures(most_structures);
    const Families narrow = narrower(all.definite, right.account.hypothesis, deep);
    std::vector<CheckedAccount> better = search_all(scene, candidate, narrow, deep, against);
    std::erase_if(better, [&](const CheckedAccount& c) { return c.bits + least_bits > share * right.bits; });
    return better;
}

// Mistakes that explain, without another rasterizer, what the right structure explains with one alone.
std::vector<CheckedAccount> told_without_edges(const SceneFragments& scene, const Colors& candidate,
                                               const Families& definite, const CheckedAccount& right,
                                               const Sample& even) {
    constexpr std::uint64_t fewest = 8;
    constexpr std::size_t most = 48, most_structures = 512;
    if (right.at_edges < fewest) return {};
    Sample excused{scene.setting()};
    static_cast<void>(check_all(scene, candidate, right.account, WrongPixels::some, excused));
    Sample some = excused.thinned(most).with_few_structures(most_structures);
    const Sample others = deepest(even, most).with_few_structures(most_structures);
    for (const SampledPixel& pixel : others.pixels())
        if (!some.has(pixel.list.x, pixel.list.y)) some.add(pixel.list, pixel.value);
    some.sort();
    std::vector<CheckedAccount> better = search_all(scene, candidate, definite, some, {.bits = right.bits});
    std::erase_if(better, [&](const CheckedAccount& c) {
        return 4 * c.at_edges > right.at_edges || c.bits >= right.bits || c.needing_many > right.needing_many;
    });
    return better;
}

}  // namespace

Verdict RightPicture::decide(Verdict verdict, CheckedAccount&& right, const Sample& even) const {
    WorkCounter& work = *scene_.setting().work;
    verdict.right = std::move(right);
    work.allow(of_edges_);
    verdict.explanations = told_without_edges(scene_, candidate_, all_.definite, verdict.right, even);
    work.restart();
    if (!verdict.explanations.empty()) return verdict;
    verdict.doubt = doubt_of(scene_, candidate_, verdict.right, all_.definite);
    work.begin_stage(0.5, 0.6);
    work.allow(narrower_);
    verdict.explanations = told_better(scene_, candidate_, all_, verdict.right, even);
    verdict.is_stopped = work.is_cut_short();
    work.restart();
    if (!verdict.explanations.empty()) return verdict;
    if (verdict.is_stopped && verdict.doubt.empty())
        verdict.doubt = "a right port may produce every pixel, but not all mistakes were tried";
    find_alike(scene_, candidate_, verdict);
    verdict.alpha = check_alpha(scene_, candidate_, verdict.right.account.hypothesis);
    verdict.is_right = verdict.doubt.empty() && verdict.alpha.state != AlphaState::wrong;
    return verdict;
}

}  // namespace strata::oracle::verdict
