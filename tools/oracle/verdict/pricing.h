// tools/oracle/verdict/pricing.h - what a picture costs in bits if a hypothesis is to tell it: the measure by which
// hypotheses are chosen.
//
// Rule     A pixel costs what its interval leaves open: the logarithm of the number of values in it. A wrong pixel
//          costs all its digits, four times: what makes it wrong is a mistake, which has a reason of its own, and no
//          port is to be accused for a narrow account's sake. That is the principle of the shortest description: one
//          that leaves much open everywhere does not excuse a few wrong pixels, and one that leaves nothing open does
//          not accuse a port that rounds in its own way.
// Numbers  Bits are whole multiples of 2^-16, so that threads may add them up in any order.
// Source   J. Rissanen, 1978, Modeling by shortest data description.
#pragma once
#include <algorithm>
#include <cmath>

#include "tools/oracle/verdict/composite.h"

namespace strata::oracle::verdict {

class Pricing {
  public:
    explicit Pricing(Storage storage) : storage_{storage} {}
    [[nodiscard]] double of(const Reach& reach) const noexcept {
        double values = 1;  // of three channels
        for (std::size_t c = 0; c < 3; ++c) values *= 1 + (reach[c].high - reach[c].low) / step(reach[c].magnitude());
        if (reach.sums.front_unit > 0) values = std::min(values, sums_of(reach.sums));
        return std::nearbyint(std::log2(values) * 0x1p16) * 0x1p-16;
    }
    [[nodiscard]] double of_wrong() const noexcept { return 4 * 3 * digits(); }
    // Of one channel, in bits.
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
    static constexpr double of_edge = 6;  // to say that and how a pixel at an edge is covered otherwise

  private:
    // Each is off by some units in the last place, or by what is left open of a float behind.
    [[nodiscard]] double sums_of(const Sums& sums) const noexcept {
        double values = sums.count();
        for (const Interval& back : sums.back) {
            const double open = sums.back_unit > 0 || sums.is_back_half ? 0 : sums.weight.high * (back.high - back.low);
            values *= 1 + open / step(1);
        }
        return values;
    }
    // Between two values that the picture tells apart.
    [[nodiscard]] double step(double magnitude) const noexcept {
        if (storage_ == Storage::half || storage_ == Storage::single)
            return std::exp2(-digits()) * std::max(magnitude, 0x1p-14);
        return 1 / (std::exp2(digits()) - 1);
    }
    Storage storage_;
};

// What it takes to say which hypothesis it is.
[[nodiscard]] inline double bits_of(const Hypothesis& h) noexcept {
    double bits = has_front(h.order) && has_back(h.order) ? 8 : 0;
    if (bits > 0 && h.front.storage != h.back.storage) bits += 8;
    return bits + (h.slack > 0 ? 4 : 0);
}

}  // namespace strata::oracle::verdict
