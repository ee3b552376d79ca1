// peeling/frame/render_diagnostics.h - the diagnostics of a frame: causes of order errors, peels that did not
// terminate, and features that no device had.
//
// Source   peeling/reference/keys-and-counts.md 3.4 and 7.3.
// Tests    tests/peeling/comparison_test.cpp, sequences/published_test.cpp, algorithms/shadow_map_test.cpp
#pragma once
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/audit/audit_result.h"
#include "peeling/render_options.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/frame_result.h"

namespace strata::rasterizer {
struct SetupCounters;
}

namespace strata::peeling {

// Reasons why passes may not see the depths that earlier ones stored.
struct PassDepths {
    bool is_invariant = true;  // every pass saw the same fragments and compared the depth that it stored
    bool are_flushed = false;  // the whole depth range is denormal, and blending into float targets flushes it to zero
};

// Reports the cause of order errors: the first that applies, in the order of keys-and-counts.md 7.3.
void add_audit_diagnostics(const Algorithm& algorithm, const RenderOptions& options, const PassDepths& depths,
                           const AuditResult& audit, std::vector<pipeline::Diagnostic>& all);

// A limit set by the user is no fault, even if the peel reaches it (keys-and-counts.md 3.4).
void note_endless(const Algorithm& algorithm, const pipeline::Frame& frame, const RenderOptions& options,
                  pipeline::FrameResult& result);

// Reports triangles that set-up dropped.
void note_set_up(const rasterizer::SetupCounters& counters, std::vector<pipeline::Diagnostic>& all);

// Reports features of the algorithm that no device had. `quantizes`: a compared depth is rounded like a stored one.
void note_extensions(const Algorithm& algorithm, pipeline::DepthFormat format, bool quantizes,
                     std::vector<pipeline::Diagnostic>& all);

}  // namespace strata::peeling
