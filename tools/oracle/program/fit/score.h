// tools/oracle/program/fit/score.h - the cost of a predicted picture in bits: one measure for every step of a program.
//
// Rule     A channel that is off by r codes costs log2(1 + r^2) bits: a far-off pixel costs some more than a near one,
//          not a thousand times as much, and no threshold decides. One code is free where nothing is drawn: a
//          background of 0.3 is a tie between two codes at all of those pixels at once.
// Numbers  The logarithm is exact at powers of 2 and within 0.01 elsewhere, without a library whose last digit may
//          differ. Bits are whole multiples of 2^-16, so that sums do not depend on their order.
// Tests    tests/tools/oracle/program/parts_test.cpp
#pragma once
#include <optional>
#include <vector>

#include "tools/oracle/program/program.h"

namespace strata::oracle::program {

// The candidate's distance in codes, per channel: predicted minus seen. Where the candidate has exactly 0 or 1, a port
// may have clamped.
[[nodiscard]] Color residual(const Color& predicted, const ListPixel& pixel, double unit) noexcept;
[[nodiscard]] double bits_of(const Color& residual) noexcept;
[[nodiscard]] inline double cost_of(const Color& predicted, const ListPixel& pixel, double unit) noexcept {
    return bits_of(residual(predicted, pixel, unit));
}
// The residual of a program, of what a port may do with equal depths that comes closest.
struct TiedResidual {
    Color off{};
    bool loses = false;  // fragments of equal depths
};
[[nodiscard]] TiedResidual residual_of(const Program& program, const ListPixel& pixel, const PortRounding& rounding,
                                       double unit);
// The largest residual that rounding explains, in codes.
[[nodiscard]] double bound_at(const ListPixel& pixel) noexcept;

// How well a program predicts the whole picture under one rounding.
struct Fitness {
    PortRounding rounding{};
    double bits = 0;   // of all pixels
    double slope = 0;  // of the residual, in codes per standard deviation of what may cause it
    double mean = 0;   // largest of a channel, in codes, over covered pixels
    double worst = 0;  // largest residual in codes
    std::uint64_t pixels = 0, covered = 0;
    std::uint64_t beyond = 0;        // pixels beyond `bound_at`
    std::uint64_t lost_at_ties = 0;  // pixels where a fragment of several at one depth is lost
    std::uint64_t beyond_one = 0;    // pixels off by more than one code
    [[nodiscard]] double bits_per_covered() const noexcept {
        return bits / static_cast<double>(covered > 0 ? covered : pixels);
    }
};

[[nodiscard]] Fitness measure(const Lists& lists, const Program& program, const PortRounding& rounding);
// Under the rounding that costs least: some pixels choose the two that are tried on all.
[[nodiscard]] Fitness best_fitness(const Lists& lists, const Program& program);

// The rounding that some pixels choose.
[[nodiscard]] PortRounding likely_rounding(const Lists& lists, const Program& program);

// True if rounding alone explains what is left.
[[nodiscard]] bool is_narrow(const Fitness& fitness) noexcept;
// The same in few bits: nothing else is asked.
[[nodiscard]] inline bool is_plainly_right(const Fitness& right) noexcept {
    return is_narrow(right) && right.bits_per_covered() <= 1.2;
}

}  // namespace strata::oracle::program
