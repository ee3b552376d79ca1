// tools/oracle/program/fit/prove.cpp - whole-picture proofs, and exact thresholds (prove.h).
#include "tools/oracle/program/fit/prove.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/oracle/program/fit/search.h"

namespace strata::oracle::program {

namespace {

bool is_beyond(const Lists& lists, const Program& program, const PortRounding& rounding, const ListPixel& pixel) {
    const Color off = residual_of(program, pixel, rounding, lists.unit()).off;
    return std::ranges::any_of(off, [&](double v) { return std::fabs(v) > bound_at(pixel); });
}

// The share of wrong pixels that are repaired, and of right ones that are broken.
struct Moved {
    double repaired = 0, broken = 0;
};

Moved moved(const Lists& lists, const Program& program, const Fitness& fitness, const Lists& given,
            const Fitness& right) {
    double wrong = 0, repaired = 0, good = 0, broken = 0;
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        const ListPixel& pixel = lists.pixels[i];
        const bool was_wrong = is_beyond(lists, {}, right.rounding, given.pixels[i]),
                   is_wrong = is_beyond(lists, program, fitness.rounding, pixel);
        (was_wrong ? wrong : good) += 1;
        if (was_wrong && !is_wrong) repaired += 1;
        if (!was_wrong && is_wrong) broken += 1;
    }
    return {wrong > 0 ? repaired / wrong : 0, good > 0 ? broken / good : 0};
}

// The program with each threshold that is compared with what a port rounds a little lower, and a little higher.
std::vector<Program> with_moved_thresholds(const Program& program, double by) {
    std::vector<Program> all;
    for (std::size_t e = 0; e < program.edits.size(); ++e) {
        const Edit& edit = program.edits[e];
        for (const double d : {-by, by}) {
            for (std::size_t i = 0; i < edit.conditions.size(); ++i)
                if (edit.conditions[i].property->is_rounded)
                    all.emplace_back(program).edits[e].conditions[i].threshold += d;
            if (edit.entry->is_threshold) all.emplace_back(program).edits[e].parameters[0] += d;
        }
    }
    return all;
}

// The pixels beyond that one of these programs explains.
std::uint64_t open_pixels(const Lists& lists, const Program& program, const PortRounding& rounding) {
    const std::vector<Program> moved = with_moved_thresholds(program, 2 * lists.unit());
    if (moved.empty()) return 0;
    return static_cast<std::uint64_t>(std::ranges::count_if(lists.pixels, [&](const ListPixel& pixel) {
        return is_beyond(lists, program, rounding, pixel) &&
               std::ranges::any_of(moved, [&](const Program& p) { return !is_beyond(lists, p, rounding, pixel); });
    }));
}

}  // namespace

Proof prove(const Lists& lists, const Program& program, const Fitness& right, const Lists* given, const Fitness* own) {
    Proof proof{.program = program, .fitness = own != nullptr ? *own : best_fitness(lists, program)};
    const Fitness& f = proof.fitness;
    proof.cost = f.bits + price(program);
    const double most = std::max(2.0, 0.002 * static_cast<double>(f.covered));
    // Where many layers are blended, rounding alone costs more.
    const bool is_cheap = f.bits_per_covered() < 1.5 || (is_narrow(f) && proof.cost < 0.1 * right.bits);
    if (static_cast<double>(f.beyond) > most && 20 * f.beyond <= f.covered)
        proof.open = open_pixels(lists, program, f.rounding);
    proof.is_whole = static_cast<double>(f.beyond - proof.open) <= most && f.mean < 1 && f.slope < 0.35 && is_cheap &&
                     proof.cost < 0.6 * right.bits;
    // A free fit of several parameters comes near to anything: it explains only by round numbers.
    const bool is_loose = std::ranges::any_of(program.edits, [&](const Edit& edit) {
        if (edit.entry->start == nullptr) return false;
        if (edit.entry->is_plausible != nullptr)
            return !(edit.entry->is_plausible(edit.parameters) && is_narrow(f) && f.bits_per_covered() < 1);
        return !std::ranges::all_of(edit.parameters, is_round);
    });
    if (proof.is_whole && is_loose) {
        proof.is_whole = false;
        proof.is_part = true;
    }
    if (!proof.is_whole && proof.cost < 0.55 * right.bits) {
        const Moved m = moved(lists, program, f, given != nullptr ? *given : lists, right);
        proof.is_part = m.repaired > 0.6 && m.broken < 0.1;
    }
    return proof;
}

