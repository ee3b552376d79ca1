// tools/oracle/compare/coverage.h - masks of the pixels that were drawn, and the kind of difference between two such
// masks.
//
// Rule     A pixel is drawn if its depth is not 1, if both images have depths; else if its alpha is above 0, if the
//          reference's alpha varies; else if its colour is not the background's, which is the commonest colour along
//          the reference's edge if half of the edge has it. The candidate's background is its own commonest colour at
//          those pixels. If the caller gives a background, only that is used. Borders of the masks are compared along
//          rows and columns. `moved`: both ends of the runs move in the same direction, by a quarter of a pixel or
//          more; `edge_rule`: gains and losses are on opposite sides, or there are only gains or only losses, at the
//          borders; `snapping`: gains and losses are mixed at the borders; `surface`: most are away from the borders.
// Tests    tests/tools/oracle/compare/coverage_test.cpp
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/picture/pairs.h"

namespace strata::oracle {

using Mask = std::vector<bool>;  // one entry per pixel

struct Masks {
    Mask reference, candidate;
};

// The channels of the reference's background as values; empty: unknown.
using Background = std::vector<double>;

// Empty if the background cannot be determined.
[[nodiscard]] std::optional<Masks> drawn(std::span<const TargetPair> pairs, const Background& known = {});

enum class CoverageMistake : std::uint8_t { none, moved, edge_rule, snapping, surface };
[[nodiscard]] std::string_view name(CoverageMistake mistake) noexcept;

struct CoverageReport {
    CoverageMistake mistake = CoverageMistake::none;
    std::uint64_t gained = 0, lost = 0, inner = 0;  // inner: away from the reference's borders
    double moved_x = 0, moved_y = 0;                // mean over the borders that both masks have, in pixels
    [[nodiscard]] std::string description() const;
};

[[nodiscard]] CoverageReport compare_coverage(const Masks& masks, int width, int height);

}  // namespace strata::oracle
