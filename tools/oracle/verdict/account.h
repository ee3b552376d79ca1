// tools/oracle/verdict/account.h - what is said of a picture: a structure under a hypothesis, and how it fares at every
// pixel.
//
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/verdict/hypothesis.h"
#include "tools/oracle/verdict/rule.h"
#include "tools/oracle/verdict/ties.h"

namespace strata::oracle::verdict {

// A structure and how it is rounded; no rules: the right structure.
struct Account {
    std::vector<Rule> rules{};  // applied one after the other
    Hypothesis hypothesis{};
};

// All pixels of a picture by one account.
struct Checked {
    Account account{};
    std::uint64_t pixels = 0, covered = 0;  // covered: by a visible fragment
    Ties ties{};
    bool has_one_tie_rule = true;  // false: fragments at one depth come in an order that changes from pixel to pixel
    std::uint64_t tied = 0;        // pixels whose ties show
    std::uint64_t at_edges = 0;    // pixels that are as a rasterizer may have them that snaps otherwise
    std::uint64_t changed = 0;     // pixels whose structure is not the right one
    std::uint64_t undecided = 0;   // of these, pixels that the right structure may leave, too
    // Codes (of floats: parts of 255) by which a pixel is off the structure's exact result, and could be.
    double observed = 0, possible = 0;
    double bits = 0;                            // of pixels that are not wrong
    std::vector<std::uint32_t> wrong_pixels{};  // row-major, ascending
    [[nodiscard]] bool is_whole() const noexcept { return wrong_pixels.empty(); }
};
// Rules that explain a part of the wrong pixels.
struct Lead {
    std::vector<Rule> rules{};
    std::uint64_t explained = 0, of = 0;        // wrong pixels, of those that were looked at
    std::uint64_t contradicted = 0, right = 0;  // right pixels that speak against it, of those that were looked at
};

}  // namespace strata::oracle::verdict
