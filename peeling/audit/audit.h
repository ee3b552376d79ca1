// peeling/audit/audit.h - a finished frame against the exact A-buffer of the same fragments: what the algorithm did, and what it lost.
//
// Rule     For every pixel the sequence that the algorithm composited (its trace) is compared with the visible fragments in
//          the order of its own tie policy; the picture is compared with all fragments composited in binary64, sorted by the
//          exact depth.
// Source   audit.md 1 to 5.
// Tests    tests/peeling/audit/audit_test.cpp
#pragma once
#include "peeling/algorithms/algorithm.h"
#include "peeling/audit/audit_result.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/frame_result.h"

namespace strata::peeling {

// `result` must have been run with frame.trace set.
[[nodiscard]] AuditResult audit(const pipeline::Frame& frame, const Algorithm& algorithm,
                                const pipeline::FrameResult& result, int threads);

}  // namespace strata::peeling
