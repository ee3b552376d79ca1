#include "tools/oracle/verdict/rule.h"

namespace strata::oracle::verdict {

std::string_view name(RuleKind kind) noexcept {
    switch (kind) {
        case RuleKind::right: return "right";
        case RuleKind::nearest_alone: return "nearest_alone";
        case RuleKind::farthest_alone: return "farthest_alone";
        case RuleKind::ends_alone: return "ends_alone";
        case RuleKind::nearest_lost: return "nearest_lost";
        case RuleKind::farthest_lost: return "farthest_lost";
        case RuleKind::rest_averaged: return "rest_averaged";
        case RuleKind::rest_as_submitted: return "rest_as_submitted";
        case RuleKind::ends_rest_as_submitted: return "ends_rest_as_submitted";
        case RuleKind::first_submitted: return "first_submitted";
        case RuleKind::last_submitted: return "last_submitted";
        case RuleKind::odd_lost: return "odd_lost";
        case RuleKind::even_lost: return "even_lost";
        case RuleKind::ended_early: return "ended_early";
        case RuleKind::lost: return "lost";
        case RuleKind::lost_from_far: return "lost_from_far";
        case RuleKind::doubled: return "doubled";
        case RuleKind::doubled_from_far: return "doubled_from_far";
        case RuleKind::swapped: return "swapped";
        case RuleKind::swapped_from_far: return "swapped_from_far";
        case RuleKind::merged: return "merged";
        case RuleKind::mixed: return "mixed";
        case RuleKind::color_of_next: return "color_of_next";
        case RuleKind::color_of_previous: return "color_of_previous";
        case RuleKind::all_doubled: return "all_doubled";
        case RuleKind::reversed: return "reversed";
        case RuleKind::as_submitted: return "as_submitted";
        case RuleKind::as_submitted_reversed: return "as_submitted_reversed";
        case RuleKind::by_instance: return "by_instance";
        case RuleKind::faces_apart: return "faces_apart";
        case RuleKind::averaged: return "averaged";
        case RuleKind::added: return "added";
        case RuleKind::weighted_sum: return "weighted_sum";
        case RuleKind::nearest_of_instance: return "nearest_of_instance";
        case RuleKind::some_lost: return "some_lost";
        case RuleKind::some_doubled: return "some_doubled";
        case RuleKind::alpha_below_lost: return "alpha_below_lost";
        case RuleKind::alpha_below_kept: return "alpha_below_kept";
        case RuleKind::behind_drawn: return "behind_drawn";
        case RuleKind::before_drawn: return "before_drawn";
        case RuleKind::close_lost: return "close_lost";
        case RuleKind::close_merged: return "close_merged";
        case RuleKind::close_swapped: return "close_swapped";
        case RuleKind::within_lost: return "within_lost";
        case RuleKind::within_merged: return "within_merged";
        case RuleKind::edges_twice: return "edges_twice";
        case RuleKind::edges_never: return "edges_never";
        case RuleKind::hidden_shown: return "hidden_shown";
        case RuleKind::at_opaque_shown: return "at_opaque_shown";
        case RuleKind::near_opaque_lost: return "near_opaque_lost";
        case RuleKind::opaque_lost: return "opaque_lost";
        case RuleKind::opaque_ignored: return "opaque_ignored";
        case RuleKind::opaque_in_front: return "opaque_in_front";
        case RuleKind::background_lost: return "background_lost";
        case RuleKind::background_twice: return "background_twice";
        case RuleKind::surface_lost: return "surface_lost";
        case RuleKind::alpha_squared: return "alpha_squared";
        case RuleKind::alpha_inverted: return "alpha_inverted";
        case RuleKind::alpha_ignored: return "alpha_ignored";
        case RuleKind::alpha_times: return "alpha_times";
        case RuleKind::premultiplied_twice: return "premultiplied_twice";
        case RuleKind::not_premultiplied: return "not_premultiplied";
        case RuleKind::red_for_blue: return "red_for_blue";
        case RuleKind::decoded: return "decoded";
        case RuleKind::encoded: return "encoded";
        case RuleKind::blended_linear: return "blended_linear";
        case RuleKind::middle_lost: return "middle_lost";
        case RuleKind::middle_doubled: return "middle_doubled";
        case RuleKind::colors_shifted: return "colors_shifted";
        case RuleKind::alphas_shifted: return "alphas_shifted";
        case RuleKind::nearest_repeated: return "nearest_repeated";
        case RuleKind::nearest_behind: return "nearest_behind";
        case RuleKind::farthest_before: return "farthest_before";
        case RuleKind::pairs_swapped: return "pairs_swapped";
        case RuleKind::ordered_in_bits: return "ordered_in_bits";
        case RuleKind::lost_in_bits: return "lost_in_bits";
        case RuleKind::sorted_once: return "sorted_once";
        case RuleKind::through_late: return "through_late";
        case RuleKind::multiplied: return "multiplied";
        case RuleKind::greatest: return "greatest";
        case RuleKind::least: return "least";
        case RuleKind::composed_twice: return "composed_twice";
        case RuleKind::hidden_alone: return "hidden_alone";
        case RuleKind::background_added: return "background_added";
        case RuleKind::background_other: return "background_other";
        case RuleKind::alpha_root: return "alpha_root";
        case RuleKind::channel_lost: return "channel_lost";
        case RuleKind::picture_encoded: return "picture_encoded";
        case RuleKind::picture_decoded: return "picture_decoded";
        case RuleKind::rows_reversed: return "rows_reversed";
        case RuleKind::columns_reversed: return "columns_reversed";
        case RuleKind::turned: return "turned";
    }
    return "";  // unreachable: the enum is closed
}

}  // namespace strata::oracle::verdict
