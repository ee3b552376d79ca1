// tools/oracle/search/search.cpp - finds rules that explain every pixel. A rule is rejected as early as possible: first
// by the widest hypotheses on a sample (survivors), then by its order among the rest (by_explained), then by the whole
// picture under hypotheses that the right pixels allow (whole), last by its bits (explains, drop_roomy).
#include "tools/oracle/search/search.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "tools/oracle/rounding/pricing.h"

namespace strata::oracle::verdict {

namespace {

// True if one of the hypotheses holds for all pixels under the rules; for codes, most pixels must not need another
// rasterizer. Right pixels that the rules do not change remain right.
bool survives(const Rules& rules, const SplitSample& parts, const std::vector<Compositor>& wide, bool is_noted,
              const Setting& setting) {
    using Reached = SplitPixel::Reached;
    struct Left {
        std::size_t number = 0;  // index in `wide`
        std::size_t at_edges = 0;
    };
    StackMaker maker{setting, setting.work->share()};
    std::vector<Left> left;
    for (std::size_t i = 0; i < wide.size(); ++i) left.push_back({i});
    if (wide.empty()) return false;
    const bool has_codes = verdict::has_codes(wide[0].hypothesis().result.storage);
    const std::size_t all = parts.wrong.size() + parts.right.size(), most_at_edges = has_codes ? all / 3 : all;
    // Limit of wrong pixels that the rules do not change: those would be due to the hypothesis.
    std::size_t may_stay = parts.wrong.size() * 3 / 4;
    for (const auto* pixels : {&parts.wrong, &parts.right})
        for (const SplitPixel& pixel : *pixels) {
            const StackedPixel made = stacked(rules, *pixel.sampled, maker);
            if (maker.steps().is_over()) return false;
            const bool stays = is_unchanged(made, pixel);
            if (pixels == &parts.right && stays) continue;
            if (stays && !parts.has_no_account && may_stay-- == 0) return false;
            const bool is_known = is_noted && stays && !pixel.reached.empty() && made.stacks == pixel.right.stacks;
            std::erase_if(left, [&](Left& l) {
                const Reached how =
                    is_known ? pixel.reached[l.number] : how_reached(wide[l.number], made, maker.steps());
                l.at_edges += how == Reached::at_edge ? 1 : 0;
                return how == Reached::no || l.at_edges > most_at_edges;
            });
            if (left.empty()) return false;
        }
    return true;
}

std::vector<Rules> survivors(const std::vector<Rules>& all, const SplitSample& parts,
                             const std::vector<Hypothesis>& wide, const Setting& setting) {
    const std::vector<Compositor> compositors(wide.begin(), wide.end());
    const bool is_noted = parts.noted == wide;
    std::vector<std::uint8_t> lives(all.size());
    setting.work->for_each(
        all.size(), [&](std::size_t i) { lives[i] = survives(all[i], parts, compositors, is_noted, setting) ? 1 : 0; });
    std::vector<Rules> left;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (lives[i] != 0) left.push_back(all[i]);
    return left;
}

double bits_of(const CheckedAccount& checked) {
    const Pricing pricing{checked.account.hypothesis.result.storage};
    return bits_of(checked.account.hypothesis) + checked.bits +
           static_cast<double>(checked.wrong_pixels.size()) * pricing.of_wrong();
}

// The hypotheses that hold for nearly all right pixels, and whose intervals there cost at most as much as calling the
// wrong pixels wrong: rounding does not explain these.
Families possible(const Families& all, const SplitSample& parts, const Hypothesis& closest, const Setting& setting) {
    const Pricing pricing{closest.result.storage};
    constexpr std::size_t most_looked_at = 300, few = 4, most_structures = 2048;
    std::vector<const SplitPixel*> pixels = thinned(parts.right, most_looked_at);
    std::size_t structures = 0;  // ties and edges make many structures, each tried with every hypothesis
    std::erase_if(pixels, [&](const SplitPixel* pixel) {
        const std::size_t own = pixel->right.stacks.size();
        if (own > few && structures + own > most_structures) return true;
        structures += own;
        return false;
    });
    std::vector<AskedPixel> asked;
    for (const SplitPixel* pixel : pixels) asked.emplace_back(pixel->right);
    const std::size_t most_missed = pixels.size() / 50;
    double most_bits = std::numeric_limits<double>::max();
    Steps steps{*setting.work};
    // The cost of the right pixels; empty if too many are not reached.
    const auto bits_of_right = [&](const Hypothesis& h) -> std::optional<double> {
        const Compositor compositor{h};
        double bits = 0;
        std::size_t missed = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const ReachedStack found = asked[i].reached(compositor, steps);
            if (found.stack != nullptr) {
                bits += pricing.of(found.reach);
            } else {
                if (++missed > most_missed) return std::nullopt;
                std::swap(asked[i], asked[i / 2]);  // it is likely to reject the next hypothesis, too
            }
            if (bits > most_bits) return std::nullopt;
        }
        return bits;
    };
    const auto missed_by = [&](const Hypothesis& h) {
        const Compositor compositor{h};
        std::size_t missed = 0;
        for (std::size_t i = 0; i < pixels.size() && missed <= most_missed; ++i) {
            if (asked[i].narrowed(compositor, steps).stack != nullptr) continue;
            ++missed;
            std::swap(asked[i], asked[i / 2]);
        }
        return missed;
    };
    const double share = static_cast<double>(pixels.size()) / std::max(1.0, static_cast<double>(parts.right.size()));
    most_bits =
        bits_of_right(closest).value_or(0) + share * pricing.of_wrong() * static_cast<double>(parts.wrong.size());
    Families left;
    for (const HypothesisFamily& family : all) {
        HypothesisFamily own{.widest = family.widest};
        if (steps.is_spent()) break;
        if (missed_by(family.widest) > most_missed) continue;
        for (const Hypothesis& h : family.members)
            if (bits_of_right(h)) own.members.push_back(h);
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

// Few bits and a rounding that leaves more than one value to each blend would explain any value.
bool keeps_few_bits(const Hypothesis& h) {
    return h.front.rounding == Rounding::nearest || h.front.rounding == Rounding::truncated;
}

// Of these hypotheses, those that reach each of a few wrong pixels under the rules.
Families possible(const Families& all, const Rules& rules, const SplitSample& parts, const Setting& setting) {
    constexpr std::size_t most_looked_at = 8;
    const bool has_few_bits = std::ranges::find(rules, RuleKind::few_bits, &Rule::kind) != rules.end();
    StackMaker maker{setting};
    std::vector<StackedPixel> pixels;
    const std::size_t step = parts.wrong.size() / most_looked_at + 1;
    for (std::size_t i = 0; i < parts.wrong.size(); i += step)
        pixels.push_back(stacked(rules, *parts.wrong[i].sampled, maker));
    const auto is_held = [&](const Hypothesis& h) {
        const Compositor compositor{h};
        return std::ranges::all_of(
            pixels, [&](const StackedPixel& p) { return reaching(compositor, p, maker.steps()) != nullptr; });
    };
    Families left;
    for (const HypothesisFamily& family : all) {
        HypothesisFamily own{.widest = family.widest};
        if (maker.steps().is_spent()) break;
        if (!is_held(family.widest)) continue;
        std::ranges::copy_if(family.members, std::back_inserter(own.members),
                             [&](const Hypothesis& h) { return (!has_few_bits || keeps_few_bits(h)) && is_held(h); });
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

// Sorts by the number of wrong pixels explained under the closest hypothesis, because checking the whole picture is
// expensive.
std::vector<Rules> by_explained(const std::vector<Rules>& all, const SplitSample& parts, const Hypothesis& closest,
                                const Setting& setting) {
    constexpr std::size_t most_looked_at = 96;
    const Compositor compositor{closest};
    auto wrong = thinned(parts.wrong, most_looked_at);
    // A pixel that needs another rasterizer may be a mistake as well.
    Steps steps{*setting.work};
    for (const SplitPixel* pixel : thinned(parts.right, 4 * most_looked_at)) {
        const Stack* const found = reaching(compositor, pixel->right, steps);
        if (found != nullptr && !is_as_given(pixel->right, *found)) wrong.push_back(pixel);
    }
    std::vector<std::pair<std::size_t, std::size_t>> explained(all.size());  // number of pixels, and index in `all`
    for (std::size_t i = 0; i < all.size(); ++i) explained[i].second = i;
    setting.work->for_each(all.size(), [&](std::size_t i) {
        StackMaker maker{setting, setting.work->share()};
        for (const SplitPixel* pixel : wrong) {
            if (maker.steps().is_over()) break;
            const StackedPixel made = stacked(all[i], *pixel->sampled, maker);
            const Stack* const found = reaching(compositor, made, maker.steps());
            explained[i].first += found != nullptr && is_as_given(made, *found) ? 1 : 0;
        }
    });
    std::ranges::stable_sort(explained, std::ranges::greater{}, &std::pair<std::size_t, std::size_t>::first);
    std::vector<Rules> sorted;
    for (const auto& [count, i] : explained) sorted.push_back(all[i]);
    return sorted;
}

// The limit of an account's bits, above which it would fit anything. For codes, nine per changed pixel and one per
// pixel; for floats, whose blends are inexact everywhere, a third of all digits.
double most_open(const CheckedAccount& account) {
    constexpr double of_changed = 9, of_edge = 6, share_of_digits = 1.0 / 3;
    const Storage storage = account.account.hypothesis.result.storage;
    const auto pixels = static_cast<double>(account.pixels),
               edges = of_edge * static_cast<double>(account.rasterized_otherwise());
    if (!has_codes(storage)) return share_of_digits * Pricing{storage}.digits() * 3 * pixels + edges;
    return of_changed * static_cast<double>(account.changed) + pixels + edges;
}

// True if the account needs less than half of the bits of the right structure's account, and many pixels contradict the
// right structure under its hypothesis.
bool is_much_closer(const CheckedAccount& account, double right_bits) {
    constexpr std::uint64_t many = 64;
    const std::uint64_t decided = account.changed - account.undecided;
    return 2 * account.bits < right_bits && decided >= many && 10 * account.undecided <= account.changed;
}

// An explanation must change several pixels that the right structure does not reach: among so many rules, some fit a
// few pixels by chance.
bool decides(const CheckedAccount& account) {
    constexpr std::uint64_t least_decided = 4;
    return account.changed - account.undecided >= least_decided;
}
bool explains(const CheckedAccount& account) { return decides(account) && account.bits <= most_open(account); }

// The accounts that hold for the whole picture; of rules that differ only in their numbers, only the first.
std::vector<CheckedAccount> whole(const std::vector<Rules>& all, const SceneFragments& scene, const Colors& candidate,
                                  const Families& definite, const std::optional<Hypothesis>& closest,
                                  const SplitSample& parts, const Sample& sample, std::size_t most_tried,
                                  const AgainstRight& against = {}) {
    constexpr std::size_t most_told = 12, few_sampled = 400;
    std::size_t tried = 0;
    const auto is_alike = [](const Rules& a, const Rules& b) {
        return std::ranges::equal(a, b, [](const Rule& x, const Rule& y) {
            return x.kind == y.kind && x.scope == y.scope && x.kind != RuleKind::few_bits;
        });
    };
    std::vector<CheckedAccount> found;
    for (const Rules& rules : all) {
        if (found.size() == most_told || scene.setting().work->is_spent()) break;
        if (std::ranges::any_of(found, [&](const CheckedAccount& c) { return is_alike(c.account.rules, rules); }))
            continue;
        if (++tried > most_tried) break;
        const Families own_families = possible(definite, rules, parts, scene.setting());
        if (own_families.empty()) continue;
        Sample own = sample.thinned(few_sampled);
        const auto likely = found.empty() ? closest : found.back().account.hypothesis;
        auto one = account_for(own_families, rules, scene, candidate, own, likely, against.most_rejected);
        if (one && (explains(*one) || (decides(*one) && is_much_closer(*one, against.bits))))
            found.push_back(*std::move(one));
    }
    return found;
}

// Removes accounts that need much more bits than the best one.
void drop_roomy(std::vector<CheckedAccount>& found, double most_bits) {
    std::ranges::stable_sort(found, {}, [](const CheckedAccount& c) { return bits_of(c); });
    if (found.empty()) return;
    const double most = std::min(1.05 * bits_of(found[0]) + 64, most_bits);
    std::erase_if(found, [&](const CheckedAccount& c) { return bits_of(c) > most; });
}

}  // namespace

MistakeSearch::MistakeSearch(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& closest,
                             const Sample& sample)
    : scene_{scene},
      candidate_{candidate},
      closest_{closest},
      sample_{sample},
      parts_{split_by_account(sample, closest.account.hypothesis)},
      rules_{rules_for(facts_of(scene, sample))} {}

const Families& MistakeSearch::likely(const Families& definite) {
    if (likely_of_ != &definite) {
        likely_ = possible(definite, parts_, closest_.account.hypothesis, scene_.setting());
        likely_of_ = &definite;
    }
    return likely_;
}

std::vector<CheckedAccount> MistakeSearch::found(const Families& definite, const RuleRegion& region) {
    // Limits of the accounts that are tried on the whole picture: counts instead of times, so that the result is the
    // same on every machine.
    constexpr std::size_t most_tried = 24, most_tried_again = 12;
    const Setting& setting = scene_.setting();
    const Hypothesis& hypothesis = closest_.account.hypothesis;
    std::vector<Rule> rules = rules_;
    for (Rule& rule : rules) rule.region = region;
    if (setting.work->is_spent()) return {};
    const std::vector<Rules> all = singles(rules);
    const auto left_under = [&](const std::vector<Hypothesis>& wide) {
        if (parts_.noted != wide) note(parts_, wide, setting);
        return by_explained(survivors(all, parts_, wide, setting), parts_, hypothesis, setting);
    };
    // First uses the hypotheses that hold for the right pixels. If the mistake affects all pixels, these are not right
    // under the true hypothesis, so all are tried afterwards.
    const Families& first = likely(definite);
    const std::vector<Hypothesis> wide = widest(first);
    const std::vector<Rules> left = left_under(wide);
    std::vector<CheckedAccount> accounts =
        whole(left, scene_, candidate_, first, hypothesis, parts_, sample_, most_tried);
    if (accounts.empty() && !setting.work->is_spent()) {
        const std::vector<Hypothesis> wider = widest(definite);
        accounts = whole(wider == wide ? left : left_under(wider), scene_, candidate_, definite, hypothesis, parts_,
                         sample_, most_tried_again);
    }
    drop_roomy(accounts, bits_of(closest_));
    return accounts;
}

std::optional<CheckedAccount> explained_by(const std::vector<Rule>& rules, const SceneFragments& scene,
                                           const Colors& candidate, const Families& definite, const Sample& sample) {
    Families own = definite;
    if (std::ranges::find(rules, RuleKind::few_bits, &Rule::kind) != rules.end())
        for (HypothesisFamily& family : own)
            std::erase_if(family.members, [](const Hypothesis& h) { return !keeps_few_bits(h); });
    Sample some = sample;
    auto one = account_for(own, rules, scene, candidate, some);
    if (one && !explains(*one)) one.reset();
    return one;
}

namespace {

// Sorts the pixels with the most information first: those with one structure, and of these the ones that the fewest
// hypotheses reach.
void put_telling_first(SplitSample& parts) {
    std::ranges::stable_sort(parts.wrong, {}, [](const SplitPixel& pixel) {
        const PixelList& list = pixel.sampled->list;
        const auto missed = std::ranges::count(pixel.reached, SplitPixel::Reached::no);
        return std::tuple{list.edge != nullptr, verdict::has_ties(list.visible), -missed};
    });
}

}  // namespace

std::vector<CheckedAccount> search_all(const SceneFragments& scene, const Colors& candidate, const Families& narrow,
                                       const Sample& sample, const AgainstRight& against) {
    constexpr std::size_t most_tried = 8;  // each is checked with every hypothesis
    SplitSample parts{.has_no_account = true};
    StackMaker maker{scene.setting()};
    for (const SampledPixel& pixel : sample.pixels())
        parts.wrong.push_back({.sampled = &pixel, .right = stacked({}, pixel, maker)});
    std::vector<Hypothesis> each;
    for (const HypothesisFamily& family : narrow)
        std::ranges::copy_if(family.members, std::back_inserter(each),
                             [](const Hypothesis& h) { return h.slack == 0; });
    note(parts, each, scene.setting());
    put_telling_first(parts);
    if (scene.setting().work->is_spent()) return {};
    const std::vector<Rules> all = singles(rules_for(facts_of(scene, sample)));
    const std::vector<Rules> possible = survivors(all, parts, widest(narrow), scene.setting());
    const std::vector<Rules> left = survivors(possible, parts, each, scene.setting());
    if (left.empty()) return {};
    std::vector<CheckedAccount> found = whole(left, scene, candidate, narrow, {}, parts, sample, most_tried, against);
    drop_roomy(found, std::numeric_limits<double>::max());
    return found;
}

}  // namespace strata::oracle::verdict