namespace {

// The condition on this property that holds for the wanted ones among the given; empty if none does.
std::optional<Condition> separating(const FragmentProperty& property, const std::vector<double>& values,
                                    const std::vector<char>& given, const std::vector<char>& wanted) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low = infinity, high = -infinity, low_of_others = infinity, high_of_others = -infinity;
    bool is_among_others = false;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (wanted[i] != 0) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
    for (std::size_t i = 0; i < values.size(); ++i)
        if (given[i] != 0 && wanted[i] == 0) {
            low_of_others = std::min(low_of_others, values[i]);
            high_of_others = std::max(high_of_others, values[i]);
            is_among_others |= values[i] == low;
        }
    using Is = Condition::Is;
    const bool is_number = property.kind == FragmentProperty::Kind::number;
    if (!is_number && low == high && !is_among_others) return Condition{&property, Is::equal, low};
    const auto between = [&](double a, double b) { return is_number ? shortest_between(a, b) : b; };
    // Of "at least infinite" the rank says more.
    if (low > high_of_others && std::isfinite(low))
        return Condition{&property, Is::at_least, between(high_of_others, low)};
    if (high < low_of_others && std::isfinite(low_of_others))
        return Condition{&property, Is::below, between(high, low_of_others)};
    return std::nullopt;
}

}  // namespace

std::vector<Program> equal_programs(const FitSample& sample, const Program& program) {
    std::vector<Program> all;
    const Edit& edit = program.edits.back();
    const PortStep step = edit.entry->step;
    const std::vector<char> wanted = sample.mask(*edit.entry, edit.conditions);
    if (std::ranges::find(wanted, 1) == wanted.end()) return all;
    for (std::size_t i = 0; i < edit.conditions.size(); ++i) {
        std::vector<Condition> others = edit.conditions;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const std::vector<char> given = sample.mask(*edit.entry, others);
        for (const FragmentProperty& property : properties()) {
            if (&property == edit.conditions[i].property || (step != PortStep::list && !property.is_of_pixel)) continue;
            const auto found = separating(property, sample.values(property, step), given, wanted);
            if (!found) continue;
            Program& equal = all.emplace_back(program);
            equal.edits.back().conditions[i] = *found;
        }
    }
    return all;
}

bool predict_alike(const ProgramOn& a, const ProgramOn& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.lists.pixels.size(); ++i) {
        const Color of_a = value(a.program, a.lists.pixels[i], {}), of_b = value(b.program, b.lists.pixels[i], {});
        for (std::size_t c = 0; c < 3; ++c)
            if (std::fabs(of_a[c] - of_b[c]) > a.lists.unit()) {
                ++different;
                break;
            }
    }
    return different <= std::max<std::size_t>(2, a.lists.pixels.size() / 1000);
}

namespace {

// The threshold between `low` and `high` at which the pixels that it changes cost least.
class Threshold {
  public:
    Threshold(const Lists& lists, Program& program, Condition& condition, const PortRounding& rounding)
        : lists_{lists}, program_{program}, condition_{condition}, rounding_{rounding} {}

    void place(double low, double high) {
        gather(low, high);
        if (values_.size() < 2) return;
        std::size_t from = 0, to = values_.size() - 1;
        std::size_t best = at(condition_.threshold);
        for (std::size_t step = std::max<std::size_t>((to - from) / 16, 1);;
             step = std::max<std::size_t>(step / 8, 1)) {
            const std::size_t middle = best;
            const std::size_t every = step > 1 ? pixels_.size() / few | 1 : 1;
            double cost = cost_at(best, every);
            from = middle > 16 * step ? middle - 16 * step : 0;
            to = std::min(values_.size() - 1, middle + 16 * step);
            for (std::size_t i = from; i <= to; i += step) {
                const double found = cost_at(i, every, cost);
                if (found < cost) {
                    cost = found;
                    best = i;
                }
            }
            if (step == 1) break;
        }
        set(best);
    }

