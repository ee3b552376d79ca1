// tools/oracle/search/account.h - an explanation of a picture (which layers are composited, and how they are rounded),
// and how well it fits every pixel.
//
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "tools/oracle/rounding/hypothesis.h"
#include "tools/oracle/rules/rule.h"
#include "tools/oracle/rules/ties.h"

namespace strata::oracle::verdict {

// A structure with a hypothesis about rounding. Without rules it is the right structure.
struct Account {
    std::vector<Rule> rules{};  // applied one after the other
    Hypothesis hypothesis{};
};

// The result of checking one account against all pixels of a picture.
struct CheckedAccount {
    Account account{};
    std::uint64_t pixels = 0, covered = 0;  // covered: those with a visible fragment
    Ties ties{};
    bool has_one_tie_rule = true;  // false: no single rule for fragments of equal depth fits all pixels
    std::uint64_t tied = 0;        // pixels whose value depends on the rule for equal depths
    std::uint64_t at_edges = 0;    // pixels that only a rasterizer with other snapping or another tie rule can have
    std::uint64_t at_close_depths = 0;  // pixels whose depths within two codes are ordered or merged otherwise
    std::uint64_t edges = 0;            // pixels that another rasterizer may cover otherwise, or that need one
    std::uint64_t lost_at_ties = 0;     // pixels that lack, or merge, fragments of one depth
    std::uint64_t changed = 0;          // pixels whose structure differs from the right one
    std::uint64_t undecided = 0;        // of these, pixels whose value the right structure also reaches
    // Distance from the structure's exact result, in codes (floats: in 1/255): the largest in the picture, and the
    // largest that the hypothesis allows.
    double observed = 0, possible = 0;
    // The largest distance from the middle of what the hypothesis allows, in the same unit, and the number of pixels at
    // which it is more than so many layers need.
    double needed = 0;
    std::uint64_t needing_many = 0;
    double bits = 0;                            // sum over the pixels that are not wrong (pricing.h)
    std::vector<std::uint32_t> wrong_pixels{};  // row-major, ascending
    [[nodiscard]] bool is_whole() const noexcept { return wrong_pixels.empty(); }
    // Pixels that only another rasterizer gives, of those that are not wrong.
    [[nodiscard]] std::uint64_t rasterized_otherwise() const noexcept { return at_edges + at_close_depths; }
    // True if more pixels at edges are excused than snapping moves: real rasterizers have 8 bits of subpixels, a
    // thirty-second of what the coverages allow.
    [[nodiscard]] bool excuses_many_edges() const noexcept { return at_edges > std::max<std::uint64_t>(8, edges / 20); }
    // Pixels at which the given fragments alone do not give the value.
    [[nodiscard]] std::uint64_t excused() const noexcept { return rasterized_otherwise() + lost_at_ties; }
};
// Rules that explain only some of the wrong pixels.
struct Lead {
    std::vector<Rule> rules{};
    std::uint64_t explained = 0, of = 0;        // wrong pixels, of those that were examined
    std::uint64_t contradicted = 0, right = 0;  // right pixels that the rules would make wrong, of those examined
};

}  // namespace strata::oracle::verdict
