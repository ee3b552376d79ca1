// peeling/closed/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same
//          rules in the same order for every pixel, and the same counters, queries and trace. It is tried
//          before them; where it does not apply it returns false, has counted nothing, and the passes run.
// Source   algorithms.md 0.7.
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <vector>

#include "peeling/closed/block_passes.h"
#include "peeling/programs/programs.h"
#include "pipeline/frame/frame.h"

namespace strata::peeling {

[[nodiscard]] bool dual_closed(pipeline::Region& region);
[[nodiscard]] bool front_to_back_closed(pipeline::Region& region);

[[nodiscard]] inline bool has_float_blocks(const pipeline::Frame& frame) {
    return frame.color_format == pipeline::Format::rgba16f || frame.color_format == pipeline::Format::rgba32f;
}
[[nodiscard]] inline BlockRules block_rules(const pipeline::Frame& frame) {
    const pipeline::DeviceProfile& profile = *frame.profile;
    return {.type = pipeline::info(frame.color_format).type,
            .rounding = profile.color_rounding(),
            .blend = profile.blend_rounding,
            .flushes = profile.denormals == pipeline::DenormalRule::flush};
}

// True if the frame is peeled to its end: every layer answers the query, all passes see the same depth of a fragment,
// the caller keeps no single layers, and colours are of a format that block_targets.h knows. A closed form declines every other frame, and one
// without memory for fragments.
[[nodiscard]] inline bool peels_to_the_end(const pipeline::Frame& frame) {
    using pipeline::TerminationRule;
    const bool exact =
        frame.termination.rule == TerminationRule::exact || frame.termination.rule == TerminationRule::any;
    const bool is_known = frame.color_format == pipeline::Format::rgba8 || has_float_blocks(frame);
    return is_known && frame.is_invariant() && frame.replay.bytes > 0 && exact && frame.max_passes == 0 &&
           !frame.keep_layers;
}

}  // namespace strata::peeling
