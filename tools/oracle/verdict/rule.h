// tools/oracle/verdict/rule.h - what a port may do to a pixel's layers instead of compositing them: one mistake, the same at every pixel.
//
// Rule     A rule is a value: a kind and its parameters. StackMaker applies it to a pixel's list; `holds` for a whole picture is judge.h's affair.
//          Numbers of layers count from the near end from 0, or from the far end where the kind says so.
// Tests    tests/tools/oracle/verdict/search_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::oracle::verdict {

enum class RuleKind : std::uint8_t {
    right,
    // How many layers. n: their number
    nearest_alone,      // the nearest n
    farthest_alone,     // the farthest n
    ends_alone,         // the nearest n and the farthest n, as n passes of a dual peel leave them
    nearest_lost,       // all but the nearest n
    farthest_lost,      // all but the farthest n
    rest_averaged,      // the nearest n, behind them one layer: the average of the others, with their alpha together
    rest_as_submitted,  // the nearest n, behind them the others as they were submitted
    first_submitted,    // the first n submitted, sorted
    last_submitted,     // the last n submitted, sorted
    // One layer: n is its number
    lost,
    lost_from_far,
    doubled,
    doubled_from_far,
    swapped,           // with the one behind it
    swapped_from_far,  // with the one before it
    merged,            // with the one behind it, by MAX
    mixed,             // with the one behind it: the average of the two
    color_of_next,     // it has the colour of the one behind it
    color_of_previous,
    // All layers
    all_doubled,
    reversed,
    as_submitted,  // the last submitted in front
    as_submitted_reversed,
    by_instance,           // instances as submitted, the last in front; each one's layers sorted
    by_instance_reversed,  // the first in front
    back_faces_behind,     // front faces before back faces, each sorted
    back_faces_behind_as_submitted,
    averaged,      // one layer: the average weighted by alpha, alpha 1 - (1 - mean)^n
    added,         // colours times alpha added to the background
    weighted_sum,  // colours times alpha, and the background times 1 less all alphas
    nearest_of_instance,
    // Some layers, by what they are
    instance_lost,  // n: its number in the draw list
    instance_doubled,
    material_lost,
    material_doubled,
    back_faces_lost,
    front_faces_lost,
    alpha_below_lost,  // with alpha below `value`
    alpha_below_kept,  // with alpha not below `value` lost
    behind_submitted,  // behind one that was submitted before: blended surfaces write depth
    before_submitted,  // before one that was submitted before
    close_lost,        // within n codes behind the one before it: lost
    within_lost,       // within `value` of depth behind the one before it: lost
    close_merged,      // MAX
    close_swapped,
    // The opaque surface and the background
    hidden_shown,      // those behind the opaque surface over it
    at_opaque_shown,   // those within n codes behind the opaque surface, and at it, too: LEQUAL for LESS
    near_opaque_lost,  // those within n codes before it
    opaque_lost,       // the background behind what is visible
    opaque_ignored,    // the same, and hidden ones shown
    opaque_in_front,   // nothing blended over it
    background_lost,   // black behind all
    background_twice,  // added once more
    surface_lost,      // black behind all, in place of the opaque surface, too
    // Colours
    alpha_squared,
    alpha_inverted,
    alpha_ignored,  // 1
    premultiplied_twice,
    not_premultiplied
};
inline constexpr std::size_t rule_kind_count = static_cast<std::size_t>(RuleKind::not_premultiplied) + 1;

struct Rule {
    RuleKind kind = RuleKind::right;
    std::uint32_t n = 0;
    float value = 0;
    friend bool operator==(const Rule&, const Rule&) = default;
};

// As JSON names it.
[[nodiscard]] std::string_view name(RuleKind kind) noexcept;

}  // namespace strata::oracle::verdict