  private:
    static constexpr std::size_t few = 1024;  // pixels that long steps ask

    // A pixel with its values, and the bits that it costs if so many of them are below the threshold; negative: not
    // known. Of pixels with equal depths nothing is kept.
    struct PixelNear {
        const ListPixel* pixel = nullptr;
        std::vector<double> values{}, bits{};
    };

    void gather(double low, double high) {
        for (const ListPixel& pixel : lists_.pixels) {
            bool is_near = false;
            const std::size_t count = condition_.property->is_of_pixel ? 1 : pixel.fragments.size();
            for (std::size_t k = 0; k < count; ++k) {
                const double v = condition_.property->of(pixel, k);
                if (v < low || v > high) continue;
                values_.push_back(v);
                is_near = true;
            }
            if (is_near) pixels_.push_back({&pixel, {}, {}});
        }
        for (PixelNear& near : pixels_) {
            if (!near.pixel->ties.empty()) continue;
            const std::size_t count = condition_.property->is_of_pixel ? 1 : near.pixel->fragments.size();
            for (std::size_t k = 0; k < count; ++k) near.values.push_back(condition_.property->of(*near.pixel, k));
            std::ranges::sort(near.values);
            near.bits.assign(count + 1, -1);
        }
        std::ranges::sort(values_);
        values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    }
    [[nodiscard]] std::size_t at(double threshold) const {
        const auto found = std::ranges::lower_bound(values_, threshold);
        return std::min(static_cast<std::size_t>(found - values_.begin()), values_.size() - 1);
    }
    void set(std::size_t i) {
        condition_.threshold = condition_.property->kind == FragmentProperty::Kind::number && i > 0
                                   ? shortest_between(values_[i - 1], values_[i])
                                   : values_[i];
    }
    // Of every so many pixels; what costs more than `most` is not counted to the end.
    double cost_at(std::size_t i, std::size_t every, double most = std::numeric_limits<double>::infinity()) {
        set(i);
        double bits = 0;
        for (std::size_t p = 0; p < pixels_.size() && bits < most; p += every) bits += bits_at(pixels_[p]);
        return bits;
    }
    double bits_at(PixelNear& near) const {
        const auto find = [&] { return bits_of(residual_of(program_, *near.pixel, rounding_, lists_.unit()).off); };
        if (near.bits.empty()) return find();
        const auto below = std::ranges::lower_bound(near.values, condition_.threshold) - near.values.begin();
        double& bits = near.bits[static_cast<std::size_t>(below)];
        if (bits < 0) bits = find();
        return bits;
    }

    const Lists& lists_;
    Program& program_;
    Condition& condition_;
    const PortRounding& rounding_;
    std::vector<double> values_{};
    std::vector<PixelNear> pixels_{};
};

}  // namespace

void place_thresholds(const Lists& lists, const FitSample& sample, Program& program, const PortRounding& rounding) {
    constexpr std::ptrdiff_t near = 16;  // values of the sample on either side
    Edit& edit = program.edits.back();
    for (Condition& condition : edit.conditions) {
        if (condition.is == Condition::Is::equal || condition.property->kind == FragmentProperty::Kind::flag) continue;
        std::vector<double> values = sample.values(*condition.property, edit.entry->step);
        std::ranges::sort(values);
        values.erase(std::unique(values.begin(), values.end()), values.end());
        const auto at = std::ranges::lower_bound(values, condition.threshold) - values.begin();
        const auto value_at = [&](std::ptrdiff_t i) {
            return values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(values) - 1))];
        };
        Threshold{lists, program, condition, rounding}.place(value_at(at - near), value_at(at + near));
    }
}

}  // namespace strata::oracle::program
