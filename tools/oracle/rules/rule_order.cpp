// tools/oracle/rules/rule_order.cpp - two orders of the kinds of rules: how often ports make the mistake, by which
// explanations that look the same are listed; and the stage of a port's work, by which two rules are applied.
#include "tools/oracle/rules/rules.h"

namespace strata::oracle::verdict {

int commonness_of(RuleKind kind) noexcept {
    using enum RuleKind;
    switch (kind) {
        case as_submitted:
        case as_submitted_reversed:
        case reversed:
        case nearest_alone:
        case ends_alone:
        case lost:
        case doubled:
        case all_doubled:
        case alpha_ignored:
        case alpha_squared:
        case premultiplied_twice:
        case not_premultiplied:
        case averaged:
        case decoded:
        case blended_linear:
        case background_other:
        case background_lost: return 0;
        case colors_as_submitted:
        case alphas_as_submitted:
        case colors_shifted:
        case alphas_shifted:
        case submitted_moved:
        case by_centroid:
        case through_late:
        case veiled:
        case few_bits: return 2;
        default: return 1;
    }
}

int stage_of(RuleKind kind) noexcept {
    using enum RuleKind;
    switch (kind) {
        case right:
        case edges_twice:
        case surface_mixed:
        case mirrored:
        case halved:
        case shifted:
        case edges_never:
        case hidden_shown:
        case hidden_alone:
        case background_added:
        case background_other:
        case at_opaque_shown:
        case near_opaque_lost:
        case opaque_lost:
        case opaque_ignored:
        case opaque_in_front:
        case background_lost:
        case background_twice:
        case surface_lost: return 0;
        case alpha_squared:
        case alpha_inverted:
        case alpha_ignored:
        case alpha_times:
        case alpha_root:
        case color_root:
        case color_squared:
        case channel_lost:
        case premultiplied_twice:
        case red_for_blue:
        case decoded:
        case encoded: return 1;
        case close_lost:
        case close_merged:
        case close_swapped:
        case within_lost:
        case within_merged:
        case some_lost:
        case some_doubled:
        case alpha_below_lost:
        case alpha_below_kept:
        case behind_drawn:
        case before_drawn: return 2;
        case nearest_alone:
        case farthest_alone:
        case ends_alone:
        case nearest_lost:
        case farthest_lost:
        case first_submitted:
        case last_submitted:
        case odd_lost:
        case submitted_lost_from_last:
        case submitted_lost:
        case even_lost:
        case middle_lost:
        case middle_doubled:
        case lost_in_bits:
        case ended_early:
        case nearest_of_instance: return 3;
        case lost:
        case lost_from_far:
        case doubled:
        case doubled_from_far:
        case swapped:
        case swapped_from_far:
        case merged:
        case mixed:
        case color_of_next:
        case color_of_previous:
        case colors_shifted:
        case solid:
        case colors_as_submitted:
        case alphas_as_submitted:
        case alphas_shifted:
        case nearest_repeated:
        case nearest_behind:
        case farthest_before:
        case pairs_swapped:
        case all_doubled: return 4;
        case rest_as_submitted:
        case ends_rest_as_submitted:
        case reversed:
        case ordered_in_bits:
        case sorted_once:
        case by_centroid:
        case submitted_moved:
        case far_reversed:
        case near_reversed:
        case as_submitted:
        case as_submitted_reversed:
        case by_instance:
        case faces_apart: return 5;
        case rest_averaged:
        case averaged:
        case added:
        case weighted_sum:
        case not_premultiplied:
        case through_late:
        case few_bits:
        case behind_inverted:
        case behind_squared:
        case not_attenuated:
        case through_summed:
        case through_squared:
        case veiled:
        case multiplied:
        case greatest:
        case least:
        case composed_twice:
        case blended_linear: return 6;
        case picture_encoded:
        case picture_decoded:
        case rows_reversed:
        case columns_reversed:
        case turned: break;
    }
    return 7;
}

}  // namespace strata::oracle::verdict
