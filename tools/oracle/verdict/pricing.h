// tools/oracle/verdict/pricing.h - what a picture costs in bits if a hypothesis is to tell it: the measure by which hypotheses are chosen.
//
// Rule     A pixel costs what its interval leaves open: the logarithm of the number of values in it. A wrong pixel costs all its digits.
//          That is the principle of the shortest description: one that leaves much open everywhere does not excuse a few wrong pixels, and
//          one that leaves nothing open does not accuse a port that rounds in its own way.
// Source   J. Rissanen, 1978, Modeling by shortest data description.
#pragma once
#include <cmath>

#include "tools/oracle/verdict/composite.h"

namespace strata::oracle::verdict {

class Pricing {
  public:
    explicit Pricing(Storage storage) : storage_{storage} {}
    [[nodiscard]] double of(const Reach& reach) const noexcept {
        double values = 1;  // of three channels
        for (std::size_t c = 0; c < 3; ++c) values *= 1 + (reach[c].high - reach[c].low) / step(reach[c].magnitude());
        return std::log2(values);
    }
    [[nodiscard]] double of_wrong() const noexcept { return 3 * digits(); }

  private:
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
    // Between two values that the picture tells apart.
    [[nodiscard]] double step(double magnitude) const noexcept {
        if (storage_ == Storage::half || storage_ == Storage::single)
            return std::exp2(-digits()) * std::max(magnitude, 0x1p-14);
        return 1 / (std::exp2(digits()) - 1);
    }
    Storage storage_;
};

// What it takes to say which hypothesis it is: of two that tell a picture alike, the plainer one is named.
[[nodiscard]] inline double bits_of(const Hypothesis& h) noexcept {
    double bits = has_front(h.order) && has_back(h.order) ? 8 : 0;
    if (bits > 0 && h.front.storage != h.back.storage) bits += 8;
    if (h.order == Order::both_ends_far || h.order == Order::both_ends_apart || h.order == Order::over_apart) bits += 4;
    if (h.result.rounding != Rounding::nearest) bits += 4;
    for (const End* end : {&h.front, &h.back}) {
        if (end->storage == Storage::unorm10) bits += 8;  // few targets have 10 bits
        if (end->rounding != Rounding::nearest) bits += 4;
    }
    return bits + (h.slack > 0 ? 4 : 0);
}

}  // namespace strata::oracle::verdict
