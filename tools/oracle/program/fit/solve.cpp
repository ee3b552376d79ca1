// tools/oracle/program/fit/solve.cpp - edits each fragment of the sample alone, and learns conditions (solve.h).
#include "tools/oracle/program/fit/solve.h"

#include <algorithm>
#include <cmath>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

std::vector<Variation> variations() {
    std::vector<Variation> all;
    for (const StepEntry* entry : entries()) {
        if (entry->parameters.empty() && entry->words.find("{}") == entry->words.npos) all.push_back({entry, {}});
        for (const double p : entry->parameters) all.push_back({entry, {p}});
    }
    return all;
}

namespace {

double largest(const Color& a, const Color& b, double unit) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])}) / unit;
}

void solve_pixel(const FitSample& sample, const SamplePixel& p, Solved& solved) {
    const std::size_t count = p.pixel->fragments.size();
    const double tolerance = 1.5 + 0.12 * static_cast<double>(count);
    std::vector<char> mask(count, 0);
    std::vector<std::size_t> hits, visible;
    for (std::size_t k = 0; k < count; ++k) {
        mask[k] = 1;
        const Color trial = sample.exact(p, *solved.variation.entry, solved.variation.parameters, mask);
        mask[k] = 0;
        if (largest(trial, p.exact, sample.unit()) <= tolerance + 1.5) continue;
        visible.push_back(p.first + k);
        Color moved{};
        for (std::size_t c = 0; c < 3; ++c) moved[c] = p.emulated[c] + (trial[c] - p.exact[c]);
        const Color off = residual(moved, *p.pixel, sample.unit());
        if (std::ranges::all_of(off, [&](double r) { return std::fabs(r) <= tolerance; })) hits.push_back(p.first + k);
    }
    if (!p.is_wrong) {
        solved.spared.insert(solved.spared.end(), visible.begin(), visible.end());
    } else if (hits.size() == 1) {
        solved.hits.push_back(hits[0]);
        for (const std::size_t k : visible)
            if (k != hits[0]) solved.spared.push_back(k);
    }
}

}  // namespace

std::vector<Solved> solve(const FitSample& sample) {
    std::vector<Solved> all;
    for (Variation& variation : variations()) {
        Solved& solved = all.emplace_back(Solved{.variation = std::move(variation)});
        if (solved.variation.entry->step != PortStep::list || solved.variation.entry->is_order) continue;
        for (const SamplePixel& p : sample.pixels()) solve_pixel(sample, p, solved);
    }
    return all;
}

std::vector<Condition> conditions_of(const FragmentProperty& property, std::vector<double> values) {
    constexpr std::size_t most = 24;
    std::ranges::sort(values);
    const std::size_t given = values.size();
    std::vector<double> distinct = values;
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<Condition> all;
    if (distinct.size() < 2) return all;
    using Is = Condition::Is;
    if (property.kind == FragmentProperty::Kind::flag) return {{&property, Is::equal, 1}, {&property, Is::equal, 0}};
    const bool is_integer = property.kind == FragmentProperty::Kind::integer;
    if (is_integer && distinct.size() <= most)
        for (const double v : distinct) all.push_back({&property, Is::equal, v});
    std::vector<double> ends;  // first values that are not below a threshold
    if (distinct.size() <= most) {
        ends.assign(distinct.begin() + 1, distinct.end());
    } else {
        for (std::size_t i = 1; i < most; ++i) ends.push_back(values[i * given / most]);
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    }
    for (const double end : ends) {
        const auto at = std::ranges::lower_bound(distinct, end);
        if (at == distinct.begin()) continue;
        const double before = *(at - 1);
        if (!std::isfinite(*at) || !std::isfinite(before)) continue;  // its rank says that there is none
        const double threshold = is_integer ? *at : (*at + before) / 2;
        all.push_back({&property, Is::below, threshold});
        all.push_back({&property, Is::at_least, threshold});
    }
    return all;
}

namespace {

double share_bits(std::size_t positive, std::size_t negative) {
    return std::log2((static_cast<double>(positive) + 0.01) / (static_cast<double>(positive + negative) + 0.01));
}

// The condition that is worth most: bits saved at the positive examples that it keeps.
Condition best_condition(const FitSample& sample, const std::vector<std::size_t>& positive,
                         const std::vector<std::size_t>& negative, double& gain) {
    Condition best{};
    const double before = share_bits(positive.size(), negative.size());
    for (const FragmentProperty& property : properties()) {
        const std::vector<double>& values = sample.values(property, PortStep::list);
        std::vector<double> here;
        for (const auto* examples : {&positive, &negative})
            for (const std::size_t k : *examples) here.push_back(values[k]);
        for (const Condition& condition : conditions_of(property, here)) {
            const auto holds = [&](std::size_t k) { return condition.holds(values[k]); };
            const auto p = static_cast<std::size_t>(std::ranges::count_if(positive, holds));
            const auto n = static_cast<std::size_t>(std::ranges::count_if(negative, holds));
            const double kept = static_cast<double>(p) / static_cast<double>(positive.size());
            const double found = static_cast<double>(p) * (share_bits(p, n) - before) * kept - 0.01 * property.price;
            if (p > 0 && found > gain) {
                gain = found;
                best = condition;
            }
        }
    }
    return best;
}

}  // namespace

std::vector<Condition> learn(const FitSample& sample, const Solved& solved) {
    std::vector<Condition> learnt;
    std::vector<std::size_t> positive = solved.hits, negative = solved.spared;
    while (learnt.size() < 3) {
        const double share =
            static_cast<double>(positive.size()) / static_cast<double>(positive.size() + negative.size());
        if (share >= 0.98) break;
        double gain = 0;
        const Condition condition = best_condition(sample, positive, negative, gain);
        if (condition.property == nullptr) break;
        learnt.push_back(condition);
        const std::vector<double>& values = sample.values(*condition.property, PortStep::list);
        const auto fails = [&](std::size_t k) { return !condition.holds(values[k]); };
        std::erase_if(positive, fails);
        std::erase_if(negative, fails);
    }
    return learnt;
}

}  // namespace strata::oracle::program
