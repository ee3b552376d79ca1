// tools/oracle/search/leads.cpp - finds rules that explain some of the wrong pixels (search.h).
#include <algorithm>

#include "tools/oracle/search/search.h"

namespace strata::oracle::verdict {

namespace {

// Which of the pixels have a value that the rules reach; `unchanged` is the result for pixels that the rules do not
// change. Empty if that exceeds the share of work of one rule.
std::vector<bool> reached(std::span<const SplitPixel* const> pixels, const Rules& rules, const Compositor& compositor,
                          const Setting& setting, bool unchanged) {
    StackMaker maker{setting, setting.work->share()};
    std::vector<bool> are_reached;
    for (const SplitPixel* pixel : pixels) {
        if (maker.steps().is_over()) return {};
        const StackedPixel made = stacked(rules, *pixel->sampled, maker);
        are_reached.push_back(is_unchanged(made, *pixel) ? unchanged
                                                         : reaching(compositor, made, maker.steps()) != nullptr);
    }
    return are_reached;
}

// Selects leads greedily: each explains the most pixels that the leads before it do not, minus a quarter of the right
// pixels that contradict it.
std::vector<Lead> leads_of(const std::vector<Rules>& all, const SplitSample& parts, const Hypothesis& hypothesis,
                           const Setting& setting) {
    constexpr std::size_t most_leads = 6, most_looked_at = 128, least_share = 20;  // a twentieth
    const Compositor compositor{hypothesis};
    const auto wrong = thinned(parts.wrong, most_looked_at), right = thinned(parts.right, most_looked_at);
    std::vector<Lead> leads(all.size());
    std::vector<std::vector<bool>> explained(all.size());
    setting.work->for_each(all.size(), [&](std::size_t i) {
        explained[i] = reached(wrong, all[i], compositor, setting, false);
        const auto holds = static_cast<std::uint64_t>(std::ranges::count(explained[i], true));
        leads[i] = {.rules = all[i], .explained = holds, .of = wrong.size(), .right = right.size()};
        if (holds == 0) return;
        const std::vector<bool> are_right = reached(right, all[i], compositor, setting, true);
        leads[i].contradicted = static_cast<std::uint64_t>(std::ranges::count(are_right, false));
        if (are_right.size() != right.size()) explained[i].clear();
    });
    std::vector<bool> is_reported(wrong.size());
    std::vector<Lead> best;
    while (best.size() < most_leads) {
        std::ptrdiff_t most = 0;
        std::size_t next = all.size();
        for (std::size_t i = 0; i < all.size(); ++i) {
            // A contradiction counts only a quarter, because a port may make the mistake only at pixels that no rule
            // describes.
            std::ptrdiff_t gain = -static_cast<std::ptrdiff_t>(leads[i].contradicted / 4);
            for (std::size_t p = 0; p < explained[i].size(); ++p) gain += explained[i][p] && !is_reported[p] ? 1 : 0;
            if (gain <= most) continue;
            most = gain;
            next = i;
        }
        if (next == all.size()) break;
        for (std::size_t p = 0; p < wrong.size(); ++p) is_reported[p] = is_reported[p] || explained[next][p];
        if (leads[next].explained * least_share >= leads[next].of) best.push_back(leads[next]);
    }
    return best;
}

}  // namespace

std::vector<Lead> MistakeSearch::leads() const {
    std::vector<Rule> rules = rules_;
    // With few bits and a rounding that is not known, each of these explains nearly any picture.
    std::erase_if(rules, [](const Rule& rule) { return rule.kind == RuleKind::few_bits; });
    return leads_of(singles(rules), parts_, closest_.account.hypothesis, scene_.setting());
}

}  // namespace strata::oracle::verdict
