// tools/oracle/program/fit/sample.cpp - chooses the sample, and scores changes on it (sample.h).
#include "tools/oracle/program/fit/sample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata::oracle::program {

namespace {

struct Seen {
    std::size_t pixel;
    Color color;
    double cost;
};

// About `most` of them, at even distances.
std::vector<Seen> thinned(const std::vector<Seen>& all, std::size_t most) {
    std::vector<Seen> some;
    const std::size_t count = std::min(most, all.size());
    for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
    return some;
}

}  // namespace

FitSample::FitSample(const Lists& lists, const Program& base, const PortRounding& rounding, const SampleSize& size)
    : base_{base}, unit_{lists.unit()} {
    choose(lists, rounding, size);
    // Right pixels first: a trial that breaks them is given up early.
    std::ranges::stable_sort(pixels_, {}, &SamplePixel::is_wrong);
    for (SamplePixel& p : pixels_) {
        p.first = fragments_;
        fragments_ += p.pixel->fragments.size();
        p.exact = value(base_, *p.pixel, {});
        p.exact_cost = cost_of(p.exact, *p.pixel, unit_);
        cost_ += p.weight * p.cost;
        wrong_ += p.is_wrong ? 1 : 0;
        for (const Edit& edit : base_.edits) select(edit, *p.pixel, p.masks.emplace_back());
    }
    double from_here = 0;
    for (auto p = pixels_.rbegin(); p != pixels_.rend(); ++p) p->cost_from_here = from_here += p->weight * p->cost;
    for (const FragmentProperty& property : properties()) {
        std::vector<double>& at_fragments = of_fragments_.emplace_back();
        std::vector<double>& at_pixels = of_pixels_.emplace_back();
        for (const SamplePixel& p : pixels_) {
            for (std::size_t k = 0; k < p.pixel->fragments.size(); ++k)
                at_fragments.push_back(property.of(*p.pixel, k));
            if (property.is_of_pixel) at_pixels.push_back(property.of(*p.pixel, 0));
        }
    }
}

void FitSample::choose(const Lists& lists, const PortRounding& rounding, const SampleSize& size) {
    std::array<std::vector<Seen>, 4> classes, tied;
    const std::array<std::size_t, 4> most{size.wrong, size.right, size.wrong_empty, size.right_empty};
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        const ListPixel& pixel = lists.pixels[i];
        const Color off = residual_of(base_, pixel, rounding, unit_).off;
        const bool is_wrong = std::ranges::any_of(off, [&](double r) { return std::fabs(r) > bound_at(pixel); });
        const std::size_t c = (is_wrong ? 0u : 1u) + (pixel.fragments.empty() ? 2u : 0u);
        (pixel.ties.empty() ? classes : tied)[c].push_back({i, value(base_, pixel, rounding), bits_of(off)});
    }
    if (tied[0].size() > classes[0].size())
        for (std::size_t c = 0; c < classes.size(); ++c)
            classes[c].insert(classes[c].end(), tied[c].begin(), tied[c].end());
    for (std::size_t c = 0; c < classes.size(); ++c) {
        const std::vector<Seen> some = thinned(classes[c], most[c]);
        for (const Seen& seen : some)
            pixels_.push_back({.pixel = &lists.pixels[seen.pixel],
                               .weight = static_cast<double>(classes[c].size()) / static_cast<double>(some.size()),
                               .is_wrong = c % 2 == 0,
                               .emulated = seen.color,
                               .cost = seen.cost});
    }
}

const std::vector<double>& FitSample::values(const FragmentProperty& property, PortStep step) const {
    const auto which = static_cast<std::size_t>(&property - properties().data());
    return step == PortStep::list ? of_fragments_[which] : of_pixels_[which];
}

std::pair<double, double> FitSample::depths() const {
    double nearest = 1, farthest = 0;
    for (const SamplePixel& p : pixels_)
        for (const ListFragment& f : p.pixel->fragments) {
            nearest = std::min(nearest, f.depth);
            farthest = std::max(farthest, f.depth);
        }
    return {nearest, farthest};
}

