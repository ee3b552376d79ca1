// tools/oracle/rounding/sums.cpp - the possible values of a float picture that is computed from accumulators of codes.
#include <algorithm>
#include <cmath>

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

}  // namespace

double Sums::count() const noexcept {
    const auto codes = [](Interval of, double unit) {
        const Codes all{of, unit};
        return std::max(1.0, all.last - all.first + 1);
    };
    double all = codes(weight, front_unit);
    for (std::size_t c = 0; c < 3; ++c) {
        all *= codes(front[c], front_unit);
        if (back_unit > 0) all *= codes(back[c], back_unit);
        if (is_back_half) all *= codes(back[c], half_unit(back[c].magnitude()));
    }
    return all;
}

std::size_t Sums::weights() const noexcept {
    if (front_unit == 0) return 0;
    const Codes all{weight, front_unit};
    return static_cast<std::size_t>(std::max(0.0, all.last - all.first + 1));
}

bool Sums::hold(const std::array<double, 4>& value) const noexcept {
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
    return reach.sums.front_unit == 0 || reach.sums.hold(value);
}

}  // namespace strata::oracle::verdict
