// tools/oracle/program/fit/sample.cpp - chooses the sample, and scores changes on it (sample.h).
#include "tools/oracle/program/fit/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace strata::oracle::program {

namespace {

using Seen = PixelClasses::Seen;

// About `most` of them, at even distances.
std::vector<Seen> thinned(const std::vector<Seen>& all, std::size_t most) {
    std::vector<Seen> some;
    const std::size_t count = std::min(most, all.size());
    for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
    return some;
}

}  // namespace

PixelClasses::PixelClasses(const Lists& lists, const Program& base_program, const PortRounding& rounding)
    : base{base_program}, unit{lists.unit()} {
    std::array<std::vector<Seen>, 4> tied;
    for (const ListPixel& pixel : lists.pixels) {
        const Color color = value(base, pixel, rounding);
        const Color off =
            pixel.ties.empty() ? residual(color, pixel, unit) : residual_of(base, pixel, rounding, unit).off;
        const bool is_wrong = std::ranges::any_of(off, [&](double r) { return std::fabs(r) > bound_at(pixel); });
        const std::size_t c = (is_wrong ? 0u : 1u) + (pixel.fragments.empty() ? 2u : 0u);
        (pixel.ties.empty() ? all : tied)[c].push_back({&pixel, color, bits_of(off)});
    }
    if (tied[0].size() > all[0].size())
        for (std::size_t c = 0; c < all.size(); ++c) all[c].insert(all[c].end(), tied[c].begin(), tied[c].end());
}

FitSample::FitSample(const PixelClasses& classes, const SampleSize& size) : base_{classes.base}, unit_{classes.unit} {
    choose(classes, size);
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

void FitSample::choose(const PixelClasses& classes, const SampleSize& size) {
    const std::array<std::size_t, 4> most{size.wrong, size.right, size.wrong_empty, size.right_empty};
    for (std::size_t c = 0; c < most.size(); ++c) {
        const std::vector<Seen>& all = classes.all[c];
        const std::vector<Seen> some = thinned(all, most[c]);
        for (const Seen& seen : some)
            pixels_.push_back({.pixel = seen.pixel,
                               .weight = static_cast<double>(all.size()) / static_cast<double>(some.size()),
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

std::span<const char> FitSample::mask_at(std::size_t i, PortStep step, std::span<const char> all) const {
    if (step != PortStep::list) return all.subspan(i, 1);
    return all.subspan(pixels_[i].first, pixels_[i].pixel->fragments.size());
}

const EditedPixel& FitSample::edited(const SamplePixel& p, const Applied& edit) const {
    thread_local std::vector<Applied> edits;
    thread_local EditedPixel made;
    edits.clear();
    for (std::size_t e = 0; e < base_.edits.size(); ++e)
        edits.push_back({base_.edits[e].entry, base_.edits[e].parameters, p.masks[e]});
    edits.push_back(edit);
    made.edit(edits, *p.pixel);
    return made;
}

Color FitSample::exact(const SamplePixel& p, const StepEntry& entry, Parameters parameters,
                       std::span<const char> mask) const {
    return edited(p, {&entry, parameters, mask}).color({});
}

std::uint32_t MaskNumbers::of(std::size_t pixel, std::span<const char> mask) {
    if (std::ranges::find(mask, 1) == mask.end()) return 0;
    if (pixels_.size() <= pixel) pixels_.resize(pixel + 1);
    auto& known = pixels_[pixel];
    const std::string_view key{mask.data(), mask.size()};
    const auto found = known.find(key);
    return found != known.end() ? found->second
                                : known.emplace(key, static_cast<std::uint32_t>(known.size() + 1)).first->second;
}

Score FitSample::score(const StepEntry& entry, Parameters parameters, SampleMask& mask, KnownCosts& known,
                       const WantedScore& wanted) const {
    const bool changes_much = 6 * std::ranges::count(mask.all(), 1) > std::ssize(mask.all());
    double by_difference = 0, by_exact = changes_much ? 0 : std::numeric_limits<double>::infinity(), saved = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const SamplePixel& p = pixels_[i];
        if (std::min(by_difference, by_exact) > wanted.bits && saved + p.cost_from_here < wanted.saved) break;
        const std::span<const char> own = mask_at(i, entry.step, mask.all());
        const std::uint32_t number = mask.number(i, own);
        if (number == 0) {
            by_difference += p.weight * p.cost;
            by_exact += p.weight * p.exact_cost;
            continue;
        }
        const auto [of_moved, of_exact] = known.at(i, number, [&] {
            const Color trial = exact(p, entry, parameters, own);
            Color moved{};
            for (std::size_t c = 0; c < 3; ++c) moved[c] = p.emulated[c] + (trial[c] - p.exact[c]);
            return KnownCosts::Cost{cost_of(moved, *p.pixel, unit_), cost_of(trial, *p.pixel, unit_)};
        });
        const double of_trial = changes_much ? of_exact : of_moved;
        by_difference += p.weight * of_moved;
        by_exact += p.weight * of_trial;
        saved += p.weight * std::max(p.cost - std::min(of_moved, of_trial), 0.0);
    }
    return {std::min(by_difference, by_exact), saved};
}

Score FitSample::score(const Edit& edit) const {
    MaskNumbers numbers;
    KnownCosts none;
    SampleMask all{mask(*edit.entry, edit.conditions), numbers};
    return score(*edit.entry, edit.parameters, all, none);
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

double FitSample::emulated(const StepEntry& entry, Parameters parameters, SampleMask& mask, const Emulation& emulation,
                           KnownCosts& known, double most) const {
    double bits = 0;
    for (std::size_t i = 0; i < pixels_.size() && bits <= most; ++i) {
        const SamplePixel& p = pixels_[i];
        const std::span<const char> own = mask_at(i, entry.step, mask.all());
        const auto find = [&] {
            const Color color = edited(p, {&entry, parameters, own}).color(emulation.rounding);
            return KnownCosts::Cost{.moved = cost_of(color, *p.pixel, unit_)};
        };
        const std::uint32_t number = mask.number(i, own);
        bits += number == 0 ? emulation.base[i] : p.weight * known.at(i, number, find).moved;
    }
    return bits;
}

std::vector<double> FitSample::emulated(const Edit& edit, std::span<const Emulation> emulations) const {
    const std::vector<char> all = mask(*edit.entry, edit.conditions);
    std::vector<double> bits(emulations.size(), 0);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const SamplePixel& p = pixels_[i];
        const std::span<const char> own = mask_at(i, edit.entry->step, all);
        const bool is_changed = std::ranges::find(own, 1) != own.end();
        const EditedPixel* const made = is_changed ? &edited(p, {edit.entry, edit.parameters, own}) : nullptr;
        for (std::size_t e = 0; e < bits.size(); ++e)
            bits[e] += made == nullptr ? emulations[e].base[i]
                                       : p.weight * cost_of(made->color(emulations[e].rounding), *p.pixel, unit_);
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