std::span<const char> FitSample::mask_at(std::size_t i, const StepEntry& entry, std::span<const char> all) const {
    if (entry.step != PortStep::list) return all.subspan(i, 1);
    return all.subspan(pixels_[i].first, pixels_[i].pixel->fragments.size());
}

Color FitSample::exact(const SamplePixel& p, const StepEntry& entry, Parameters parameters,
                       std::span<const char> mask) const {
    return colored(p, {&entry, parameters, mask}, {});
}

Color FitSample::colored(const SamplePixel& p, const Applied& edit, const PortRounding& rounding) const {
    thread_local std::vector<Applied> edits;
    edits.clear();
    for (std::size_t e = 0; e < base_.edits.size(); ++e)
        edits.push_back({base_.edits[e].entry, base_.edits[e].parameters, p.masks[e]});
    edits.push_back(edit);
    return run(edits, *p.pixel, rounding);
}

Score FitSample::score(const StepEntry& entry, Parameters parameters, std::span<const char> mask,
                       const WantedScore& wanted) const {
    const bool changes_much = 6 * std::ranges::count(mask, 1) > std::ssize(mask);
    double by_difference = 0, by_exact = changes_much ? 0 : std::numeric_limits<double>::infinity(), saved = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const SamplePixel& p = pixels_[i];
        if (std::min(by_difference, by_exact) > wanted.bits && saved + p.cost_from_here < wanted.saved) break;
        const std::span<const char> own = mask_at(i, entry, mask);
        if (std::ranges::find(own, 1) == own.end()) {
            by_difference += p.weight * p.cost;
            by_exact += p.weight * p.exact_cost;
            continue;
        }
        const Color trial = exact(p, entry, parameters, own);
        Color moved{};
        for (std::size_t c = 0; c < 3; ++c) moved[c] = p.emulated[c] + (trial[c] - p.exact[c]);
        const double of_moved = cost_of(moved, *p.pixel, unit_);
        const double of_trial = changes_much ? cost_of(trial, *p.pixel, unit_) : of_moved;
        by_difference += p.weight * of_moved;
        by_exact += p.weight * of_trial;
        saved += p.weight * std::max(p.cost - std::min(of_moved, of_trial), 0.0);
    }
    return {std::min(by_difference, by_exact), saved};
}

Score FitSample::score(const Edit& edit) const {
    return score(*edit.entry, edit.parameters, mask(*edit.entry, edit.conditions));
}

Emulation FitSample::emulation(const PortRounding& rounding) const {
    Emulation made{.rounding = rounding};
    thread_local std::vector<Applied> edits;
    for (const SamplePixel& p : pixels_) {
        edits.clear();
        for (std::size_t e = 0; e < base_.edits.size(); ++e)
            edits.push_back({base_.edits[e].entry, base_.edits[e].parameters, p.masks[e]});
        made.base.push_back(p.weight * cost_of(run(edits, *p.pixel, rounding), *p.pixel, unit_));
    }
    return made;
}

double FitSample::emulated(const Edit& edit, const Emulation& emulation) const {
    const std::vector<char> all = mask(*edit.entry, edit.conditions);
    double bits = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const std::span<const char> own = mask_at(i, *edit.entry, all);
        const SamplePixel& p = pixels_[i];
        bits += std::ranges::find(own, 1) == own.end()
                    ? emulation.base[i]
                    : p.weight *
                          cost_of(colored(p, {edit.entry, edit.parameters, own}, emulation.rounding), *p.pixel, unit_);
    }
    return bits;
}

std::vector<char> FitSample::mask(const StepEntry& entry, std::span<const Condition> conditions) const {
    std::vector<char> made(entry.step == PortStep::list ? fragments_ : pixels_.size(), 1);
    for (const Condition& condition : conditions) {
        const std::vector<double>& all = values(*condition.property, entry.step);
        for (std::size_t i = 0; i < made.size(); ++i)
            if (!condition.holds(all[i])) made[i] = 0;
    }
    return made;
}

}  // namespace strata::oracle::program
