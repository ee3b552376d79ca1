// tools/oracle/rounding/pricing.h - the cost in bits of describing a picture under a hypothesis, by which hypotheses
// are compared.
//
// Rule     A pixel costs the logarithm of the number of values in its interval. A wrong pixel costs four times all of
//          its digits: it is caused by a mistake, which needs its own explanation, and a port should not be called
//          wrong only because a narrow hypothesis fits most pixels. By this principle of minimum description length, a
//          hypothesis with wide intervals everywhere does not excuse a few wrong pixels, and one with narrow intervals
//          does not reject a port with its own rounding.
// Numbers  Bits are whole multiples of 2^-16, so the sum does not depend on the order in which threads add them.
// Source   J. Rissanen, 1978, Modeling by shortest data description.
#pragma once
#include <algorithm>
#include <cmath>

#include "tools/oracle/rounding/composite.h"

namespace strata::oracle::verdict {

class Pricing {
  public:
    explicit Pricing(Storage storage) : storage_{storage} {}
    [[nodiscard]] double of(const ReachableColor& reach) const noexcept {
        double values = 1;  // number of values of the three channels
        for (std::size_t c = 0; c < 3; ++c) values *= 1 + (reach[c].high - reach[c].low) / step(reach[c].magnitude());
        if (reach.sums.is_known()) values = std::min(values, sums_of(reach.sums));
        return std::nearbyint(std::log2(values) * 0x1p16) * 0x1p-16;
    }
    [[nodiscard]] double of_wrong() const noexcept { return 4 * 3 * digits(); }
    // Bits of one channel.
    [[nodiscard]] double digits() const noexcept {
        switch (storage_) {
            case Storage::unorm8: return 8;
            case Storage::unorm10: return 10;
            case Storage::unorm16: return 16;
            case Storage::half: return 11;
            case Storage::single: break;
        }
        return 24;
    }
    // The cost of describing that a pixel at an edge is covered differently, and how.
    static constexpr double of_edge = 20;

  private:
    // The number of possible sums. Each has an error of some units in the last place, or of the interval of a float
    // back.
    [[nodiscard]] double sums_of(const Sums& sums) const noexcept {
        double values = sums.count();
        for (const Interval& back : sums.back) {
            const double open = sums.back_unit > 0 || sums.is_back_half ? 0 : sums.weight.high * (back.high - back.low);
            values *= 1 + open / step(1);
        }
        return values;
    }
    // The distance between two values that the picture distinguishes.
    [[nodiscard]] double step(double magnitude) const noexcept {
        if (storage_ == Storage::half || storage_ == Storage::single)
            return std::exp2(-digits()) * std::max(magnitude, 0x1p-14);
        return 1 / (std::exp2(digits()) - 1);
    }
    Storage storage_;
};

// The cost of stating the hypothesis itself.
[[nodiscard]] inline double bits_of(const Hypothesis& h) noexcept {
    double bits = has_front(h.order) && has_back(h.order) ? 8 : 0;
    if (bits > 0 && h.front.storage != h.back.storage) bits += 8;
    return bits + (h.slack > 0 ? 4 : 0);
}

}  // namespace strata::oracle::verdict
