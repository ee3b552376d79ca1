// tools/oracle/coverage.h - which pixels something was drawn at, and what the difference of two such masks looks like.
//
// Rule     Drawn: a depth other than 1 where both pictures have depths; else an alpha above 0 where the reference's
//          alpha varies; else a colour other than the background's, which is the commonest colour along the reference's
//          edge if half of the edge has it. The candidate's background is its own commonest colour at those pixels. A
//          background that the caller knows decides alone. Borders of the masks are followed along rows and columns.
//          `moved`: both ends of the runs go the same way, by a quarter of a pixel or more; `edge_rule`: gains and
//          losses each keep to one side, or there are gains or losses alone, at the borders; `snapping`: they mix at
//          the borders; `surface`: most lie away from the borders.
// Tests    tests/tools/oracle/coverage_test.cpp
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/pairs.h"

namespace strata::oracle {

using Mask = std::vector<bool>;  // a pixel an entry

struct Masks {
    Mask reference, candidate;
};

// The channels of the reference's background as values; empty: not known.
using Background = std::vector<double>;

// Nothing if the pictures do not tell what is background.
[[nodiscard]] std::optional<Masks> drawn(std::span<const Pair> pairs, const Background& known = {});

enum class CoverageMistake : std::uint8_t { none, moved, edge_rule, snapping, surface };
[[nodiscard]] std::string_view name(CoverageMistake mistake) noexcept;

struct CoverageReport {
    CoverageMistake mistake = CoverageMistake::none;
    std::uint64_t gained = 0, lost = 0, inner = 0;  // inner: away from the reference's borders
    double moved_x = 0, moved_y = 0;                // mean over the borders that both masks have, in pixels
    [[nodiscard]] std::string sentence() const;
};

[[nodiscard]] CoverageReport compare_coverage(const Masks& masks, int width, int height);

}  // namespace strata::oracle
