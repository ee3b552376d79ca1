#include "tools/oracle/verdict/search.h"

#include <algorithm>
#include <limits>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

namespace {

struct PartedPixel {
    const SampledPixel* sampled = nullptr;
    StackedPixel right{};  // by the right structure
};

// The sample's pixels apart: those that the closest account of the right structure calls wrong, and the others.
struct Parted {
    std::vector<PartedPixel> wrong{}, right{};
};

Parted parted(const Sample& sample, const Hypothesis& closest) {
    const Compositor compositor{closest};
    StackMaker maker{sample.setting()};
    Parted parts;
    for (const SampledPixel& pixel : sample.pixels()) {
        PartedPixel made{&pixel, stacked({}, pixel, maker)};
        (reaching(compositor, made.right) == nullptr ? parts.wrong : parts.right).push_back(std::move(made));
    }
    return parts;
}

using Rules = std::vector<Rule>;

// Whether a pixel's structures are the right ones; the division of a peel from both ends aside.
bool is_unchanged(const StackedPixel& made, const PartedPixel& pixel) {
    return std::ranges::equal(made.stacks, pixel.right.stacks, [](const Stack& a, const Stack& b) {
        return a.layers == b.layers && a.background == b.background && a.is_linear == b.is_linear;
    });
}

// Whether one of the hypotheses holds for all pixels under the rules. Right pixels that the rules leave alone are right under them, too.
bool survives(const Rules& rules, const Parted& parts, const std::vector<Compositor>& wide, const Setting& setting) {
    StackMaker maker{setting};
    std::vector<const Compositor*> left;
    for (const Compositor& compositor : wide) left.push_back(&compositor);
    for (const auto* pixels : {&parts.wrong, &parts.right})
        for (const PartedPixel& pixel : *pixels) {
            const StackedPixel made = stacked(rules, *pixel.sampled, maker);
            if (pixels == &parts.right && is_unchanged(made, pixel)) continue;
            std::erase_if(left, [&](const Compositor* c) { return reaching(*c, made) == nullptr; });
            if (left.empty()) return false;
        }
    return true;
}

std::vector<Rules> survivors(const std::vector<Rules>& all, const Parted& parts, const std::vector<Hypothesis>& wide,
                             const Setting& setting) {
    const std::vector<Compositor> compositors(wide.begin(), wide.end());
    std::vector<std::uint8_t> lives(all.size());
    parallel_for(all.size(), 0,
                 [&](std::size_t i) { lives[i] = survives(all[i], parts, compositors, setting) ? 1 : 0; });
    std::vector<Rules> left;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (lives[i] != 0) left.push_back(all[i]);
    return left;
}

// Two of them, of different kinds, in the order in which they are applied. A rule is worth a partner if it explains some wrong pixel or leaves
// one so that another one may: that is, if it changes one.
std::vector<Rules> pairs_of(const std::vector<Rule>& rules, const Parted& parts, const Setting& setting) {
    StackMaker maker{setting};
    constexpr std::size_t most_looked_at = 64;
    std::vector<Rule> worth;
    for (const Rule& rule : rules) {
        const auto changes = [&](const PartedPixel& pixel) {
            return !is_unchanged(stacked({&rule, 1}, *pixel.sampled, maker), pixel);
        };
        const auto some = std::span{parts.wrong}.first(std::min(parts.wrong.size(), most_looked_at));
        if (std::ranges::any_of(some, changes)) worth.push_back(rule);
    }
    std::vector<Rules> pairs;
    for (const Rule& a : worth)
        for (const Rule& b : worth) {
            const int first = stage_of(a.kind), second = stage_of(b.kind);
            if (a.kind != b.kind && (first < second || (first == second && a.kind < b.kind))) pairs.push_back({a, b});
        }
    return pairs;
}

double bits_of(const Checked& checked) {
    const Pricing pricing{checked.account.hypothesis.result.storage};
    return bits_of(checked.account.hypothesis) + checked.bits +
           static_cast<double>(checked.wrong_pixels.size()) * pricing.of_wrong();
}

// The hypotheses that hold for nearly all pixels that are right, and leave there no more open than it costs to call the others wrong: what makes
// these wrong is no rounding.
Families possible(const Families& all, const Parted& parts, const Hypothesis& closest) {
    const Pricing pricing{closest.result.storage};
    std::vector<const PartedPixel*> pixels;
    for (const PartedPixel& pixel : parts.right) pixels.push_back(&pixel);
    const std::size_t most_missed = pixels.size() / 50;
    double most_bits = std::numeric_limits<double>::max();
    // Nothing if it is none of them.
    const auto bits_of_right = [&](const Hypothesis& h) -> std::optional<double> {
        const Compositor compositor{h};
        double bits = 0;
        std::size_t missed = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (const Stack* const stack = reaching(compositor, pixels[i]->right)) {
                bits += pricing.of(compositor.reach(*stack));
            } else {
                if (++missed > most_missed) return std::nullopt;
                std::swap(pixels[i], pixels[i / 2]);  // it may well tell against the next one, too
            }
            if (bits > most_bits) return std::nullopt;
        }
        return bits;
    };
    most_bits = bits_of_right(closest).value_or(0) + pricing.of_wrong() * static_cast<double>(parts.wrong.size());
    Families left;
    for (const HypothesisFamily& family : all) {
        HypothesisFamily own{.widest = family.widest};
        for (const Hypothesis& h : family.members)
            if (bits_of_right(h)) own.members.push_back(h);
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

// Of these, those that hold for some of the wrong pixels under the rules.
Families possible(const Families& all, const Rules& rules, const Parted& parts, const Setting& setting) {
    constexpr std::size_t most_looked_at = 8;
    StackMaker maker{setting};
    std::vector<StackedPixel> pixels;
    const std::size_t step = parts.wrong.size() / most_looked_at + 1;
    for (std::size_t i = 0; i < parts.wrong.size(); i += step)
        pixels.push_back(stacked(rules, *parts.wrong[i].sampled, maker));
    Families left;
    for (const HypothesisFamily& family : all) {
        HypothesisFamily own{.widest = family.widest};
        std::ranges::copy_if(family.members, std::back_inserter(own.members), [&](const Hypothesis& h) {
            const Compositor compositor{h};
            return std::ranges::all_of(pixels,
                                       [&](const StackedPixel& p) { return reaching(compositor, p) != nullptr; });
        });
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

// Those of the accounts that hold for the whole picture; of one kind of rules with other numbers the first tells enough.
std::vector<Checked> whole(const std::vector<Rules>& all, const SceneFragments& scene, const Colors& candidate,
                           const Families& definite, const Checked& closest, const Parted& parts,
                           const Sample& sample) {
    constexpr std::size_t most_told = 12;
    const auto is_alike = [](const Rules& a, const Rules& b) {
        return std::ranges::equal(a, b,
                                  [](const Rule& x, const Rule& y) { return x.kind == y.kind && x.scope == y.scope; });
    };
    std::vector<Checked> found;
    for (const Rules& rules : all) {
        if (found.size() == most_told) break;
        if (std::ranges::any_of(found, [&](const Checked& c) { return is_alike(c.account.rules, rules); })) continue;
        const Families own_families = possible(definite, rules, parts, scene.setting());
        if (own_families.empty()) continue;
        Sample own = sample;
        const Hypothesis& likely = (found.empty() ? closest : found.back()).account.hypothesis;
        auto one = account_for(own_families, rules, scene, candidate, own, likely);
        // A rule that changes nothing that tells is no explanation.
        if (one && one->changed > one->undecided) found.push_back(*std::move(one));
    }
    return found;
}

// What leaves much more open than the best one has only room for the picture.
void drop_roomy(std::vector<Checked>& found, const Checked& closest) {
    std::ranges::stable_sort(found, {}, [](const Checked& c) { return bits_of(c); });
    if (found.empty()) return;
    const double most = std::min(1.05 * bits_of(found[0]) + 64, bits_of(closest));
    std::erase_if(found, [&](const Checked& c) { return bits_of(c) > most; });
}

// How many of the pixels the rules do not reach; `unchanged`: of those that they leave alone.
enum class Unchanged : std::uint8_t { missed, reached };
std::size_t missed(const std::vector<PartedPixel>& pixels, const Rules& rules, const Compositor& compositor,
                   const Setting& setting, Unchanged unchanged) {
    StackMaker maker{setting};
    return static_cast<std::size_t>(std::ranges::count_if(pixels, [&](const PartedPixel& pixel) {
        const StackedPixel made = stacked(rules, *pixel.sampled, maker);
        if (is_unchanged(made, pixel)) return unchanged == Unchanged::missed;
        return reaching(compositor, made) == nullptr;
    }));
}

std::vector<Lead> leads_of(const std::vector<Rules>& all, const Parted& parts, const Hypothesis& hypothesis,
                           const Setting& setting) {
    constexpr std::size_t most_leads = 5;
    const Compositor compositor{hypothesis};
    std::vector<Lead> leads(all.size());
    parallel_for(all.size(), 0, [&](std::size_t i) {
        Lead& lead = leads[i];
        lead = {.rules = all[i], .of = parts.wrong.size(), .right = parts.right.size()};
        lead.explained = lead.of - missed(parts.wrong, all[i], compositor, setting, Unchanged::missed);
        lead.contradicted = missed(parts.right, all[i], compositor, setting, Unchanged::reached);
    });
    std::erase_if(leads, [](const Lead& l) { return l.explained == 0 || l.contradicted >= l.explained; });
    std::ranges::stable_sort(leads, std::ranges::greater{}, [](const Lead& l) { return l.explained - l.contradicted; });
    std::vector<Lead> best;
    for (const Lead& lead : leads) {
        const bool is_there = std::ranges::any_of(best, [&](const Lead& b) {
            return b.rules[0].kind == lead.rules[0].kind && b.rules[0].scope == lead.rules[0].scope;
        });
        if (!is_there && best.size() < most_leads) best.push_back(lead);
    }
    return best;
}

}  // namespace

namespace {

std::vector<Rules> singles(const std::vector<Rule>& rules) {
    std::vector<Rules> all;
    for (const Rule& rule : rules) all.push_back({rule});
    return all;
}

}  // namespace

std::vector<Checked> search(const SceneFragments& scene, const Colors& candidate, const Families& definite,
                            const Checked& closest, const Sample& sample, int most_rules) {
    constexpr std::size_t least_of_pairs = 8;  // wrong pixels: fewer tell nothing of two mistakes
    const std::vector<Rule> rules = rules_for(facts_of(scene, sample));
    const Parted parts = parted(sample, closest.account.hypothesis);
    if (most_rules > 1 && parts.wrong.size() < least_of_pairs) return {};
    const std::vector<Rules> all = most_rules > 1 ? pairs_of(rules, parts, scene.setting()) : singles(rules);
    const Families left = possible(definite, parts, closest.account.hypothesis);
    std::vector<Checked> found =
        whole(survivors(all, parts, widest(left), scene.setting()), scene, candidate, left, closest, parts, sample);
    drop_roomy(found, closest);
    return found;
}

std::vector<Lead> leads(const SceneFragments& scene, const Checked& closest, const Sample& sample) {
    const Hypothesis& hypothesis = closest.account.hypothesis;
    return leads_of(singles(rules_for(facts_of(scene, sample))), parted(sample, hypothesis), hypothesis,
                    scene.setting());
}

}  // namespace strata::oracle::verdict
