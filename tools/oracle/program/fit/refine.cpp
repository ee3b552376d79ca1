// tools/oracle/program/fit/refine.cpp - walks thresholds and fits parameters (search.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/oracle/program/fit/search.h"

namespace strata::oracle::program {

double shortest_between(double low, double high) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) return high;
    double scale = 1;
    for (int digits = 0; digits < 12; ++digits, scale *= 10) {
        const double t = std::nearbyint((low + high) / 2 * scale) / scale;
        if (low < t && t <= high) return t;
    }
    return high;
}

double Scorer::operator()(const Edit& edit, double most) {
    if (edit.entry != entry_ || edit.parameters != parameters_) {
        entry_ = edit.entry;
        parameters_ = edit.parameters;
        known_.forget();
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const StepEntry& entry = *edit.entry;
    const double words = price(edit);
    SampleMask mask{sample_->mask(entry, edit.conditions), numbers_};
    return words + (emulation_ != nullptr
                        ? sample_->emulated(entry, edit.parameters, mask, *emulation_, known_, most - words)
                        : sample_->score(entry, edit.parameters, mask, known_, {most - words, infinity}).bits);
}

namespace {

// Takes the change if it costs less.
bool improve(Scorer& scorer, Trial& trial, const Edit& edit) {
    const double cost = scorer(edit, trial.cost);
    if (!(cost < trial.cost)) return false;
    trial = {edit, cost};
    return true;
}

void walk(Scorer& scorer, Trial& trial, std::size_t which) {
    const Condition given = trial.edit.conditions[which];
    if (given.is == Condition::Is::equal) return;
    std::vector<double> values = scorer.sample().values(*given.property, trial.edit.entry->step);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    auto at = std::ranges::lower_bound(values, given.threshold) - values.begin();
    const auto set = [&](std::ptrdiff_t i) {
        Edit edit = trial.edit;
        const double value = values[static_cast<std::size_t>(i)];
        edit.conditions[which].threshold = given.property->kind == FragmentProperty::Kind::number && i > 0
                                               ? shortest_between(values[static_cast<std::size_t>(i - 1)], value)
                                               : value;
        return edit;
    };
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    for (std::ptrdiff_t step = std::max<std::ptrdiff_t>(count / 24, 1); step > 0; step /= 2)
        for (bool is_better = true; is_better;) {
            is_better = false;
            for (const std::ptrdiff_t next : {at - step, at + step})
                if (next >= 0 && next < count && improve(scorer, trial, set(next))) {
                    at = next;
                    is_better = true;
                    break;
                }
        }
}

}  // namespace

void drop_conditions(Scorer& scorer, Trial& trial) {
    for (std::size_t i = trial.edit.conditions.size(); i-- > 0;) {
        Edit edit = trial.edit;
        edit.conditions.erase(edit.conditions.begin() + static_cast<std::ptrdiff_t>(i));
        const double cost = scorer(edit);
        if (cost <= trial.cost + 0.003 * scorer.sample().cost()) trial = {edit, cost};
    }
}

void exchange_conditions(Scorer& scorer, Trial& trial) {
    const PortStep step = trial.edit.entry->step;
    for (std::size_t i = 0; i < trial.edit.conditions.size(); ++i) {
        Edit edit = trial.edit;
        for (const FragmentProperty& property : properties()) {
            if (step != PortStep::list && !property.is_of_pixel) continue;
            for (const Condition& other : conditions_of(property, scorer.sample().values(property, step))) {
                edit.conditions[i] = other;
                improve(scorer, trial, edit);
            }
        }
    }
}

void walk_thresholds(Scorer& scorer, Trial& trial) {
    for (std::size_t i = 0; i < trial.edit.conditions.size(); ++i) walk(scorer, trial, i);
}

void fit_parameter(Scorer& scorer, Trial& trial) {
    if (!trial.edit.entry->is_continuous || trial.edit.parameters.size() != 1) return;
    Edit edit = trial.edit;
    const auto cost_at = [&](double p, double most) {
        edit.parameters[0] = p;
        return scorer(edit, most);
    };
    double best = trial.edit.parameters[0], cost = trial.cost;
    double reach = std::max(std::fabs(best) * 0.6, 0.2);
    for (int round = 0; round < 9; ++round, reach /= 4) {
        const double middle = best;
        for (int i = -6; i <= 6; ++i) {
            const double p = middle + reach * i / 6;
            const double found = cost_at(p, cost);
            if (found < cost) {
                cost = found;
                best = p;
            }
        }
    }
    for (const double scale : {1.0, 2.0, 4.0, 8.0, 10.0, 16.0, 100.0, 1000.0, 1e4}) {
        const double rounded = std::nearbyint(best * scale) / scale;
        const double most = cost * 1.05 + 0.0005 * scorer.sample().cost(), found = cost_at(rounded, most);
        if (found <= most) {
            best = rounded;
            cost = found;
            break;
        }
    }
    trial.edit.parameters[0] = best;
    trial.cost = cost;
}

}  // namespace strata::oracle::program
