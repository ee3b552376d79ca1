// tools/oracle/rounding/sums.cpp - the possible values of a picture in a wider format than its accumulators.
#include <algorithm>
#include <cmath>
#include <span>

#include "tools/oracle/rounding/composite.h"

namespace strata::oracle::verdict {

namespace {

constexpr double fine = 0x1p-40;  // tolerance for codes, which are quotients rounded on both sides

// The codes of a unit within an interval whose ends are codes.
struct Codes {
    double first = 0, last = 0;
    Codes(Interval of, double unit)
        : first{std::ceil(of.low / unit - 0x1p-8)}, last{std::floor(of.high / unit + 0x1p-8)} {}
};

// The spacing of binary16 at this magnitude.
double half_unit(double magnitude) noexcept {
    return std::scalbn(1.0, std::max(std::ilogb(magnitude), -14) - 10);  // for 0 the smallest subnormal
}

// Some numbers, or the statement that they are too many to be tried.
struct Few {
    std::array<double, 96> values{};
    std::size_t count = 0;
    bool are_all = true;
    void add(double v) noexcept {
        are_all = are_all && count < values.size();
        if (are_all) values[count++] = v;
    }
    [[nodiscard]] std::span<const double> all() const noexcept { return {values.data(), count}; }
};

// Calls act(h) for the halves within an interval of positive numbers until `few` is full.
void for_each_half(Interval of, Few& few, auto act) noexcept {
    if (of.low < -0x1p-10) few.are_all = false;  // below 0 by more than a rounded 0
    const double first = std::max(0.0, of.low - fine);
    const double unit = half_unit(first);
    for (double h = std::ceil(first / unit) * unit; few.are_all && h <= of.high + fine; h += half_unit(h)) act(h);
}

// The transmittances of a front of halves, which stores them or the coverage.
Few weights_of_halves(Interval weight) noexcept {
    Few few;
    for_each_half(weight, few, [&](double h) { few.add(h); });
    for_each_half(rest_of(weight), few, [&](double h) { few.add(1 - h); });
    return few;
}

// What lies behind: the codes or halves of an accumulator, or a float, whose interval is an error of the sum.
Few backs_of(const Sums& sums, std::size_t c) noexcept {
    Few few;
    const Interval& back = sums.back[c];
    if (sums.is_back_half)
        for_each_half(back, few, [&](double h) { few.add(h); });
    else if (sums.back_unit > 0)
        for (double code = Codes{back, sums.back_unit}.first; few.are_all && code <= Codes{back, sums.back_unit}.last;
             ++code)
            few.add(code * sums.back_unit);
    else
        few.add((back.low + back.high) / 2);
    return few;
}

bool halves_hold(const Sums& sums, const std::array<double, 4>& value) noexcept {
    const Few weights = weights_of_halves(sums.weight);
    const std::array<Few, 3> backs{backs_of(sums, 0), backs_of(sums, 1), backs_of(sums, 2)};
    if (!weights.are_all) return true;
    const auto adds_up = [&](std::size_t c, double through) {
        if (!backs[c].are_all) return true;
        const double open = sums.back_unit > 0 || sums.is_back_half ? 0 : sums.back[c].high - sums.back[c].low;
        const double off = (std::fabs(value[c]) + sums.back[c].magnitude()) * sums.relative + through * open / 2 + fine;
        return std::ranges::any_of(backs[c].all(), [&](double back) {
            const double front = value[c] - through * back;
            const double unit = half_unit(front);
            return std::fabs(front - std::nearbyint(front / unit) * unit) <= off && front >= sums.front[c].low - off &&
                   front <= sums.front[c].high + off;
        });
    };
    return std::ranges::any_of(weights.all(), [&](double through) {
        return adds_up(0, through) && adds_up(1, through) && adds_up(2, through);
    });
}

}  // namespace

double Sums::count() const noexcept {
    const auto codes = [](Interval of, double unit) {
        const Codes all{of, unit};
        return std::max(1.0, all.last - all.first + 1);
    };
    const auto of_front = [&](Interval of) {
        return codes(of, is_front_half ? half_unit(of.magnitude()) : front_unit);
    };
    double all = of_front(weight);
    for (std::size_t c = 0; c < 3; ++c) {
        all *= of_front(front[c]);
        if (back_unit > 0) all *= codes(back[c], back_unit);
        if (is_back_half) all *= codes(back[c], half_unit(back[c].magnitude()));
    }
    return all;
}

std::size_t Sums::weights() const noexcept {
    if (is_front_half) return weights_of_halves(weight).count;
    if (front_unit == 0) return 0;
    const Codes all{weight, front_unit};
    return static_cast<std::size_t>(std::max(0.0, all.last - all.first + 1));
}

bool Sums::hold(const std::array<double, 4>& value) const noexcept {
    if (is_front_half) return halves_hold(*this, value);
    // True if some front and back code of one channel add up to its value.
    const auto adds_up = [&](std::size_t c, double through) {
        const Codes fronts{front[c], front_unit};
        const double off = (std::fabs(value[c]) + back[c].magnitude()) * relative + 0x1p-24 + fine;
        // Limits the front codes to those whose remainder is in the back's interval.
        const double least = value[c] - through * (back[c].high + fine) - off;
        const double most = value[c] - through * (back[c].low - fine) + off;
        const double first = std::max(fronts.first, std::floor(least / front_unit) - 1);
        const double last = std::min(fronts.last, std::ceil(most / front_unit) + 1);
        for (double code = first; code <= last; ++code) {
            const double left = value[c] - code * front_unit;
            if (through == 0) {
                if (std::fabs(left) <= off) return true;
                continue;
            }
            const Interval behind{std::max((left - off) / through, back[c].low - fine),
                                  std::min((left + off) / through, back[c].high + fine)};
            if (behind.low > behind.high) continue;
            if (back_unit == 0 && !is_back_half) return true;
            const double unit = is_back_half ? half_unit(behind.magnitude()) : back_unit;
            if (const Codes some{behind, unit}; some.first <= some.last) return true;
        }
        return false;
    };
    const Codes weights{weight, front_unit};
    for (double code = weights.first; code <= weights.last; ++code) {
        const double through = code * front_unit;
        if (adds_up(0, through) && adds_up(1, through) && adds_up(2, through)) return true;
    }
    return false;
}

bool holds(const ReachableColor& reach, const std::array<double, 4>& value) noexcept {
    for (std::size_t c = 0; c < 3; ++c)
        if (!(value[c] >= reach[c].low - fine && value[c] <= reach[c].high + fine)) return false;
    return !reach.sums.is_known() || reach.sums.hold(value);
}

}  // namespace strata::oracle::verdict
