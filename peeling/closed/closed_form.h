// peeling/closed/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same
//          rules in the same order for every pixel, and the same counters, queries and trace. It is tried
//          before them; where it does not apply it returns false, has counted nothing, and the passes run.
// Source   algorithms.md 0.7.
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <algorithm>

#include "peeling/closed/block_passes.h"
#include "peeling/programs/programs.h"
#include "pipeline/frame/frame.h"

namespace strata::peeling {

[[nodiscard]] bool dual_closed(pipeline::Region& region);
[[nodiscard]] bool front_to_back_closed(pipeline::Region& region);

[[nodiscard]] inline bool has_float_blocks(const pipeline::Frame& frame) {
    return frame.color_format == pipeline::Format::rgba16f || frame.color_format == pipeline::Format::rgba32f;
}
// `others`: how many geometry passes the algorithm makes beside those that peel.
[[nodiscard]] inline BlockRules block_rules(const pipeline::Frame& frame, int others) {
    BlockRules rules{.color = color_rules(*frame.profile, frame.color_format)};
    const int fixed = frame.termination.rule == pipeline::TerminationRule::fixed ? frame.termination.passes : 0;
    for (const int limit : {frame.max_passes, fixed})
        if (limit > 0) rules.most_passes = std::min(rules.most_passes, static_cast<std::uint32_t>(limit - others));
    return rules;
}

// True if a pixel's fragments alone decide how far it is peeled: to its end or to a limit of passes, and not by ratios; all passes see
// the same depth of a fragment, the caller keeps no single layers, and colours are of a format that stored_color.h knows. A closed form
// declines every other frame, and one without memory for fragments.
[[nodiscard]] inline bool peels_by_columns(const pipeline::Frame& frame) {
    using enum pipeline::TerminationRule;
    const auto rule = frame.termination.rule;
    const bool is_known = frame.color_format == pipeline::Format::rgba8 || has_float_blocks(frame);
    return is_known && (rule == exact || rule == any || rule == fixed) && frame.is_invariant() &&
           frame.replay.bytes > 0 && !frame.keep_layers;
}

}  // namespace strata::peeling
